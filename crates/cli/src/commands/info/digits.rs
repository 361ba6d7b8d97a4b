//! Number formats of the tables.

use stickslip_quantity::Prefix;
use stickslip_run::Real;
use stickslip_run::quantity;

/// Integers from this value on are written with an exponent.
const MOST: f64 = 1e12;

/// Formats a mass in grams, because kg takes no prefix.
pub(super) fn mass(mass: Real) -> String {
    quantity(Real(1e3 * mass.0), "g")
}

/// Formats a number of bytes with a decimal prefix and two digits.
pub(super) fn bytes(size: Real) -> String {
    let prefix = Prefix::of_magnitude(size.0);
    format!("{} {}B", two_digits(prefix.apply(size.0)), prefix.symbol)
}

/// Formats a non-negative number with two digits.
pub(super) fn two_digits(value: f64) -> String {
    if value < 10.0 {
        return format!("{value:.1}").trim_end_matches(".0").to_owned();
    }
    let unit = math::powf(10.0, math::log10(value).floor() - 1.0);
    whole((value / unit).round() * unit)
}

/// Formats a number without unit with three digits.
pub(crate) fn digits(value: f64) -> String {
    let places =
        if value == 0.0 { 0 } else { (2.0 - math::log10(value.abs()).floor()).clamp(0.0, 9.0) as usize };
    let text = format!("{value:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Formats an integer with spaces between thousands.
pub(super) fn whole(value: f64) -> String {
    if value >= MOST {
        return format!("{value:.1e}");
    }
    let digits = format!("{value:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_have_two_digits_and_counts_their_thousands() {
        assert_eq!([0.0, 4.06, 9.0, 125.4, 10_449.0].map(two_digits), ["0", "4.1", "9", "130", "10 000"]);
        assert_eq!([1_234_567.0, 2e20].map(whole), ["1 234 567", "2.0e20"]);
        assert_eq!(
            [0.0, 1.0, -0.07614, 0.028_801, 0.000_796, 1234.5].map(digits),
            ["0", "1", "-0.0761", "0.0288", "0.000796", "1234"]
        );
        assert_eq!(bytes(Real(3_738_508.0)), "3.7 MB");
    }
}
