//! Probability distributions of parameters with their quantile functions.

use super::normal;

/// Distribution of one parameter. All values except probabilities have the unit of the parameter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Spread {
    /// Uniform distribution between two bounds.
    Uniform([f64; 2]),
    /// Normal distribution, optionally truncated to bounds.
    Normal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation, above 0.
        deviation: f64,
        /// Lower and upper bound.
        bounds: Option<[f64; 2]>,
    },
    /// Log-normal distribution: x = median * deviation^z with a standard normal z.
    Lognormal {
        /// Median, above 0.
        median: f64,
        /// Geometric standard deviation, a pure number above 1. Two thirds of the values lie between median / deviation
        /// and median * deviation.
        deviation: f64,
    },
    /// Triangular distribution: the density increases linearly from 0 at `low` to its maximum at `mode`, and decreases
    /// linearly to 0 at `high`.
    Triangular {
        /// Smallest value.
        low: f64,
        /// Most likely value.
        mode: f64,
        /// Largest value.
        high: f64,
    },
}

/// Smallest probability between bounds that counts as non-zero. Smaller probabilities lose significant digits.
const LEAST_PROBABILITY: f64 = 1e-300;

impl Spread {
    /// Returns the quantile function (inverse cumulative distribution) for the probability `p`, 0 < p < 1. The parameters of the
    /// distribution must be valid, see [`fault`](Self::fault).
    pub(crate) fn quantile(&self, p: f64) -> f64 {
        match *self {
            Self::Uniform([low, high]) => within(low + p * (high - low), low, high),
            Self::Normal { mean, deviation, bounds: None } => mean + deviation * normal::inverse(p),
            Self::Normal { mean, deviation, bounds: Some([low, high]) } => {
                let z = truncated((low - mean) / deviation, (high - mean) / deviation, p);
                within(mean + deviation * z, low, high)
            }
            Self::Lognormal { median, deviation } => median * math::powf(deviation, normal::inverse(p)),
            Self::Triangular { low, mode, high } => within(triangular(low, mode, high, p), low, high),
        }
    }

    /// Returns an error message for invalid parameters of the distribution, or `None` for valid parameters.
    pub(crate) fn fault(&self) -> Option<String> {
        match *self {
            Self::Uniform([low, high]) => ordered(low, high),
            Self::Normal { mean, deviation, bounds } => finite("the mean", mean)
                .or_else(|| above("the standard deviation", deviation, 0.0))
                .or_else(|| bounds.and_then(|bounds| unreached(mean, deviation, bounds))),
            Self::Lognormal { median, deviation } => above("the median", median, 0.0)
                .or_else(|| above("the geometric standard deviation", deviation, 1.0)),
            Self::Triangular { low, mode, high } => {
                ordered(low, high).or_else(|| finite("the mode", mode)).or_else(|| outside(low, mode, high))
            }
        }
    }
}

/// Returns the value nearest to `x` between two bounds. Unlike `f64::clamp`, this function accepts bounds in any order.
fn within(x: f64, low: f64, high: f64) -> f64 {
    x.max(low).min(high)
}

/// Returns the quantile of the standard normal distribution truncated to a..b: z with Phi(z) = Phi(a) + p P, where P = Phi(b) - Phi(a).
///
/// A positive z is computed from the probability above z, because a probability near 1 would lose digits in the upper tail.
fn truncated(a: f64, b: f64, p: f64) -> f64 {
    let mass = probability(a, b);
    let below = normal::cumulative(a) + p * mass;
    if below <= 0.5 {
        normal::inverse(below)
    } else {
        -normal::inverse(normal::cumulative(-b) + (1.0 - p) * mass)
    }
}

/// Returns the probability that a standard normal variable lies between a and b, computed from the nearer tail for accuracy.
fn probability(a: f64, b: f64) -> f64 {
    if a > 0.0 {
        normal::cumulative(-a) - normal::cumulative(-b)
    } else {
        normal::cumulative(b) - normal::cumulative(a)
    }
}

/// Returns the quantile of the triangular distribution. With f = (mode - low) / width, the quantile is low + width sqrt(p f) for p <= f,
/// otherwise high - width sqrt((1 - p)(1 - f)).
fn triangular(low: f64, mode: f64, high: f64, p: f64) -> f64 {
    let width = high - low;
    let rising = (mode - low) / width;
    if p <= rising {
        low + width * (p * rising).sqrt()
    } else {
        high - width * ((1.0 - p) * ((high - mode) / width)).sqrt()
    }
}

fn ordered(low: f64, high: f64) -> Option<String> {
    let wrong = || format!("low must be below high, got {} and {}", shown(low), shown(high));
    let wide =
        || format!("low and high must be less than 1.8e308 apart, got {} and {}", shown(low), shown(high));
    finite("low", low)
        .or_else(|| finite("high", high))
        .or_else(|| (low >= high).then(wrong))
        .or_else(|| (!(high - low).is_finite()).then(wide))
}

fn finite(what: &str, x: f64) -> Option<String> {
    (!x.is_finite()).then(|| format!("{what} must be a finite number, got {}", shown(x)))
}

fn above(what: &str, x: f64, least: f64) -> Option<String> {
    let wrong = || format!("{what} must be above {}, got {}", shown(least), shown(x));
    finite(what, x).or_else(|| (x <= least).then(wrong))
}

fn outside(low: f64, mode: f64, high: f64) -> Option<String> {
    let wrong = || {
        format!(
            "the mode must lie between low and high, got {} for {} to {}",
            shown(mode),
            shown(low),
            shown(high)
        )
    };
    (mode < low || mode > high).then(wrong)
}

fn unreached(mean: f64, deviation: f64, [low, high]: [f64; 2]) -> Option<String> {
    let none = || {
        let (low, high) = (shown(low), shown(high));
        format!("the probability between the bounds {low} and {high} is 0")
    };
    let mass = || probability((low - mean) / deviation, (high - mean) / deviation);
    ordered(low, high).or_else(|| (mass() < LEAST_PROBABILITY).then(none))
}

/// Formats a number without unnecessary digits: 0 and 5e-9, not 0.0 or 0.000000005.
fn shown(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn normal(mean: f64, deviation: f64, low: f64, high: f64) -> Spread {
        Spread::Normal { mean, deviation, bounds: Some([low, high]) }
    }

    fn near(found: f64, expected: f64, scale: f64) {
        assert!((found - expected).abs() <= 1e-15 * scale, "{found:?} for {expected:?}");
    }

    /// Columns: mean, deviation, bounds, p and quantile. Phi(z) = Phi(a) + p (Phi(b) - Phi(a)) was solved with mpmath
    /// 1.4.1 at 60 digits. The tolerance is 1e-15 of |mean| + deviation + |quantile|.
    #[test]
    fn a_truncated_normal_distribution_is_accurate_in_both_tails() {
        let table = [
            (1.0, 0.5, 0.0, 3.0, 0.1, 0.41368461330856415),
            (1.0, 0.5, 0.0, 3.0, 0.999999, 2.9964013090556163),
            (1.0, 0.5, 0.0, 3.0, 1e-9, 9.049830390459586e-9),
            (0.0, 1.0, 8.0, 9.0, 0.5, 8.084888899018166),
            (0.0, 1.0, 30.0, 40.0, 0.01, 30.00033463833214),
            (0.0, 1.0, 30.0, 40.0, 0.99, 30.152946658582152),
            (0.0, 1.0, -40.0, -30.0, 0.01, -30.152946658582152),
            (0.0, 1.0, -1.0, 37.0, 0.9999999999999999, 8.230254527416001),
            (0.0, 1.0, -9.0, -8.0, 0.5, -8.084888899018166),
            (2e-9, 1e-9, 5e-9, 6e-9, 0.25, 5.084246748861947e-9),
            (0.0, 1.0, -0.001, 0.002, 0.7, 0.001099999338500112),
        ];
        for (mean, deviation, low, high, p, x) in table {
            let spread = normal(mean, deviation, low, high);
            assert_eq!(spread.fault(), None);
            near(spread.quantile(p), x, mean.abs() + deviation + x.abs());
        }
    }

    #[test]
    fn a_normal_distribution_without_bounds_is_moved_and_stretched() {
        let spread = Spread::Normal { mean: 3.0, deviation: 2.0, bounds: None };
        near(spread.quantile(0.975), 3.0 + 2.0 * 1.9599639845400538, 7.0);
        assert_eq!(spread.quantile(0.5), 3.0);
    }

    /// Reference: median * deviation^z with z as in `normal`, mpmath 1.4.1 at 60 digits.
    #[test]
    fn a_lognormal_distribution_is_a_power_of_its_deviation() {
        let table = [
            (2.0, 1.5, 0.1, 1.1894877312383232),
            (3e-6, 3.0, 0.999, 8.944102549419389e-5),
            (1.0, 1.01, 1e-9, 0.9420657917780705),
        ];
        for (median, deviation, p, x) in table {
            near(Spread::Lognormal { median, deviation }.quantile(p), x, x);
        }
    }

    /// Reference: low + sqrt(p (high - low)(mode - low)) and its mirror image, mpmath 1.4.1 at 60 digits.
    #[test]
    fn a_triangular_distribution_rises_and_falls() {
        let table = [
            (1.0, 2.0, 4.0, 0.2, 1.7745966692414834),
            (1.0, 2.0, 4.0, 0.9, 3.2254033307585166),
            (0.0, 0.0, 1.0, 1e-12, 5.00000000000125e-13),
            (0.0, 1.0, 1.0, 0.3, 0.5477225575051661),
            (0.1, 0.2, 0.7, 0.9999999998835847, 0.6999940902964077),
        ];
        for (low, mode, high, p, x) in table {
            near(Spread::Triangular { low, mode, high }.quantile(p), x, high);
        }
    }

    #[test]
    fn no_value_leaves_its_bounds() {
        let spreads = [
            Spread::Uniform([0.1, 0.3]),
            Spread::Triangular { low: 0.1, mode: 0.3, high: 0.3 },
            normal(0.0, 1.0, 0.1, 0.3),
            normal(0.0, 1e-3, 0.0, 0.3),
        ];
        for spread in spreads {
            let ends = [f64::MIN_POSITIVE, 0.5f64.powi(53), 0.5, 1.0 - 0.5f64.powi(53)];
            let found = ends.map(|p| spread.quantile(p));
            assert!(found.is_sorted() && found[0] >= 0.0 && found[3] <= 0.3, "{found:?}");
        }
        near(Spread::Uniform([-1.0, 3.0]).quantile(0.25), 0.0, 1.0);
    }

    #[test]
    fn faults_are_told_in_sentences() {
        let triangular = |low, mode, high| Spread::Triangular { low, mode, high };
        let lognormal = |median, deviation| Spread::Lognormal { median, deviation };
        let table = [
            (Spread::Uniform([0.2, 0.1]), "low must be below high, got 0.2 and 0.1"),
            (Spread::Uniform([0.0, f64::NAN]), "high must be a finite number, got NaN"),
            (
                Spread::Uniform([-1e308, 1e308]),
                "low and high must be less than 1.8e308 apart, got -1e308 and 1e308",
            ),
            (normal(0.0, 0.0, 0.0, 1.0), "the standard deviation must be above 0, got 0"),
            (normal(0.0, 1.0, 2.0, 2.0), "low must be below high, got 2 and 2"),
            (normal(0.0, 1.0, 40.0, 50.0), "the probability between the bounds 40 and 50 is 0"),
            (normal(0.0, 5e-9, -2.0, -1.0), "the probability between the bounds -2 and -1 is 0"),
            (normal(f64::INFINITY, 1.0, 0.0, 1.0), "the mean must be a finite number, got inf"),
            (lognormal(0.0, 2.0), "the median must be above 0, got 0"),
            (lognormal(5e-9, 1.0), "the geometric standard deviation must be above 1, got 1"),
            (triangular(0.0, 2.5, 1.0), "the mode must lie between low and high, got 2.5 for 0 to 1"),
            (triangular(1.0, 1.0, 1.0), "low must be below high, got 1 and 1"),
        ];
        for (spread, fault) in table {
            assert_eq!(spread.fault().as_deref(), Some(fault));
        }
        let fine = [
            triangular(0.0, 0.0, 1.0),
            lognormal(1.0, 1.1),
            Spread::Uniform([0.0, 1.0]),
            normal(0.0, 1.0, 37.0, 38.0),
        ];
        assert!(fine.iter().all(|spread| spread.fault().is_none()));
    }
}
