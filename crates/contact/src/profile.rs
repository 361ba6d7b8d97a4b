//! Profiles of the gap between two bodies, and the functions m, M and N of their MDR foundation.

mod angle;
mod asperities;
mod chart;
mod error;
mod flat;
mod foundation;
mod graded;
mod kappa;
mod kind;
mod newton;
mod normal_law;
mod outline;
mod power;
mod powers;
mod root_series;
mod rough;
mod rounded_flat;
mod self_affine;
mod sphere;
mod table;
mod tipped_paraboloid;
mod truncated_cone;
mod truncated_paraboloid;

pub use asperities::Heights;
pub use error::ProfileError;
pub(crate) use foundation::{Foundation, Sums};
pub(crate) use kappa::kappa;
pub(crate) use kind::Peak;
pub use root_series::RootSeries;
pub use self_affine::{RoughnessError, SelfAffine};

use crate::ContactError;
use crate::quadrature::{GAUSS, gauss};
use asperities::Asperities;
use chart::Chart;
use flat::Flat;
use graded::Graded;
use kind::Kind;
use power::Power;
use powers::Powers;
use rough::Rough;
use rounded_flat::RoundedFlat;
use sphere::Sphere;
use std::sync::Arc;
use tipped_paraboloid::TippedParaboloid;
use truncated_cone::TruncatedCone;
use truncated_paraboloid::TruncatedParaboloid;

/// Profile of the gap between two bodies.
///
/// The MDR replaces a profile f(r) by the one-dimensional profile g(x) (4.20), a row of springs. The spring at x touches when the
/// indentation h exceeds g(x). Forces depend only on the length of the row below a height. A contact therefore needs three functions:
/// the normal stiffness, force and energy over E\*. These are m(h) = [`Self::reduced_stiffness`], M(h) = ∫₀ʰ m =
/// [`Self::reduced_force`] and N(h) = ∫₀ʰ M = [`Self::reduced_energy`]. All three are 0 for h ≤ 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    shape: Shape,
}

/// Kinds of profiles. An enum allows inlining, cloning and comparison.
#[derive(Debug, Clone, PartialEq)]
enum Shape {
    Flat(Flat),
    Power(Power),
    Sphere(Sphere),
    Foundation(Foundation),
    TruncatedCone(TruncatedCone),
    TruncatedParaboloid(TruncatedParaboloid),
    RoundedFlat(RoundedFlat),
    TippedParaboloid(TippedParaboloid),
    Powers(Powers),
    Asperities(Asperities),
    Graded(Graded),
    /// Table of points or normal law, shared by all clones of a contact.
    Chart(Arc<Chart>),
    /// Long list of springs.
    Rough(Arc<Rough>),
}

/// Calls a method of the kind of profile. A `match` allows the compiler to inline power laws.
macro_rules! of_kind {
    ($profile:expr, $kind:ident => $answer:expr) => {
        match &$profile.shape {
            Shape::Flat($kind) => $answer,
            Shape::Power($kind) => $answer,
            Shape::Sphere($kind) => $answer,
            Shape::Foundation($kind) => $answer,
            Shape::TruncatedCone($kind) => $answer,
            Shape::TruncatedParaboloid($kind) => $answer,
            Shape::RoundedFlat($kind) => $answer,
            Shape::TippedParaboloid($kind) => $answer,
            Shape::Powers($kind) => $answer,
            Shape::Asperities($kind) => $answer,
            Shape::Graded($kind) => $answer,
            Shape::Chart($kind) => $answer,
            Shape::Rough($kind) => $answer,
        }
    };
}

impl Profile {
    /// Returns the reduced stiffness m(h), m: the normal stiffness over E\*.
    ///
    /// m(h) is the total length of the foundation with g < h; for a convex profile 2a(h).
    #[inline(always)]
    pub fn reduced_stiffness(&self, h: f64) -> f64 {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_stiffness(h),
            _ => self.other_reduced_stiffness(h),
        }
    }

    /// Returns m(h) of profiles that are no power laws.
    #[inline(never)]
    fn other_reduced_stiffness(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_stiffness(h))
    }

    /// Returns the reduced force M(h) = ∫₀ʰ m, m²: the normal force over E\* (4.26).
    #[inline(always)]
    pub fn reduced_force(&self, h: f64) -> f64 {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_force(h),
            _ => self.other_reduced_force(h),
        }
    }

    /// Returns M(h) of profiles that are no power laws. A separate function keeps the code of power laws short.
    #[inline(never)]
    fn other_reduced_force(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_force(h))
    }

    /// Returns M(h) (m²) and m(h) (m). For a power law both need only one root.
    #[inline(always)]
    pub(crate) fn reduced_force_and_stiffness(&self, h: f64) -> [f64; 2] {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.force_and_stiffness(h),
            _ => [self.other_reduced_force(h), self.reduced_stiffness(h)],
        }
    }

    /// Returns the reduced energy N(h) = ∫₀ʰ M, m³: the normal elastic energy over E\*.
    #[inline]
    pub fn reduced_energy(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_energy(h))
    }

    /// Returns M(h) (m²) and N(h) (m³). For a power law both need only one root.
    #[inline]
    pub(crate) fn reduced_sums(&self, h: f64) -> [f64; 2] {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_sums(h),
            _ => [self.reduced_force(h), self.reduced_energy(h)],
        }
    }

    /// Returns the contact radius a(h), m: m(h)/2 between homogeneous bodies; for a list of springs half the length in contact.
    #[inline]
    pub fn radius(&self, h: f64) -> f64 {
        match &self.shape {
            Shape::Graded(graded) if h > 0.0 => graded.radius(h),
            _ => 0.5 * self.reduced_stiffness(h),
        }
    }

    /// Returns g(a), m: the indentation at which the contact radius is a; 0 for a ≤ 0.
    ///
    /// The result is infinite where no indentation reaches the radius: beyond a flat punch, a sphere, a list of springs or a table.
    /// Flat punches, lists of springs and truncated profiles have one radius for a range of h; the result is its lower end. For a
    /// radius inside a flat the result is 0.
    #[inline]
    pub fn depth(&self, a: f64) -> f64 {
        if a.is_nan() || a <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.depth(a))
    }

    /// Returns dg/da at a > 0; 0 where it is not defined, see [`Self::is_strictly_convex`].
    pub fn depth_slope(&self, a: f64) -> f64 {
        if a.is_nan() || a <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.depth_slope(a))
    }

    /// Returns the gap f(r) of the undeformed bodies, m, at the distance r ≥ 0 (m) from the axis.
    ///
    /// Returns `None` beyond a flat punch, a sphere or the last point of a table, and for a list of springs, asperities, graded bodies and a
    /// normal law. For a power law f = g/`κ_n` (4.20), so r²/2R for the paraboloid.
    pub fn gap(&self, r: f64) -> Option<f64> {
        if r.is_nan() || r < 0.0 {
            return None;
        }
        of_kind!(self, kind => kind.gap(r))
    }

    /// Returns the positions x > 0, m, ascending, at which g or a derivative of g is not smooth. A quadrature over g must be split there.
    pub fn borders(&self) -> &[f64] {
        of_kind!(self, kind => kind.borders())
    }

    /// Returns where the normal pressure is largest; `None` for a list of springs and a normal law, which define no shape in three
    /// dimensions, and between graded bodies.
    pub(crate) fn peak(&self) -> Option<Peak> {
        of_kind!(self, kind => kind.peak())
    }

    /// Returns ∫₀ᵃ g'/x dx, dimensionless, if there is a closed form: the pressure in the centre times π/E\*.
    pub(crate) fn middle_slope_integral(&self, a: f64) -> Option<f64> {
        of_kind!(self, kind => kind.middle_slope_integral(a))
    }

    /// Returns the height at which the reduced stiffness m (m) is reached, m: g(m/2) between homogeneous bodies; see [`Self::depth`].
    pub fn height_of_reduced_stiffness(&self, m: f64) -> f64 {
        match &self.shape {
            Shape::Graded(graded) if m > 0.0 => graded.height_of_reduced_stiffness(m),
            _ => self.depth(0.5 * m),
        }
    }

    /// Returns the contact radius at which the reduced stiffness is m (m), m: m/2 between homogeneous bodies.
    pub(crate) fn radius_of_reduced_stiffness(&self, m: f64) -> f64 {
        match &self.shape {
            Shape::Graded(graded) if m > 0.0 => graded.radius(graded.height_of_reduced_stiffness(m)),
            _ => 0.5 * m,
        }
    }

    /// Returns the height of first touch, m: 0, or the height of the lowest spring of a list.
    #[inline]
    pub fn lowest(&self) -> f64 {
        self.as_foundation().map_or(0.0, |list| list.heights()[0])
    }

    /// Returns the height at which the reduced force M (m²) is reached, m: the inverse of [`Self::reduced_force`].
    ///
    /// For M ≤ 0 this is the height of first touch.
    // The height of first touch avoids a jump of the indentation when a load approaches 0.
    pub fn height_of_reduced_force(&self, force: f64) -> f64 {
        if force.is_nan() || force <= 0.0 {
            return self.lowest();
        }
        of_kind!(self, kind => kind.height_of_reduced_force(force))
    }

    /// Returns the exponent n of a power law, including a sum of powers with one term; `None` for other profiles and the flat punch.
    pub fn exponent(&self) -> Option<f64> {
        of_kind!(self, kind => kind.exponent())
    }

    /// Returns the largest height of the profile, m; `None` if there is no limit.
    ///
    /// A sphere is limited to g(0.999R) = 3.796R, beyond which its functions still return finite numbers. A table and a normal law
    /// end at their last point.
    pub fn reach(&self) -> Option<f64> {
        of_kind!(self, kind => kind.reach())
    }

    /// Returns whether the profile is known only up to a last point, as for tables and normal laws.
    pub fn ends_at_a_point(&self) -> bool {
        matches!(self.shape, Shape::Chart(_))
    }

    /// Fails if an indentation is beyond the last point of the profile.
    #[inline]
    pub(crate) fn check_end(&self, d: f64) -> Result<(), ContactError> {
        match &self.shape {
            Shape::Chart(chart) => chart.check_end(d),
            _ => Ok(()),
        }
    }

    /// Returns whether the stiffness jumps while the indentation grows.
    ///
    /// A list of springs has a jump at each spring. A normal law has a jump where two linear parts of the force law meet.
    // Integrators of high order would otherwise exceed their tolerance at such kinks.
    pub fn has_kinks(&self) -> bool {
        of_kind!(self, kind => kind.has_kinks())
    }

    /// Returns whether the stiffness has a kink, or its derivative a square-root singularity, at an indentation above 0.
    ///
    /// A normal law has kinks at its points. A tipped paraboloid has a singularity where its cone ends.
    pub fn has_bends(&self) -> bool {
        of_kind!(self, kind => kind.has_bends())
    }

    /// Returns the exponent p of the force at small indentations, M ∝ hᵖ for h → 0.
    ///
    /// The exponent is 1 + 1/n for a power law: 3/2 for a paraboloid, 2 for a cone. For flat punches, truncated profiles and lists of
    /// springs it is 1. A motion that touches with a non-zero velocity is smooth in time if p is an integer.
    pub fn first_power(&self) -> f64 {
        of_kind!(self, kind => kind.first_power())
    }

    /// Returns whether each contact radius belongs to exactly one indentation.
    pub fn is_strictly_convex(&self) -> bool {
        of_kind!(self, kind => kind.is_strictly_convex())
    }

    /// Returns ∫ w m dh over a thin strip of heights, with w linear between its values at the ends.
    ///
    /// The integral avoids the cancellation in differences of M or N. Where m is smooth, a five-point Gauss–Legendre rule has a
    /// relative error below 1e-18 for a width of 1/16 of the height.
    pub(crate) fn moment(&self, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> f64 {
        let width = to - from;
        let straight = [low, (high - low) / width];
        match &self.shape {
            Shape::Foundation(foundation) => return foundation.moment([from, to], straight),
            Shape::Rough(rough) => return rough.moment([from, to], straight),
            Shape::Chart(chart) => return chart.moment([from, to], straight),
            _ => {}
        }
        // Above a border m begins with a square root, so the root is the variable of integration.
        if let Some(border) = self.borders().iter().map(|b| self.depth(*b)).find(|b| *b > 0.0 && *b < to) {
            let beyond = from.max(border);
            let density = |h: f64| (low + straight[1] * (h - from)) * self.reduced_stiffness(h);
            let by_root = |root: f64| 2.0 * root * density(border + root * root);
            return gauss([from.min(border), border], density)
                + gauss([(beyond - border).sqrt(), (to - border).sqrt()], by_root);
        }
        let (middle, mean, half) = (0.5 * (from + to), 0.5 * (low + high), 0.5 * (high - low));
        let node = |(x, weight): &(f64, f64)| {
            weight * (mean + half * x) * self.reduced_stiffness(middle + 0.5 * width * x)
        };
        width * GAUSS.iter().map(node).sum::<f64>()
    }

    /// Returns the radius of a flat punch, m; `None` for other profiles.
    pub(crate) fn punch(&self) -> Option<f64> {
        of_kind!(self, kind => kind.punch())
    }

    /// Returns whether the profile defines a shape in three dimensions, and therefore a gap, a pressure and fields.
    ///
    /// All profiles have a shape except lists of springs and normal laws, which define only forces, and graded bodies.
    // A normal law alone does not state that the contact is axisymmetric.
    pub fn has_shape(&self) -> bool {
        self.peak().is_some()
    }

    /// Returns the list of springs, if the profile is one.
    #[inline]
    pub(crate) fn as_foundation(&self) -> Option<&Foundation> {
        match &self.shape {
            Shape::Foundation(list) => Some(list),
            Shape::Rough(line) => Some(line.foundation()),
            _ => None,
        }
    }
}
