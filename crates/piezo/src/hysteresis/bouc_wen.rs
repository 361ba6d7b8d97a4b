//! The law of Bouc and Wen.

/// y = v - z with z' = A v' - β|v'||z|ⁿ⁻¹z - γ v'|z|ⁿ: the stroke v that is asked for, less what z keeps back.
///
/// Given by numbers with a meaning: `slope` A is the part of a small motion that is kept back, `limit` z_m = (A/(β + γ))^{1/n}
/// the most that ever is, `share` β/(β + γ), and n. With ζ = z/z_m the law is dζ/dv = (A/z_m)(1 - |ζ|ⁿ) where z grows and
/// (A/z_m)(1 + (2 share - 1)|ζ|ⁿ) where it goes back. For n = 1 both are exponentials of v, whatever the time taken.
///
/// Source: R. Bouc (1967); Y.-K. Wen, Journal of the Engineering Mechanics Division 102 (1976) 249; T. S. Low and W. Guo, Journal
/// of Microelectromechanical Systems 4 (1995) 230, for piezo actuators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoucWen {
    slope: f64,
    limit: f64,
    share: f64,
    exponent: f64,
}

/// Why a law cannot be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum BoucWenError {
    /// z would not be bounded by z_m.
    #[error("expected a share from 0.5 to 1, got {0}")]
    Share(f64),
    /// Nothing is kept back, or the output turns before its input.
    #[error("expected a slope above 0 and, with this share, below {most}, got {got}")]
    Slope {
        /// 1/(2 share).
        most: f64,
        /// As given.
        got: f64,
    },
    /// z_m.
    #[error("expected a limit above 0, got {0}")]
    Limit(f64),
    /// n.
    #[error("expected an exponent from 1 to {most}, got {got}", most = BoucWen::SHARPEST)]
    Exponent {
        /// As given.
        got: f64,
    },
}

/// Longest step of a jump, in units of z_m/A: with it the fourth order leaves about 1e-12 of z_m.
const STRIDE: f64 = 1.0 / 256.0;
/// Steps to where z comes through 0; each about squares what is missed, at first less than a stride.
const NEWTON: u32 = 4;
/// Beyond so many units nothing of an old z is left.
const FORGOTTEN: f64 = 64.0;

impl BoucWen {
    /// Largest exponent: a law with a sharper knee has none that a step could follow.
    pub const SHARPEST: f64 = 16.0;

    /// # Errors
    ///
    /// Where a parameter is out of its range: share in [½, 1] (z stays within z_m), 0 < slope < 1/(2 share) (y goes the way of v),
    /// limit above 0, exponent in [1, 16].
    pub fn new(slope: f64, limit: f64, share: f64, exponent: f64) -> Result<Self, BoucWenError> {
        if !(0.5..=1.0).contains(&share) {
            return Err(BoucWenError::Share(share));
        }
        let most = 0.5 / share;
        if !(slope > 0.0 && slope < most) {
            return Err(BoucWenError::Slope { most, got: slope });
        }
        if !(limit > 0.0 && limit < f64::INFINITY) {
            return Err(BoucWenError::Limit(limit));
        }
        if !(1.0..=Self::SHARPEST).contains(&exponent) {
            return Err(BoucWenError::Exponent { got: exponent });
        }
        Ok(Self { slope, limit, share, exponent })
    }

    /// z_m, in the unit of the input.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// A.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// n A/z_m, in 1 over the unit of the input: how fast z settles along the way of v as it comes to ±z_m.
    pub fn settling(&self) -> f64 {
        self.exponent * self.slope / self.limit
    }

    /// dz/dv and its own derivative by z, on the branch on which v goes in a sense and z has a sign (`side`); it goes on
    /// smoothly beyond z = 0.
    pub fn gradient(&self, z: f64, sense: f64, side: f64) -> (f64, f64) {
        let (n, size) = (self.exponent, side * z / self.limit);
        // Beyond 0 a whole power goes on as a polynomial, another one stays 0.
        let (power, slope) = if n.fract() == 0.0 {
            (size.powi(n as i32), n * size.powi(n as i32 - 1))
        } else {
            (math::powf(size.max(0.0), n), n * math::powf(size.max(0.0), n - 1.0))
        };
        let held = if sense * side > 0.0 { 1.0 } else { 1.0 - 2.0 * self.share };
        (self.slope * (1.0 - held * power), -self.slope * held * slope * side / self.limit)
    }

    /// z after v has gone straight on by `way`.
    ///
    /// n = 1 by its exponentials, others by steps of the classical Runge–Kutta method.
    pub fn along(&self, z: f64, way: f64) -> f64 {
        if way == 0.0 {
            return z;
        }
        let (sense, left) = (way.signum(), way.abs() * self.slope / self.limit);
        // Mirrored: v rises.
        let (mut x, mut left) = (sense * z / self.limit, left.min(FORGOTTEN));
        if self.exponent == 1.0 {
            return sense * self.limit * self.along_exponentials(x, left);
        }
        let rate = |x: f64, side: f64| self.gradient(x * self.limit, 1.0, side).0 / self.slope;
        let side = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
        while left > 0.0 {
            let (mut h, s) = (left.min(STRIDE), side(x));
            let mut next = runge_kutta(x, h, |x| rate(x, s));
            if s < 0.0 && next > 0.0 {
                // To zero first: there the branch changes. Newton's steps, of a slope near 1.
                for _ in 0..NEWTON {
                    h -= next / rate(next, s);
                    next = runge_kutta(x, h, |x| rate(x, s));
                }
                next = 0.0;
            }
            (x, left) = (next, left - h);
        }
        sense * self.limit * x
    }

    /// The same for n = 1 in units of z_m, v rising by `left` of its own.
    fn along_exponentials(&self, x: f64, left: f64) -> f64 {
        let q = 2.0 * self.share - 1.0;
        if x >= 0.0 {
            return 1.0 - (1.0 - x) * math::exp(-left);
        }
        // Going back: x' = 1 - qx up to 0.
        let to_zero = if q > 0.0 { math::ln_1p(-q * x) / q } else { -x };
        if left > to_zero {
            return 1.0 - math::exp(to_zero - left);
        }
        if q > 0.0 { (1.0 - (1.0 - q * x) * math::exp(-q * left)) / q } else { x + left }
    }
}

/// A step of length h of x' = f(x).
fn runge_kutta(x: f64, h: f64, f: impl Fn(f64) -> f64) -> f64 {
    let a = f(x);
    let b = f(x + 0.5 * h * a);
    let c = f(x + 0.5 * h * b);
    let d = f(x + h * c);
    x + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
}
