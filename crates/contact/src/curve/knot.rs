//! A turning point of the memory curve, with the sums of everything below it.
//!
//! A drag gives up knots from the top only, so the sums below stay: forces and energies of a new apex follow from those of
//! the knot on which it stands, whatever lies below.

use crate::{Apex, Interface};

/// A knot (h, p) and the integrals over the curve below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Knot {
    /// Height, m.
    pub(super) h: f64,
    /// Anchor p(h), m.
    pub(super) p: f64,
    /// Slope dp/dh of the piece that ends here.
    // Kept, though two anchors would give it: of a contact that has travelled 10⁶ u_c their difference has lost six digits.
    // What is left of forces then, 1e-9 of the limit, is lost in u itself; 1e-12 at 10³ u_c.
    pub(super) slope: f64,
    /// Force per ΔM of the piece that ends here: its slope, or the mean of a curved path of growth.
    pub(super) gain: f64,
    /// M(h), m².
    pub(super) reduced_force: f64,
    /// N(h), m³.
    pub(super) reduced_energy: f64,
    /// ∫₀ʰ p' m dh, m²; G\* times this is F_x of a contact that ends here.
    pub(super) shear: f64,
    /// ∫₀ʰ (p(h)-p)² dm, m³; ½G\* times this is the elastic energy of a contact that ends here.
    pub(super) square: f64,
    /// Whether the piece above goes on smoothly from the piece below: one path of growth in several pieces.
    pub(super) joined: bool,
}

impl Knot {
    /// The knot of a contact that just touches at displacement u.
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

    /// Whether the piece that ends here is the chord of a bent path of growth.
    #[inline]
    pub(super) fn is_uneven(&self) -> bool {
        self.gain != self.slope
    }

    /// σp - κh in the frame of a sense σ, m: what the edge of that sense compares.
    #[inline]
    pub(super) fn level(&self, sense: f64, slope: f64) -> f64 {
        sense * self.p - slope * self.h
    }

    /// The apex that stands on this knot.
    pub(super) fn apex(&self) -> Apex {
        Apex { d: self.h, u: self.p }
    }

    /// The end of a straight piece from here to (h, p). The slope is given, not taken from the difference of
    /// two rounded anchors.
    #[inline]
    pub(super) fn grow(&self, law: &Interface, h: f64, slope: f64, p: f64) -> Self {
        let [reduced_force, reduced_energy] = law.profile().reduced_sums(h);
        self.extend(h, p, slope, slope, reduced_force, reduced_energy)
    }

    /// The end of a straight piece of growth in full stick.
    #[inline]
    pub(super) fn stick(&self, law: &Interface, to: Apex) -> Self {
        self.grow(law, to.d, (to.u - self.p) / (to.d - self.h), to.u)
    }

    /// The same with M(h) and N(h) at hand, and a gain of its own.
    ///
    /// ∫(p₂-p)²dm grows by 2S₁Δp + 2kγ(ΔN - ΔhM₁) over a piece of slope k and gain γ, where S₁ is the shear
    /// below: dB = 2S dp, S = S₁ + γ(M-M₁).
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

    /// The end of a curved path of growth, with the sums integrated along it.
    ///
    /// Between its ends the path is not kept: anchors inside lie on the chord, and the force grows with M(h) in proportion,
    /// so that a later cut meets the sum that was integrated and not the chord's.
    // The chord's own sums would lose the order again that the integration has kept.
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

    /// The point at height h of the piece that starts here and ends at `end`.
    ///
    /// Where the end's energy came from an integration along a curved path, the difference to the straight
    /// piece is shared out by height.
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
