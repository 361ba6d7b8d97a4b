//! Breakpoint of the memory curve, with integrals over the curve below it.
//!
//! Breakpoints are removed from the top only, so the integrals of the remaining breakpoints stay valid. Force and energy of a new apex
//! follow from the breakpoint below it.

use crate::{Apex, Interface};

/// Breakpoint (h, p) and the integrals over the curve below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Knot {
    /// Height h, m.
    pub(super) h: f64,
    /// Rest position p(h), m.
    pub(super) p: f64,
    /// Slope dp/dh of the piece that ends here.
    // Stored, because the difference of two rest positions loses digits after a long displacement.
    pub(super) slope: f64,
    /// Force per ΔM of the piece that ends here, over G\*: its slope, or the mean over a curved growth path.
    pub(super) gain: f64,
    /// Reduced force M(h), m².
    pub(super) reduced_force: f64,
    /// Reduced energy N(h), m³.
    pub(super) reduced_energy: f64,
    /// Integral ∫₀ʰ p' m dh, m². G\* times this is F_x of a contact that ends here.
    pub(super) shear: f64,
    /// Integral ∫₀ʰ (p(h)-p)² dm, m³. ½G\* times this is the tangential elastic energy of a contact that ends here.
    pub(super) square: f64,
    /// Whether the pieces below and above belong to one smooth growth path.
    pub(super) joined: bool,
}

impl Knot {
    /// Returns the breakpoint of a contact that touches at displacement u.
    pub(super) fn touch(u: f64) -> Self {
        Self {
            h: 0.0,
            p: u,
            slope: 0.0,
            gain: 0.0,
            reduced_force: 0.0,
            reduced_energy: 0.0,
            shear: 0.0,
            square: 0.0,
            joined: false,
        }
    }

    /// Returns whether the piece that ends here is the chord of a curved growth path.
    #[inline]
    pub(super) fn is_uneven(&self) -> bool {
        self.gain != self.slope
    }

    /// Returns the level σp - κh of the breakpoint, m, for a direction σ and slope κ.
    #[inline]
    pub(super) fn level(&self, sense: f64, slope: f64) -> f64 {
        sense * self.p - slope * self.h
    }

    /// Returns the apex at this breakpoint.
    pub(super) fn apex(&self) -> Apex {
        Apex { d: self.h, u: self.p }
    }

    /// Returns the breakpoint at the end of a straight piece from here to (h, p). The slope is given separately to avoid cancellation.
    #[inline]
    pub(super) fn grow(&self, law: &Interface, h: f64, slope: f64, p: f64) -> Self {
        let [reduced_force, reduced_energy] = law.profile().reduced_sums(h);
        self.extend(h, p, slope, slope, reduced_force, reduced_energy)
    }

    /// Returns the breakpoint at the end of a straight growth piece in full stick.
    #[inline]
    pub(super) fn stick(&self, law: &Interface, to: Apex) -> Self {
        self.grow(law, to.d, (to.u - self.p) / (to.d - self.h), to.u)
    }

    /// Returns the breakpoint at the end of a piece with given slope, gain, M(h) and N(h).
    ///
    /// Over a piece of slope k and gain γ, ∫(p₂-p)²dm grows by 2S₁Δp + 2kγ(ΔN - ΔhM₁), where S₁ is the shear integral below. The
    /// derivation uses dB = 2S dp with S = S₁ + γ(M-M₁).
    #[inline]
    pub(super) fn extend(
        &self,
        h: f64,
        p: f64,
        slope: f64,
        gain: f64,
        reduced_force: f64,
        reduced_energy: f64,
    ) -> Self {
        let rise = h - self.h;
        Self {
            h,
            p,
            slope,
            gain,
            reduced_force,
            reduced_energy,
            shear: self.shear + gain * (reduced_force - self.reduced_force),
            square: self.square
                + 2.0
                    * slope
                    * (rise * self.shear
                        + gain * (reduced_energy - self.reduced_energy - rise * self.reduced_force)),
            joined: false,
        }
    }

    /// Returns the breakpoint at the end of a curved growth path, with integrals that were computed along the path.
    ///
    /// The path between the ends is not stored. Rest positions lie on the chord, and the force is proportional to ΔM, so that the total
    /// force equals the force of the path.
    // The integrals of the chord would be less accurate.
    pub(super) fn grow_by(&self, law: &Interface, to: Apex, shear: f64, square: f64) -> Self {
        let [reduced_force, reduced_energy] = law.profile().reduced_sums(to.d);
        let (rise, swell) = (to.d - self.h, reduced_force - self.reduced_force);
        Self {
            h: to.d,
            p: to.u,
            slope: if rise > 0.0 { (to.u - self.p) / rise } else { 0.0 },
            gain: if swell > 0.0 { (shear - self.shear) / swell } else { 0.0 },
            reduced_force,
            reduced_energy,
            shear,
            square,
            joined: false,
        }
    }

    /// Returns the point at height h of the piece from here to `end`.
    ///
    /// For a curved growth path, the energy difference between path and chord is distributed in proportion to the height.
    pub(super) fn point(&self, law: &Interface, end: &Self, h: f64) -> Self {
        let [reduced_force, reduced_energy] = law.profile().reduced_sums(h);
        let p = self.p + end.slope * (h - self.h);
        let mut point = self.extend(h, p, end.slope, end.gain, reduced_force, reduced_energy);
        if end.is_uneven() {
            let straight =
                self.extend(end.h, end.p, end.slope, end.gain, end.reduced_force, end.reduced_energy);
            point.square += (end.square - straight.square) * (h - self.h) / (end.h - self.h);
        }
        point
    }
}
