//! Truncated cone: flat up to a radius b, beyond it f = (r-b) tanθ.
//!
//! With w = √(x²-b²) and φ = arccos(b/x) = arctan(w/b) for x ≥ b (handbook 2.5.8):
//!
//! * g = x φ tanθ, g′ = (φ + b/w) tanθ,
//! * M = (x²φ + bw) tanθ,
//! * N = [φ²x³/3 + b²(x-b)/3 + (2/3)bφxw - (b³/3)K] tan²θ, K = ∫₀^φ t/cos t dt.
//!
//! Only the last term is negative, and it is at most a seventh of the others. The formulas have no cancellation at small h, the limit
//! of a flat punch, nor for b → 0, the cone.

use super::angle::{Place, gudermann_integral};
use super::error::positive;
use super::kind::{Kind, Peak};
use super::newton::root;
use super::{Profile, ProfileError, Shape};
use std::f64::consts::FRAC_2_PI;

/// Cone of slope tanθ, truncated to a flat of radius b (m).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TruncatedCone {
    border: [f64; 1],
    slope: f64,
}

impl Profile {
    /// Creates a truncated cone: a flat of radius b (m), beyond it f = (r-b) tanθ, from b and tanθ.
    ///
    /// # Errors
    ///
    /// Fails for a radius or slope that is not above 0 or not finite.
    pub fn truncated_cone(flat: f64, slope: f64) -> Result<Self, ProfileError> {
        let border = [positive(flat, ProfileError::Flat)?];
        let slope = positive(slope, ProfileError::Slope)?;
        Ok(Self { shape: Shape::TruncatedCone(TruncatedCone { border, slope }) })
    }
}

impl TruncatedCone {
    /// Returns the position x with g(x) = h > 0. x φ is about w for small w and about (π/2)w - b for large w.
    fn place(&self, h: f64) -> Place {
        let [b] = self.border;
        let wanted = h / self.slope;
        let start = if wanted < 1.5 * b { wanted } else { FRAC_2_PI * (wanted + b) };
        let w = root(wanted, start, |w| {
            let Place { x, angle, .. } = Place::beyond(b, w);
            (x * angle, (w * angle + b) / x)
        });
        Place::beyond(b, w)
    }
}

impl Kind for TruncatedCone {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * self.place(h).x
    }

    fn reduced_force(&self, h: f64) -> f64 {
        let Place { border, w, x, angle } = self.place(h);
        self.slope * (x * x * angle + border * w)
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        let place = self.place(h);
        let Place { border, w, x, angle } = place;
        let outer = angle * x * (angle * x * x + 2.0 * border * w) + border * border * place.excess();
        let inner = border * border * border * gudermann_integral(place.hyperbolic());
        self.slope * self.slope * (outer - inner) / 3.0
    }

    /// Solves for w, with dM/dw = 2(wφ + b) tanθ.
    fn height_of_reduced_force(&self, force: f64) -> f64 {
        let [b] = self.border;
        let wanted = force / self.slope;
        // M is at least 2bw tanθ, and about that of a cone for large w.
        let start = (0.5 * wanted / b).min((FRAC_2_PI * wanted).sqrt() + b);
        let w = root(wanted, start, |w| {
            let Place { x, angle, .. } = Place::beyond(b, w);
            (x * x * angle + b * w, 2.0 * (w * angle + b))
        });
        let Place { x, angle, .. } = Place::beyond(b, w);
        self.slope * x * angle
    }

    fn depth(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return 0.0;
        }
        let Place { x, angle, .. } = Place::at(b, a);
        self.slope * x * angle
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return 0.0;
        }
        let Place { w, angle, .. } = Place::at(b, a);
        self.slope * (angle + b / w)
    }

    fn gap(&self, r: f64) -> Option<f64> {
        Some(self.slope * (r - self.border[0]).max(0.0))
    }

    fn borders(&self) -> &[f64] {
        &self.border
    }

    /// Returns that the pressure is unbounded at the edge of the flat, where it has a logarithmic singularity.
    fn peak(&self) -> Option<Peak> {
        Some(Peak::Unbounded)
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }
}
