//! Rough surface of spherical tips with exponential or Gaussian heights (Greenwood and Williamson, Proc. R. Soc. A 295, 300, 1966).
//!
//! Every tip is a paraboloid of radius R with m = 2√(Rh), and the tips are elastically independent. With the density p(z) of their
//! heights z in units of the scale s (mean height l or standard deviation σ), a plane at the distance t = z_max - h/s gives
//!
//! * m = 2n√(Rs) I(1/2), M = (4/3)n√R s^{3/2} I(3/2), N = (8/15)n√R s^{5/2} I(5/2),
//! * I(k) = ∫ (z-t)ᵏ p(z) dz from t to `z_max`.
//!
//! The number n of tips gives the expected highest one, where n times the probability of a larger height is 1: `z_max` = ln n for
//! exponential heights. Under a prescribed force the tail has no end. The indentation then counts from a distance at which the tips
//! that are higher carry less than rounding.

use super::error::positive;
use super::kind::Kind;
use super::{Profile, ProfileError, Shape};
use crate::quadrature::kronrod;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Panels of the quadrature over the heights.
const PANELS: u32 = 4;
/// Excess over the distance in which a density falls below rounding, in units of its scale: exponential, Gaussian.
const TAILS: [f64; 2] = [50.0, 9.0];
/// Distance beyond the expected highest tip from which on an endless tail is counted, in units of its scale: exponential, Gaussian.
const BEYOND: [f64; 2] = [50.0, 9.0];
/// Smallest and largest number of tips.
const COUNTS: [f64; 2] = [10.0, 1e15];
/// Distance below the mean plane up to which Gaussian tips can be pressed, in standard deviations. All tips are in contact there.
const DEEPEST: f64 = 4.0;
/// Largest number of steps of Newton's method.
const STEPS: usize = 100;

/// Distribution of the heights of the tips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heights {
    /// Density e^{-z/l}/l above a reference plane.
    Exponential,
    /// Normal distribution about the mean plane.
    Gaussian,
}

/// Spherical tips of random heights.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asperities {
    heights: Heights,
    /// Mean height or standard deviation, m.
    scale: f64,
    /// Radius of the tips, m.
    radius: f64,
    /// Number of tips.
    count: f64,
    /// Distance of the plane at first touch from the reference or mean plane, in units of the scale.
    highest: f64,
    /// Whether the tail has no end.
    endless: bool,
}

impl Profile {
    /// Creates a surface of spherical tips from the scale of their heights (mean height or standard deviation, m), their radius (m) and
    /// their number.
    ///
    /// With `endless`, the heights have no largest one, and the indentation counts from far above.
    ///
    /// # Errors
    ///
    /// Fails for a scale or radius that is not above 0 or not finite, and for a number of tips out of 10 to 10¹⁵.
    pub fn asperities(
        heights: Heights,
        scale: f64,
        radius: f64,
        count: f64,
        endless: bool,
    ) -> Result<Self, ProfileError> {
        let scale = positive(scale, ProfileError::Scale)?;
        let radius = positive(radius, ProfileError::Radius)?;
        if !(COUNTS[0]..=COUNTS[1]).contains(&count) {
            return Err(ProfileError::Tips(count));
        }
        let expected = match heights {
            Heights::Exponential => math::ln(count),
            Heights::Gaussian => expected_highest(count),
        };
        let highest = if endless { expected + BEYOND[heights as usize] } else { expected };
        let asperities = Asperities { heights, scale, radius, count, highest, endless };
        Ok(Self { shape: Shape::Asperities(asperities) })
    }

    /// Returns the scale of the heights of asperities without a highest one, m; gross slip then needs an unlimited displacement.
    pub fn endless_scale(&self) -> Option<f64> {
        match &self.shape {
            Shape::Asperities(asperities) => asperities.endless.then_some(asperities.scale),
            _ => None,
        }
    }
}

/// Returns the height z at which the normal distribution exceeds z with the probability 1/count.
fn expected_highest(count: f64) -> f64 {
    let exceeded = |z: f64| 0.5 * math::erfc(z * FRAC_1_SQRT_2);
    let (mut low, mut high) = (0.0, 9.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if count * exceeded(middle) > 1.0 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

fn density(heights: Heights, z: f64) -> f64 {
    match heights {
        Heights::Exponential => math::exp(-z),
        Heights::Gaussian => math::exp(-0.5 * z * z) / TAU.sqrt(),
    }
}

impl Asperities {
    /// Returns I(k) for a height h, by quadrature over the root v of z - t, so that the integrand is smooth.
    fn integral(&self, power: i32, h: f64) -> f64 {
        let depth = h / self.scale;
        let from = self.highest - depth;
        // Beyond this height above the plane the density is below rounding.
        let tail = match self.heights {
            Heights::Exponential => TAILS[0],
            Heights::Gaussian => TAILS[1] - from,
        };
        let end = depth.min(tail).max(0.0).sqrt();
        // k = 1/2, 3/2, 5/2 of v² dv² is 2v^{2k+1}.
        let of = |v: f64| 2.0 * v.powi(power) * density(self.heights, from + v * v);
        let panel = |i: u32| [i, i + 1].map(|i| end * f64::from(i) / f64::from(PANELS));
        (0..PANELS).map(|i| kronrod(panel(i), of).0).sum()
    }

    /// Returns M(h) and m(h).
    fn force_and_stiffness(&self, h: f64) -> [f64; 2] {
        let root = self.radius.sqrt() * self.scale.sqrt();
        if let Some(force) = self.exponential(h) {
            return [force, force / self.scale];
        }
        let force = 4.0 / 3.0 * self.count * root * self.scale * self.integral(4, h);
        [force, 2.0 * self.count * root * self.integral(2, h)]
    }

    /// Returns M(h) = n√(πR) l^{3/2} e^{-t} of exponential heights where the end of the tail does not matter.
    fn exponential(&self, h: f64) -> Option<f64> {
        let depth = h / self.scale;
        (self.heights == Heights::Exponential && depth > TAILS[0]).then(|| {
            let root = (PI * self.radius * self.scale).sqrt();
            self.count * root * self.scale * math::exp(depth - self.highest)
        })
    }

    /// Solves ln f(h) = ln wanted for a function that increases with a concave logarithm.
    fn solve(&self, wanted: f64, at: impl Fn(f64) -> [f64; 2]) -> f64 {
        let reach = self.highest_reach();
        let (mut low, mut high, mut h) = (0.0, reach, 0.5 * self.highest * self.scale);
        for _ in 0..STEPS {
            let [value, slope] = at(h);
            *(if value < wanted { &mut low } else { &mut high }) = h;
            let next = h - math::ln(value / wanted) * value / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - h).abs() <= 2.0 * f64::EPSILON * h {
                return next;
            }
            h = next;
        }
        h
    }

    /// Returns the height at which the plane reaches the reference plane, or for Gaussian heights lies far below the mean plane, m.
    fn highest_reach(&self) -> f64 {
        self.scale
            * match self.heights {
                Heights::Exponential => self.highest,
                Heights::Gaussian => self.highest + DEEPEST,
            }
    }
}

impl Kind for Asperities {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        self.force_and_stiffness(h)[1]
    }

    fn reduced_force(&self, h: f64) -> f64 {
        self.force_and_stiffness(h)[0]
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        if let Some(force) = self.exponential(h) {
            return force * self.scale;
        }
        let root = self.radius.sqrt() * self.scale.sqrt();
        8.0 / 15.0 * self.count * root * self.scale * self.scale * self.integral(6, h)
    }

    fn height_of_reduced_force(&self, force: f64) -> f64 {
        if self.heights == Heights::Exponential {
            let root = (PI * self.radius * self.scale).sqrt() * self.scale * self.count;
            let depth = self.highest + math::ln(force / root);
            if depth > TAILS[0] {
                return depth * self.scale;
            }
        }
        self.solve(force, |h| self.force_and_stiffness(h))
    }

    /// The height of a length in contact; dm/dh = n√(R/s) I(-1/2) has an integrand without a singularity in v.
    fn depth(&self, a: f64) -> f64 {
        let slope = |h: f64| self.count * (self.radius / self.scale).sqrt() * self.integral(0, h);
        if 2.0 * a >= self.reduced_stiffness(self.highest_reach()) {
            return f64::INFINITY;
        }
        self.solve(2.0 * a, |h| [self.reduced_stiffness(h), slope(h)])
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let h = self.depth(a);
        2.0 / (self.count * (self.radius / self.scale).sqrt() * self.integral(0, h))
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }

    fn first_power(&self) -> f64 {
        2.5
    }

    fn reach(&self) -> Option<f64> {
        Some(self.highest_reach())
    }
}
