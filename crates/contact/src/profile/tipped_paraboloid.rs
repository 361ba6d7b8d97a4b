//! Paraboloid with a conical tip: a cone of slope b/R up to a radius b, beyond it f = (r²+b²)/2R. f and f′ are continuous.
//!
//! For x ≤ b the profile is the cone, g = (π/2)(b/R)x. With w = √(x²-b²) and ψ = arcsin(b/x) for x ≥ b:
//!
//! * g = x(w + bψ)/R, g′ = (2w + bψ)/R,
//! * M = [(4/3)w³ + b²w + bx²ψ]/R,
//! * N by [`curved_beyond`] with α = ψ.

use super::angle::{Place, curved_beyond};
use super::error::positive;
use super::kind::{Kind, Peak};
use super::newton::root;
use super::{Profile, ProfileError, Shape};
use std::f64::consts::FRAC_PI_2;

/// Paraboloid of radius of curvature R (m) with a cone up to a radius b (m).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TippedParaboloid {
    border: [f64; 1],
    radius: f64,
    /// Slope of g in the cone, (π/2)b/R.
    slope: f64,
}

impl Profile {
    /// Creates a paraboloid of radius of curvature R (m) with a conical tip up to a radius b (m): f = br/R inside, (r²+b²)/2R beyond.
    ///
    /// # Errors
    ///
    /// Fails for a radius that is not above 0 or not finite.
    pub fn tipped_paraboloid(radius: f64, tip: f64) -> Result<Self, ProfileError> {
        let border = [positive(tip, ProfileError::Tip)?];
        let radius = positive(radius, ProfileError::Radius)?;
        let slope = FRAC_PI_2 * (tip / radius);
        Ok(Self { shape: Shape::TippedParaboloid(TippedParaboloid { border, radius, slope }) })
    }
}

/// Returns M R: (4/3)w³ + b²w + bx²ψ.
fn force(place: &Place) -> f64 {
    let Place { border: b, w, x, .. } = *place;
    w * (4.0 / 3.0 * w * w + b * b) + b * x * x * place.complement()
}

impl TippedParaboloid {
    /// Returns the position x with g(x) = h, for h beyond the cone. The paraboloid of the same h is an upper bound, because w + bψ ≥ x.
    fn place(&self, h: f64) -> Place {
        let [b] = self.border;
        let wanted = self.radius * h;
        let x = root(wanted, wanted.sqrt(), |x| {
            let place = Place::at(b, x.max(b));
            let part = b * place.complement();
            (x * (place.w + part), 2.0 * place.w + part)
        });
        Place::at(b, x.max(b))
    }

    /// Returns the height at which the cone ends, m.
    fn end(&self) -> f64 {
        self.slope * self.border[0]
    }
}

impl Kind for TippedParaboloid {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * if h <= self.end() { h / self.slope } else { self.place(h).x }
    }

    fn reduced_force(&self, h: f64) -> f64 {
        if h <= self.end() { h * (h / self.slope) } else { force(&self.place(h)) / self.radius }
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        if h <= self.end() {
            return h * h * (h / (3.0 * self.slope));
        }
        let ([b], place) = (self.border, self.place(h));
        let ratio = b / self.radius;
        b * b * b * ratio * ratio * curved_beyond(&place, place.complement())
    }

    fn height_of_reduced_force(&self, wanted: f64) -> f64 {
        let ([b], end) = (self.border, self.end());
        let cone = (self.slope * wanted).sqrt();
        if cone <= end {
            return cone;
        }
        let wanted = self.radius * wanted;
        let x = root(wanted, math::cbrt(0.75 * wanted), |x| {
            let place = Place::at(b, x.max(b));
            (force(&place), 2.0 * x * (2.0 * place.w + b * place.complement()))
        });
        self.depth(x)
    }

    fn depth(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return self.slope * a;
        }
        let place = Place::at(b, a);
        a * (place.w + b * place.complement()) / self.radius
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return self.slope;
        }
        let place = Place::at(b, a);
        (2.0 * place.w + b * place.complement()) / self.radius
    }

    fn gap(&self, r: f64) -> Option<f64> {
        let [b] = self.border;
        Some(if r <= b { b * (r / self.radius) } else { (r * r + b * b) / (2.0 * self.radius) })
    }

    fn borders(&self) -> &[f64] {
        &self.border
    }

    /// Returns that the pressure is unbounded at the tip.
    fn peak(&self) -> Option<Peak> {
        Some(Peak::Unbounded)
    }

    /// Returns that the derivative of the stiffness is singular where the cone ends.
    fn has_bends(&self) -> bool {
        true
    }

    /// Returns the exponent of the conical tip.
    fn first_power(&self) -> f64 {
        2.0
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }
}
