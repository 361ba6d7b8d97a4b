//! Bouc–Wen model of hysteresis.

/// Bouc–Wen hysteresis y = v - z with z' = A v' - β|v'||z|ⁿ⁻¹z - γ v'|z|ⁿ, where v is the input stroke.
///
/// The parameters are `slope` A, `limit` z_m = (A/(β + γ))^{1/n}, `share` β/(β + γ), and `exponent` n. A is the fraction of a small motion
/// by which the output lags. z_m is the largest lag. With ζ = z/z_m the equation is dζ/dv = (A/z_m)(1 - |ζ|ⁿ) while |z| grows. While |z|
/// decreases, the equation is dζ/dv = (A/z_m)(1 + (2 share - 1)|ζ|ⁿ). For n = 1 both solutions are exponentials of v.
///
/// Source: Bouc (1967); Wen, Journal of the Engineering Mechanics Division 102 (1976) 249; for piezo actuators: Low and Guo, Journal of
/// Microelectromechanical Systems 4 (1995) 230.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoucWen {
    slope: f64,
    limit: f64,
    share: f64,
    exponent: f64,
}

/// Reason why Bouc–Wen parameters are invalid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum BoucWenError {
    /// The share is out of range, so z would not be bounded by z_m.
    #[error("expected a share from 0.5 to 1, got {0}")]
    Share(f64),
    /// The slope is out of range: there would be no hysteresis, or the output would not follow the direction of the input.
    #[error("expected a slope above 0 and, with this share, below {most}, got {got}")]
    Slope {
        /// Upper limit of the slope, 1/(2 share).
        most: f64,
        /// Value of the slope that was given.
        got: f64,
    },
    /// The limit z_m is not above 0 or not finite.
    #[error("expected a limit above 0, got {0}")]
    Limit(f64),
    /// The exponent n is out of range.
    #[error("expected an exponent from 1 to {most}, got {got}", most = BoucWen::SHARPEST)]
    Exponent {
        /// Value of the exponent that was given.
        got: f64,
    },
}

/// Longest integration step in v, in units of z_m/A, with which the fourth-order method has an error of about 1e-12 z_m.
const STRIDE: f64 = 1.0 / 256.0;
/// Number of Newton steps that locate the zero crossing of z.
const NEWTON: u32 = 4;
/// Change of v in units of z_m/A after which the initial z has no influence.
const FORGOTTEN: f64 = 64.0;

impl BoucWen {
    /// Largest exponent n.
    pub const SHARPEST: f64 = 16.0;

    /// Creates the model.
    ///
    /// # Errors
    ///
    /// Fails if a parameter is out of its range: `share` in [½, 1], 0 < `slope` < 1/(2 share), `limit` above 0, `exponent` in [1, 16].
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

    /// Returns the limit z_m, in the unit of the input.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Returns the slope A of the lag z over the input at z = 0.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Returns n A/z_m, the rate per unit of the input at which z approaches ±z_m.
    pub fn settling(&self) -> f64 {
        self.exponent * self.slope / self.limit
    }

    /// Returns dz/dv and its derivative with respect to z on one branch.
    ///
    /// `sense` is the direction of v and `side` the sign of z. The branch continues smoothly beyond z = 0.
    pub fn gradient(&self, z: f64, sense: f64, side: f64) -> (f64, f64) {
        let (n, size) = (self.exponent, side * z / self.limit);
        // Beyond z = 0, a power with a whole exponent continues as a polynomial; any other power is 0.
        let (power, slope) = if n.fract() == 0.0 {
            (size.powi(n as i32), n * size.powi(n as i32 - 1))
        } else {
            (math::powf(size.max(0.0), n), n * math::powf(size.max(0.0), n - 1.0))
        };
        let held = if sense * side > 0.0 { 1.0 } else { 1.0 - 2.0 * self.share };
        (self.slope * (1.0 - held * power), -self.slope * held * slope * side / self.limit)
    }

    /// Returns z after a monotone change of v by `way`.
    ///
    /// For n = 1 the solution is exact. For other n the classical Runge–Kutta method integrates the equation.
    pub fn along(&self, z: f64, way: f64) -> f64 {
        if way == 0.0 {
            return z;
        }
        let (sense, left) = (way.signum(), way.abs() * self.slope / self.limit);
        // A falling input v is mirrored, so that the equation is solved for a rising input.
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
                // The branch of the equation changes at z = 0, which Newton's method locates.
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

    /// Returns the solution for n = 1, in units of z_m. `left` is the rise of v in units of z_m/A.
    fn along_exponentials(&self, x: f64, left: f64) -> f64 {
        let q = 2.0 * self.share - 1.0;
        if x >= 0.0 {
            return 1.0 - (1.0 - x) * math::exp(-left);
        }
        // While |z| decreases, x' = 1 - qx up to x = 0.
        let to_zero = if q > 0.0 { math::ln_1p(-q * x) / q } else { -x };
        if left > to_zero {
            return 1.0 - math::exp(to_zero - left);
        }
        if q > 0.0 { (1.0 - (1.0 - q * x) * math::exp(-q * left)) / q } else { x + left }
    }
}

/// Performs one Runge–Kutta step of length h for x' = f(x).
fn runge_kutta(x: f64, h: f64, f: impl Fn(f64) -> f64) -> f64 {
    let a = f(x);
    let b = f(x + 0.5 * h * a);
    let c = f(x + 0.5 * h * b);
    let d = f(x + h * c);
    x + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
}
