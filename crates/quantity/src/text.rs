//! Formats numbers with units.

use crate::{Prefix, Real};

/// Default and maximum number of significant digits.
const DIGITS: usize = 4;
const MOST_DIGITS: usize = 12;

/// Formats a value with four significant digits and an SI prefix. Values in kg are shown in g with a prefix.
pub fn quantity(value: Real, unit: &str) -> String {
    in_digits(value, unit, DIGITS)
}

/// Formats values with the smallest number of digits (4 to 12) at which neighbouring values that differ have different texts.
pub fn apart(values: &[f64], unit: &str) -> Vec<String> {
    let told = |digits| values.iter().map(|value| in_digits(Real(*value), unit, digits)).collect::<Vec<_>>();
    let differ = |told: &[String]| {
        let mut pairs = values.windows(2).zip(told.windows(2));
        pairs.all(|(values, told)| values[0] == values[1] || told[0] != told[1])
    };
    (DIGITS..MOST_DIGITS).map(told).find(|told| differ(told)).unwrap_or_else(|| told(MOST_DIGITS))
}

fn in_digits(value: Real, unit: &str, digits: usize) -> String {
    let (base, scaled) =
        unit.strip_prefix('k').filter(|unit| unit.starts_with('g')).map_or((unit, 1.0), |grams| (grams, 1e3));
    let prefix = Prefix::of_magnitude(scaled * value.0);
    let shown = prefix.apply(scaled * value.0);
    // 9.9996 is shown as 10.00, not as 10.000.
    let rounding = 0.5 * 0.1_f64.powi(digits as i32 - 1);
    let behind = match shown.abs() {
        x if x >= 100.0 * (1.0 - 0.1 * rounding) => digits - 3,
        x if x >= 10.0 * (1.0 - 0.1 * rounding) => digits - 2,
        _ => digits - 1,
    };
    // The value is below the smallest prefix.
    if shown != 0.0 && shown.abs() < 1.0 - rounding {
        let behind = digits - 1;
        return format!("{:.behind$e} {unit}", value.0);
    }
    if shown == 0.0 { format!("0 {unit}") } else { format!("{shown:.behind$} {}{base}", prefix.symbol) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_shown() {
        assert_eq!(quantity(Real(161.847e-9), "m"), "161.8 nm");
        assert_eq!(quantity(Real(-1.5e-5), "m/s"), "-15.00 µm/s");
        assert_eq!(quantity(Real(0.0), "J"), "0 J");
        assert_eq!([0.5, 2.0].map(|mass| quantity(Real(mass), "kg")), ["500.0 g", "2.000 kg"]);
        assert_eq!(quantity(Real(9.999999999996e-6), "s"), "10.00 µs");
        assert_eq!(quantity(Real(0.0999999999), "s"), "100.0 ms");
        assert_eq!(quantity(Real(9.999e-6), "s"), "9.999 µs");
        assert_eq!(quantity(Real(2.0), "s"), "2.000 s");
        assert_eq!(quantity(Real(-1.2347e-30), "kg"), "-1.235e-30 kg");
    }

    #[test]
    fn what_differs_is_told_apart() {
        assert_eq!(apart(&[0.091, 0.092], "s"), ["91.00 ms", "92.00 ms"]);
        assert_eq!(
            apart(&[2999.0, 2999.2, 2999.2, 3000.0], "s"),
            ["2.9990 ks", "2.9992 ks", "2.9992 ks", "3.0000 ks"]
        );
        assert_eq!(apart(&[1.0, 1.0 + 1e-15], "s"), ["1.00000000000 s", "1.00000000000 s"]);
    }
}
