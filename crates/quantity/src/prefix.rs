//! SI prefixes for readable numbers.

/// SI prefix. For µ, 12 µm = 12 × `factor` m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prefix {
    /// Symbol, empty without a prefix.
    pub symbol: &'static str,
    /// Power of ten.
    pub exponent: i32,
}

/// Symbols of 10⁻²⁴, 10⁻²¹, … 10²⁴.
const SYMBOLS: [&str; 17] =
    ["y", "z", "a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T", "P", "E", "Z", "Y"];

impl Prefix {
    /// No prefix.
    pub const NONE: Self = Self { symbol: "", exponent: 0 };

    /// Returns the prefix that scales a magnitude to [1, 1000). Returns [`Self::NONE`] for zero, for numbers that are not finite, and
    /// outside 1e-24 to 1e27.
    pub fn of_magnitude(magnitude: f64) -> Self {
        let magnitude = magnitude.abs();
        // Rounds up: 0.001 m computed as 0.9999999999 mm is shown as 1 mm.
        let magnitude = magnitude * (1.0 + 1e-9);
        if !(magnitude.is_finite() && (1e-24..1e27).contains(&magnitude)) {
            return Self::NONE;
        }
        let mut exponent = 3 * (math::log10(magnitude) / 3.0).floor() as i32;
        // The logarithm may round to the wrong side of a power of ten.
        if magnitude >= 1000.0 * ten(exponent) {
            exponent += 3;
        } else if magnitude < ten(exponent) {
            exponent -= 3;
        }
        Self::of_exponent(exponent)
    }

    /// Returns the prefix for the largest finite magnitude of a series.
    pub fn of_series(values: &[f64]) -> Self {
        let finite = values.iter().filter(|v| v.is_finite());
        Self::of_magnitude(finite.fold(0.0, |most: f64, v| most.max(v.abs())))
    }

    /// Returns the prefix for a magnitude in this unit, or [`Self::NONE`] if the unit takes no prefix ([`takes_prefix`]).
    pub fn of_quantity(magnitude: f64, unit: &str) -> Self {
        if takes_prefix(unit) { Self::of_magnitude(magnitude) } else { Self::NONE }
    }

    /// Returns the prefix as a factor: a value in the unit is this factor times the value in the prefixed unit.
    pub fn factor(&self) -> f64 {
        ten(self.exponent)
    }

    /// Converts a value to the prefixed unit. The function uses exact powers of ten if possible, so that 12e-6 m gives exactly 12 µm.
    pub fn apply(&self, value: f64) -> f64 {
        if self.exponent < 0 { value * ten(-self.exponent) } else { value / ten(self.exponent) }
    }

    fn of_exponent(exponent: i32) -> Self {
        let place = usize::try_from(exponent / 3 + 8).unwrap_or(8);
        SYMBOLS.get(place).map_or(Self::NONE, |symbol| Self { symbol, exponent })
    }
}

/// Returns whether a unit takes an SI prefix. Exceptions are the empty unit, 1, per cent, degrees, minutes, hours and kg. Units that
/// begin with a power, such as m², are also excluded, because the power would apply to the prefix.
pub fn takes_prefix(unit: &str) -> bool {
    let leading: String = unit.trim().chars().take_while(|c| c.is_alphabetic()).collect();
    let rest = unit.trim()[leading.len()..].chars().next();
    !matches!(leading.as_str(), "" | "kg" | "deg" | "min" | "h")
        && !matches!(rest, Some('²' | '³' | '⁴' | '^' | '⁻'))
}

/// Returns 10ᵏ, correctly rounded for every exponent k of a prefix.
fn ten(k: i32) -> f64 {
    // `powi` rounds at each multiplication and is exact up to 10²². Outside this range, one quotient or product of exact powers
    // is rounded once.
    match k {
        0..=22 => 10_f64.powi(k),
        23.. => 1e22 * 10_f64.powi(k - 22),
        _ if k >= -22 => 1.0 / 10_f64.powi(-k),
        _ => 1e-22 / 10_f64.powi(-k - 22),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_land_between_one_and_a_thousand() {
        for (value, symbol) in [
            (1e-9, "n"),
            (999e-9, "n"),
            (1e-6, "µ"),
            (0.001 * (1.0 - 1e-12), "m"),
            (0.03, "m"),
            (1.0, ""),
            (999.0, ""),
            (-4.5e4, "k"),
            (1e-15, "f"),
            (1e12, "T"),
            (0.0, ""),
            (f64::NAN, ""),
            (f64::INFINITY, ""),
            (1e300, ""),
            (5e-324, ""),
        ] {
            assert_eq!(Prefix::of_magnitude(value).symbol, symbol, "{value:e}");
        }
        assert_eq!(Prefix::of_series(&[f64::NAN, 1e-7, -2e-6]).symbol, "µ");
        assert_eq!(Prefix::of_series(&[]).symbol, "");
        for k in -24..27 {
            let value: f64 = format!("1e{k}").parse().unwrap();
            let shown = Prefix::of_magnitude(value).apply(value);
            assert!((0.999_999..1000.0).contains(&shown), "1e{k} shows as {shown}");
        }
    }

    #[test]
    fn powers_of_ten_are_rounded_once() {
        for k in -24..=24 {
            let exact: f64 = format!("1e{k}").parse().unwrap();
            assert!((ten(k) / exact - 1.0).abs() <= 2.3e-16, "1e{k}");
        }
        let micro = Prefix::of_magnitude(12e-6);
        assert_eq!(micro.apply(12e-6), 12.0);
    }

    #[test]
    fn some_units_take_no_prefix() {
        for unit in ["m", "N", "m/s", "N/m", "J", "s", "rad", "Pa", "N s/m"] {
            assert!(takes_prefix(unit), "{unit}");
        }
        for unit in ["", "1", "%", "°", "deg", "kg", "m²", "m^2", "m³", "-"] {
            assert!(!takes_prefix(unit), "{unit}");
        }
        assert_eq!(Prefix::of_quantity(1e-6, "m²"), Prefix::NONE);
    }
}
