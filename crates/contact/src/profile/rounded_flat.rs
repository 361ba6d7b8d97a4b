//! Flat punch with a rounded edge: flat up to a radius b, beyond it f = (r-b)²/2R.
//!
//! With w = √(x²-b²) and φ = arccos(b/x) = arctan(w/b) for x ≥ b (handbook 2.5.13):
//!
//! * g = x(w - bφ)/R, g′ = (2w - bφ)/R,
//! * M = [(4/3)w³ + b²w - bx²φ]/R,
//! * N by [`curved_beyond`] with α = -φ.
//!
//! All three have cancellation for w ≪ b. For small w/b, g and M are computed by series in w/b, and N by quadrature.

use super::angle::{Place, curved_beyond};
use super::error::positive;
use super::kind::{Kind, Peak};
use super::newton::root;
use super::{Profile, ProfileError, Shape};
use crate::quadrature::GAUSS_12;
use std::f64::consts::FRAC_PI_4;

/// Flat of radius b (m) with an edge of radius of curvature R (m).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RoundedFlat {
    border: [f64; 1],
    radius: f64,
}

/// Largest w/b of the series, whose terms decrease as (w/b)².
const SERIES_END: f64 = 0.5;

/// Number of terms of the series, with a truncation error of 1e-17.
const TERMS: u32 = 27;

/// Largest w/b at which N is computed by quadrature with twelve nodes, with an error of 1e-15.
const SUM_END: f64 = 1.0;

impl Profile {
    /// Creates a flat punch with a rounded edge: a flat of radius b (m), beyond it f = (r-b)²/2R, from b and R (m).
    ///
    /// # Errors
    ///
    /// Fails for a radius that is not above 0 or not finite.
    pub fn rounded_flat(flat: f64, radius: f64) -> Result<Self, ProfileError> {
        let border = [positive(flat, ProfileError::Flat)?];
        let radius = positive(radius, ProfileError::Radius)?;
        Ok(Self { shape: Shape::RoundedFlat(RoundedFlat { border, radius }) })
    }
}

/// Returns Σ (-1)ᵏ cₖ t^{2k}.
fn series(t: f64, c: impl Fn(f64) -> f64) -> f64 {
    let square = -t * t;
    (0..TERMS).rev().fold(0.0, |sum, k| sum * square + c(f64::from(k)))
}

/// Returns gR/b² and its derivative with respect to t = w/b: √(1+t²)(t - arctan t) and (2t - arctan t) t/√(1+t²).
fn depth(t: f64) -> (f64, f64) {
    let (x, angle) = (math::hypot(1.0, t), math::atan(t));
    let rest = if t < SERIES_END { t * t * t * series(t, |k| 1.0 / (2.0 * k + 3.0)) } else { t - angle };
    (x * rest, (t + rest) * t / x)
}

/// Returns MR/b³ and its derivative with respect to t: (4/3)t³ + t - (1+t²) arctan t and 2(2t - arctan t)t.
fn force(t: f64) -> (f64, f64) {
    let angle = math::atan(t);
    let force = if t < SERIES_END {
        // (4/3)t³ - Σ(-1)ᵏ 2t^{2k+3}/((2k+1)(2k+3)).
        t * t * t * (4.0 / 3.0 - series(t, |k| 2.0 / ((2.0 * k + 1.0) * (2.0 * k + 3.0))))
    } else {
        t * (4.0 / 3.0 * t * t + 1.0) - (1.0 + t * t) * angle
    };
    (force, 2.0 * (2.0 * t - angle) * t)
}

/// Returns NR²/b⁵.
fn energy(t: f64) -> f64 {
    if t > SUM_END {
        let place = Place::beyond(1.0, t);
        return curved_beyond(&place, -place.angle);
    }
    // N = ∫M dg, integrated over t.
    let node = |&(x, weight): &(f64, f64)| {
        let at = 0.5 * t * (1.0 + x);
        weight * force(at).0 * depth(at).1
    };
    t * GAUSS_12.iter().map(node).sum::<f64>()
}

impl RoundedFlat {
    /// Returns t = w/b with g = h.
    fn t(&self, h: f64) -> f64 {
        let [b] = self.border;
        let wanted = h / b * (self.radius / b);
        let start = if wanted < 1.0 { math::cbrt(3.0 * wanted) } else { wanted.sqrt() + FRAC_PI_4 };
        root(wanted, start, depth)
    }
}

impl Kind for RoundedFlat {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * self.border[0] * math::hypot(1.0, self.t(h))
    }

    fn reduced_force(&self, h: f64) -> f64 {
        let [b] = self.border;
        b * b * (b / self.radius) * force(self.t(h)).0
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        let [b] = self.border;
        let ratio = b / self.radius;
        b * b * b * ratio * ratio * energy(self.t(h))
    }

    fn height_of_reduced_force(&self, wanted: f64) -> f64 {
        let [b] = self.border;
        let wanted = wanted / (b * b) * (self.radius / b);
        // M ≥ (2/3)t³, and M ≈ (4/3)t³ for large t.
        let start =
            if wanted < 1.0 { math::cbrt(1.5 * wanted) } else { math::cbrt(0.75 * wanted) + FRAC_PI_4 };
        b * (b / self.radius) * depth(root(wanted, start, force)).0
    }

    fn depth(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return 0.0;
        }
        b * (b / self.radius) * depth(Place::at(b, a).w / b).0
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return 0.0;
        }
        let Place { w, angle, .. } = Place::at(b, a);
        (2.0 * w - b * angle) / self.radius
    }

    fn gap(&self, r: f64) -> Option<f64> {
        let rise = (r - self.border[0]).max(0.0);
        Some(rise * (rise / (2.0 * self.radius)))
    }

    fn borders(&self) -> &[f64] {
        &self.border
    }

    fn peak(&self) -> Option<Peak> {
        Some(Peak::Between)
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }
}
