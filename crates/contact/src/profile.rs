//! Profiles of the gap, as what the foundation makes of them: three functions of one number.

mod error;
mod foundation;
mod gap;
mod kappa;
mod power;
mod sphere;

pub use error::ProfileError;
pub(crate) use foundation::Foundation;

use crate::quadrature::GAUSS;
use error::positive;
use power::Power;
use sphere::Sphere;

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

/// The kinds of profile: an enum, so that an evaluation is a jump and can be inlined, and a contact cloned and compared.
#[derive(Debug, Clone, PartialEq)]
enum Shape {
    Flat { radius: f64 },
    Power(Power),
    Sphere(Sphere),
    Foundation(Foundation),
}

impl Profile {
    /// A flat punch of radius b (m): g = 0 for |x| < b, so m = 2b at every h > 0.
    pub fn flat(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Flat { radius: positive(radius, ProfileError::Radius)? } })
    }

    /// A cone f = r tanθ, given its slope tanθ: g = (π/2) tanθ |x|.
    pub fn cone(slope: f64) -> Result<Self, ProfileError> {
        let slope = positive(slope, ProfileError::Slope)?;
        Ok(Self { shape: Shape::Power(Power::new(std::f64::consts::FRAC_PI_2 * slope, 1.0)?) })
    }

    /// A paraboloid f = r²/2R of radius of curvature R (m), the Hertz contact: g = x²/R, M = (4/3)√R h^{3/2}.
    pub fn paraboloid(radius: f64) -> Result<Self, ProfileError> {
        let radius = positive(radius, ProfileError::Radius)?;
        Ok(Self { shape: Shape::Power(Power::paraboloid(radius)?) })
    }

    /// A sphere of radius R (m), exact: f = R-√(R²-r²), g = (x/2) ln((R+x)/(R-x)).
    ///
    /// Not the paraboloid: at equal depth the contact radius is smaller by (a/R)²/6, 1.7e-5 at a/R = 0.01.
    pub fn sphere(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Sphere(Sphere::new(positive(radius, ProfileError::Radius)?)) })
    }

    /// A power law f = A rⁿ, A in m^{1-n}, n > 0: g = `κ_n` A |x|ⁿ, `κ_n` = √π Γ(n/2+1)/Γ((n+1)/2).
    pub fn power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        positive(coefficient, ProfileError::Coefficient)?;
        positive(exponent, ProfileError::Exponent)?;
        let foundation = kappa::kappa(exponent) * coefficient;
        Ok(Self { shape: Shape::Power(Power::new(foundation, exponent)?) })
    }

    /// A power law given by its foundation, g = B |x|ⁿ, B in m^{1-n}, n > 0.
    pub fn foundation_power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Power(Power::new(coefficient, exponent)?) })
    }

    /// A foundation given spring by spring: heights (m, at least 0, in any order) and the length of each (m).
    ///
    /// So enters a rough line g(x), monotone or not: the distribution of its heights alone matters.
    pub fn foundation(heights: &[f64], lengths: &[f64]) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Foundation(Foundation::new(heights, lengths)?) })
    }

    /// m(h), m: the normal stiffness over E\*, which is the total length of the foundation with g < h; 2a(h) for a
    /// convex profile.
    #[inline]
    pub fn reduced_stiffness(&self, h: f64) -> f64 {
        match &self.shape {
            _ if h.is_nan() || h <= 0.0 => 0.0,
            Shape::Flat { radius } => 2.0 * radius,
            Shape::Power(shape) => shape.reduced_stiffness(h),
            Shape::Sphere(shape) => shape.reduced_stiffness(h),
            Shape::Foundation(shape) => shape.reduced_stiffness(h),
        }
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
    // W1
    #[inline(never)]
    fn other_reduced_force(&self, h: f64) -> f64 {
        match &self.shape {
            _ if h.is_nan() || h <= 0.0 => 0.0,
            Shape::Flat { radius } => 2.0 * radius * h,
            Shape::Power(shape) => shape.reduced_force(h),
            Shape::Sphere(shape) => shape.reduced_force(h),
            Shape::Foundation(shape) => shape.reduced_force(h),
        }
    }

    /// N(h) = ∫₀ʰ M, m³: the normal elastic energy over E\*.
    #[inline]
    pub fn reduced_energy(&self, h: f64) -> f64 {
        match &self.shape {
            _ if h.is_nan() || h <= 0.0 => 0.0,
            Shape::Flat { radius } => radius * h * h,
            Shape::Power(shape) => shape.reduced_energy(h),
            Shape::Sphere(shape) => shape.reduced_energy(h),
            Shape::Foundation(shape) => shape.reduced_energy(h),
        }
    }

    /// a(h) = m(h)/2, m: the contact radius; for a foundation given spring by spring half the length in contact.
    #[inline]
    pub fn radius(&self, h: f64) -> f64 {
        0.5 * self.reduced_stiffness(h)
    }

    /// g(a), m: the indentation at which the contact radius is a; 0 for a ≤ 0, infinite where no indentation
    /// reaches (beyond a flat punch's or a sphere's radius, beyond the springs of a list).
    ///
    /// A flat punch and a list of springs take one radius over a whole range of h: this is its lower end.
    #[inline]
    pub fn depth(&self, a: f64) -> f64 {
        match &self.shape {
            _ if a.is_nan() || a <= 0.0 => 0.0,
            Shape::Flat { radius } => {
                if a > *radius {
                    f64::INFINITY
                } else {
                    0.0
                }
            }
            Shape::Power(shape) => shape.depth(a),
            Shape::Sphere(shape) => shape.depth(a),
            Shape::Foundation(shape) => shape.height_of_reduced_stiffness(2.0 * a),
        }
    }

    /// dg/da at a > 0: what the indentation gains per contact radius; 0 where that is not defined, see
    /// [`Self::is_strictly_convex`].
    pub fn depth_slope(&self, a: f64) -> f64 {
        match &self.shape {
            _ if a.is_nan() || a <= 0.0 => 0.0,
            Shape::Power(shape) => shape.exponent() * shape.depth(a) / a,
            Shape::Sphere(shape) => shape.depth_slope(a),
            Shape::Flat { .. } | Shape::Foundation(_) => 0.0,
        }
    }

    /// Height at which the length m (m) is reached, m: g(m/2), with the conventions of [`Self::depth`].
    pub fn height_of_reduced_stiffness(&self, m: f64) -> f64 {
        self.depth(0.5 * m)
    }

    /// Height at which M (m²) is reached, m: the inverse of [`Self::reduced_force`]; 0 for M ≤ 0.
    pub fn height_of_reduced_force(&self, force: f64) -> f64 {
        match &self.shape {
            _ if force.is_nan() || force <= 0.0 => 0.0,
            Shape::Flat { radius } => force / (2.0 * radius),
            Shape::Power(shape) => shape.height_of_reduced_force(force),
            Shape::Sphere(shape) => shape.height_of_reduced_force(force),
            Shape::Foundation(shape) => shape.height_of_reduced_force(force),
        }
    }

    /// Exponent n of a power law; none for every other profile, the flat punch (its limit n → ∞) included.
    pub fn exponent(&self) -> Option<f64> {
        match &self.shape {
            Shape::Power(shape) => Some(shape.exponent()),
            _ => None,
        }
    }

    /// Largest height for which the profile stands, m; none if there is no limit.
    ///
    /// A sphere ends where a → R: its height is limited to g(0.999R) = 3.796R, beyond which its functions
    /// still return finite numbers.
    pub fn reach(&self) -> Option<f64> {
        match &self.shape {
            Shape::Sphere(shape) => Some(shape.reach()),
            _ => None,
        }
    }

    /// Whether the stiffness jumps as the indentation grows: a list of springs does at each of them.
    // Methods of high order see such kinks late: runs with lists came out 20 to 1000 times their tolerance off before anybody
    // asked for this.
    pub fn has_kinks(&self) -> bool {
        matches!(self.shape, Shape::Foundation(_))
    }

    /// Whether each contact radius belongs to one indentation only.
    pub fn is_strictly_convex(&self) -> bool {
        matches!(self.shape, Shape::Power(_) | Shape::Sphere(_))
    }

    /// ∫ w m dh over a thin strip of heights (its width well below its height) with w straight between its values
    /// at the ends: no difference of M or N, so no cancellation.
    ///
    /// Five nodes of Gauss and Legendre where m is smooth: for a width of 1/16 of the height they miss less than
    /// 1e-18 of it.
    pub(crate) fn moment(&self, [from, to]: [f64; 2], [low, high]: [f64; 2]) -> f64 {
        let width = to - from;
        if let Shape::Foundation(shape) = &self.shape {
            return shape.moment([from, to], [low, (high - low) / width]);
        }
        let (middle, mean, half) = (0.5 * (from + to), 0.5 * (low + high), 0.5 * (high - low));
        let node = |(x, weight): &(f64, f64)| {
            weight * (mean + half * x) * self.reduced_stiffness(middle + 0.5 * width * x)
        };
        width * GAUSS.iter().map(node).sum::<f64>()
    }

    /// The foundation, where it is given spring by spring.
    pub(crate) fn as_foundation(&self) -> Option<&Foundation> {
        match &self.shape {
            Shape::Foundation(shape) => Some(shape),
            _ => None,
        }
    }
}
