//! Profiles of the gap, as what the foundation makes of them: three functions of one number.

mod angle;
mod chart;
mod error;
mod flat;
mod foundation;
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

pub use error::ProfileError;
pub(crate) use foundation::{Foundation, Sums};
pub(crate) use kappa::kappa;
pub(crate) use kind::Peak;
pub use root_series::RootSeries;
pub use self_affine::{RoughnessError, SelfAffine};

use crate::ContactError;
use crate::quadrature::{GAUSS, gauss};
use chart::Chart;
use flat::Flat;
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

/// The profile of the gap between two bodies. Constant.
///
/// A profile f(r) is used through its one-dimensional equivalent g(x) (4.20): springs side by side, the spring
/// at x touching once the indentation h exceeds g(x). For forces all that counts is how much length lies below
/// a height. Normal stiffness, force and energy over E\* are all that a contact asks for: m(h) = [`Self::reduced_stiffness`],
/// M(h) = ∫₀ʰ m = [`Self::reduced_force`] and N(h) = ∫₀ʰ M = [`Self::reduced_energy`]. The three are 0 for h ≤ 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    shape: Shape,
}

/// The kinds of profiles, each in the file of its name with what makes one: an enum, so that an evaluation is a jump and can
/// be inlined, and a contact cloned and compared.
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
    /// A table of points or a normal law; shared by all contacts that are clones of one.
    Chart(Arc<Chart>),
    /// A long list of springs.
    Rough(Arc<Rough>),
}

/// What a kind of profile answers. A match and no table of functions behind a pointer: the compiler sees through it, and
/// power laws, of which nearly all contacts are, cost no call.
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
            Shape::Chart($kind) => $answer,
            Shape::Rough($kind) => $answer,
        }
    };
}

impl Profile {
    /// m(h), m: the normal stiffness over E\*, which is the total length of the foundation with g < h; 2a(h) for a
    /// convex profile.
    #[inline(always)]
    pub fn reduced_stiffness(&self, h: f64) -> f64 {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_stiffness(h),
            _ => self.other_reduced_stiffness(h),
        }
    }

    /// As [`Self::other_reduced_force`].
    #[inline(never)]
    fn other_reduced_stiffness(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_stiffness(h))
    }

    /// M(h) = ∫₀ʰ m, m²: the normal force over E\* (4.26).
    #[inline(always)]
    pub fn reduced_force(&self, h: f64) -> f64 {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_force(h),
            _ => self.other_reduced_force(h),
        }
    }

    /// The profiles that are no power laws, kept out of the way of those that are.
    #[inline(never)]
    fn other_reduced_force(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_force(h))
    }

    /// M(h) (m²) and m(h) (m): of a power law one root serves both.
    #[inline(always)]
    pub(crate) fn reduced_force_and_stiffness(&self, h: f64) -> [f64; 2] {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.force_and_stiffness(h),
            _ => [self.other_reduced_force(h), self.reduced_stiffness(h)],
        }
    }

    /// N(h) = ∫₀ʰ M, m³: the normal elastic energy over E\*.
    #[inline]
    pub fn reduced_energy(&self, h: f64) -> f64 {
        if h.is_nan() || h <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.reduced_energy(h))
    }

    /// M(h) (m²) and N(h) (m³): of a power law one root serves both.
    #[inline]
    pub(crate) fn reduced_sums(&self, h: f64) -> [f64; 2] {
        match &self.shape {
            Shape::Power(shape) if h > 0.0 => shape.reduced_sums(h),
            _ => [self.reduced_force(h), self.reduced_energy(h)],
        }
    }

    /// a(h) = m(h)/2, m: the contact radius; for a foundation given spring by spring half the length in contact.
    #[inline]
    pub fn radius(&self, h: f64) -> f64 {
        0.5 * self.reduced_stiffness(h)
    }

    /// g(a), m: the indentation at which the contact radius is a; 0 for a ≤ 0, infinite where no indentation
    /// reaches (beyond a flat punch's or a sphere's radius, beyond the springs of a list or the points of a table).
    ///
    /// A flat punch and a list of springs take one radius over a whole range of h: this is its lower end. So do radii inside
    /// the flat of a worn profile, which all touch at once.
    #[inline]
    pub fn depth(&self, a: f64) -> f64 {
        if a.is_nan() || a <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.depth(a))
    }

    /// dg/da at a > 0: what the indentation gains per contact radius; 0 where that is not defined, see
    /// [`Self::is_strictly_convex`].
    pub fn depth_slope(&self, a: f64) -> f64 {
        if a.is_nan() || a <= 0.0 {
            return 0.0;
        }
        of_kind!(self, kind => kind.depth_slope(a))
    }

    /// f(r), m: the gap at the distance r ≥ 0 (m) from the axis before anything is pressed; none beyond a flat punch, a
    /// sphere or the last point of a table, and for a foundation given spring by spring or by its normal law, which no
    /// axisymmetric gap need belong to.
    ///
    /// Of a power law f = g/`κ_n` (4.20): r²/2R for the paraboloid.
    pub fn gap(&self, r: f64) -> Option<f64> {
        if r.is_nan() || r < 0.0 {
            return None;
        }
        of_kind!(self, kind => kind.gap(r))
    }

    /// Places x > 0, m, ascending, at which g or a derivative of g is not smooth: where a quadrature over g is to be parted.
    pub fn borders(&self) -> &[f64] {
        of_kind!(self, kind => kind.borders())
    }

    /// Where the normal pressure is largest; none for a list of springs and a normal law, which have no shape in three
    /// dimensions.
    pub(crate) fn peak(&self) -> Option<Peak> {
        of_kind!(self, kind => kind.peak())
    }

    /// ∫₀ᵃ g'/x dx, dimensionless: the pressure in the middle times π/E\*, where there is a closed form.
    pub(crate) fn middle_slope_integral(&self, a: f64) -> Option<f64> {
        of_kind!(self, kind => kind.middle_slope_integral(a))
    }

    /// Height at which the length m (m) is reached, m: g(m/2), with the conventions of [`Self::depth`].
    pub fn height_of_reduced_stiffness(&self, m: f64) -> f64 {
        self.depth(0.5 * m)
    }

    /// Height at which M (m²) is reached, m: the inverse of [`Self::reduced_force`]. For M ≤ 0 the height of first touch: 0, or
    /// that of the lowest spring of a list.
    // Not 0 of a list whose springs begin higher: a load that fades would then end with a jump of the depth, in no time.
    pub fn height_of_reduced_force(&self, force: f64) -> f64 {
        if force.is_nan() || force <= 0.0 {
            return of_kind!(self, kind => kind.lowest());
        }
        of_kind!(self, kind => kind.height_of_reduced_force(force))
    }

    /// Exponent n of a power law, a sum of powers of one term included; none for every other profile, the flat punch (its limit
    /// n → ∞) among them.
    pub fn exponent(&self) -> Option<f64> {
        of_kind!(self, kind => kind.exponent())
    }

    /// Largest height for which the profile stands, m; none if there is no limit.
    ///
    /// A sphere ends where a → R: its height is limited to g(0.999R) = 3.796R, beyond which its functions
    /// still return finite numbers. A table and a normal law end at their last point.
    pub fn reach(&self) -> Option<f64> {
        of_kind!(self, kind => kind.reach())
    }

    /// Whether it ends at the last of the points that it is given by, beyond which nothing is known of it.
    pub fn ends_at_a_point(&self) -> bool {
        matches!(self.shape, Shape::Chart(_))
    }

    /// Fails where an indentation lies beyond the last of the points that it is given by.
    #[inline]
    pub(crate) fn check_end(&self, d: f64) -> Result<(), ContactError> {
        match &self.shape {
            Shape::Chart(chart) => chart.check_end(d),
            _ => Ok(()),
        }
    }

    /// Whether the stiffness jumps as the indentation grows: a list of springs does at each of them, a normal law
    /// where two straight stretches of it meet.
    // Methods of high order see such kinks late: runs with lists came out 20 to 1000 times their tolerance off before anybody
    // asked for this.
    pub fn has_kinks(&self) -> bool {
        of_kind!(self, kind => kind.has_kinks())
    }

    /// Whether the stiffness bends, or its slope has a root, at an indentation above 0: that of a normal law does at its points, that of a
    /// tipped paraboloid where its cone ends.
    ///
    /// What moves the indentation, and what asks for the stiffness itself, passes them.
    pub fn has_bends(&self) -> bool {
        of_kind!(self, kind => kind.has_bends())
    }

    /// Power p of h with which the force begins, M ∝ hᵖ for h → 0: 1 + 1/n of a power law, 3/2 of a paraboloid, 2 of a cone;
    /// 1 where a width touches at once, as of a flat punch, a worn profile and a list of springs.
    ///
    /// A motion that touches with a speed is smooth in time where p is whole.
    pub fn first_power(&self) -> f64 {
        of_kind!(self, kind => kind.first_power())
    }

    /// Whether each contact radius belongs to one indentation only.
    pub fn is_strictly_convex(&self) -> bool {
        of_kind!(self, kind => kind.is_strictly_convex())
    }

    /// ∫ w m dh over a thin strip of heights (its width well below its height) with w straight between its values
    /// at the ends: no difference of M or N, so no cancellation.
    ///
    /// Five nodes of Gauss and Legendre where m is smooth: for a width of 1/16 of the height they miss less than
    /// 1e-18 of it.
    pub(crate) fn moment(&self, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> f64 {
        let width = to - from;
        let straight = [low, (high - low) / width];
        match &self.shape {
            Shape::Foundation(foundation) => return foundation.moment([from, to], straight),
            Shape::Rough(rough) => return rough.moment([from, to], straight),
            Shape::Chart(chart) => return chart.moment([from, to], straight),
            _ => {}
        }
        // Beyond a border m begins with a root: as a function of the root it is smooth.
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

    /// Radius of a flat punch, m; none for every other profile.
    pub(crate) fn punch(&self) -> Option<f64> {
        of_kind!(self, kind => kind.punch())
    }

    /// Whether it has a shape in three dimensions, and so a gap, a pressure and fields: all but lists of springs and normal laws, of
    /// which nothing but the forces is known.
    // A normal law has a foundation, and Abel's inversion makes of it the one axisymmetric shape that it could belong to. No one has
    // said that the contact is axisymmetric.
    pub fn has_shape(&self) -> bool {
        self.peak().is_some()
    }

    /// The foundation, where it is given spring by spring.
    pub(crate) fn as_foundation(&self) -> Option<&Foundation> {
        of_kind!(self, kind => kind.as_foundation())
    }
}
