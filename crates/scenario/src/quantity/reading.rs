//! Reads quantities from strings of a number and a unit.

use super::HELP;
use crate::document::shown;
use crate::units::{self, Kind, Scale};

/// Reads a text such as `"5 um"`. Returns the value in SI and the dimension. An error is a message, [`HELP`], and a help text.
pub(crate) fn parse(text: &str, kind: Option<Kind>) -> Result<(f64, Kind), String> {
    let wanted = kind.map_or("a quantity", Kind::article);
    let example = kind.unwrap_or(Kind::Length).example();
    let refuse = |help: Option<String>| {
        let help = help.map(|help| format!("{HELP}{help}")).unwrap_or_default();
        Err(format!("expected {wanted} such as \"{example}\", got \"{}\"{help}", shown(text)))
    };
    let trimmed = text.trim_matches(units::is_blank);
    let number = number_length(trimmed);
    let (digits, unit) = trimmed.split_at(number);
    if number == 0 {
        return refuse(number_help(trimmed).map(str::to_owned));
    }
    if unit.is_empty() {
        let help = match kind {
            Some(kind) => format!("add a unit, or write a number without quotes: it is in {}", kind.si()),
            None => "add a unit, or write a number without quotes: it is in SI".to_owned(),
        };
        return refuse(Some(help));
    }
    let Some((found, scale)) = units::find(unit) else {
        return refuse(number_help(trimmed).map(str::to_owned).or_else(|| Some(units::advice(unit, kind))));
    };
    if let Some(kind) = kind.filter(|kind| *kind != found) {
        return refuse(Some(units::of_another(unit, found, kind)));
    }
    let si = convert(digits, scale);
    match out_of_reach(digits, si) {
        None => Ok((si, found)),
        Some(why) => refuse(Some(why.to_owned())),
    }
}

/// Returns help for common spellings of numbers that are not accepted, such as decimal commas.
pub(crate) fn number_help(text: &str) -> Option<&'static str> {
    let rest = &text[number_length(text)..];
    let number = rest.len() < text.len();
    let digit = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    let rest = rest.trim_start();
    if let Some(after) = rest.strip_prefix(',') {
        return digit(after).then_some("the decimal sign is a point, not a comma");
    }
    if number && rest.starts_with(['*', '×', 'x', '·', '^', '(']) && rest.contains("10") {
        return Some("write powers of ten as in 1.5e-6");
    }
    if number && digit(rest) {
        return Some("write the number without spaces");
    }
    if number && digit(rest.strip_prefix('/').unwrap_or("")) {
        return Some("write the fraction as a decimal number");
    }
    match rest.chars().next() {
        Some('.') if number => Some("a number has one decimal point and digits after it"),
        Some('.') => Some("write a digit before the decimal point"),
        Some('+') if !number => Some("write the number without the plus sign"),
        Some('\u{2212}' | '\u{2013}') if !number => Some("write the minus sign as -"),
        Some('-') if !number => Some("write the minus sign right before a digit"),
        _ => None,
    }
}

/// Returns the length of the number at the start: `-?digits(.digits)?(e±digits)?`.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| bytes[from.min(bytes.len())..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = usize::from(bytes.first() == Some(&b'-'));
    let whole = digits(sign);
    if whole == 0 {
        return 0;
    }
    let mut end = sign + whole;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        end += if fraction > 0 { 1 + fraction } else { 0 };
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        end += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    end
}

/// Converts a number to SI. A power of ten is added to the decimal exponent, so that "5 um" gives exactly the number 5e-6.
pub(crate) fn convert(digits: &str, scale: Scale) -> f64 {
    // A text counted by `number_length` is a number.
    let number = |text: &str| text.parse().unwrap_or(f64::NAN);
    match scale {
        Scale::Factor(factor) => number(digits) * factor,
        Scale::Ten(shift) => {
            let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
            // A number whose exponent has more than 18 digits is zero or infinite for any shift.
            match exponent.parse::<i64>() {
                Ok(exponent) => number(&format!("{mantissa}e{}", exponent.saturating_add(shift.into()))),
                Err(_) => number(digits),
            }
        }
    }
}

/// Returns why a number cannot be represented: it is too large, or so small that it would become zero.
pub(crate) fn out_of_reach(digits: &str, value: f64) -> Option<&'static str> {
    let mantissa = digits.split(['e', 'E']).next().unwrap_or("");
    if !value.is_finite() {
        return Some("the number is beyond the largest floating-point number, 1.8e308");
    }
    let vanished = value == 0.0 && mantissa.contains(|c: char| matches!(c, '1'..='9'));
    vanished.then_some("the number is below the smallest floating-point number, 4.9e-324")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn si(text: &str, kind: Kind) -> f64 {
        parse(text, Some(kind)).unwrap().0
    }

    #[test]
    fn quantities_have_the_bits_of_their_literals() {
        for text in ["5 um", "5 µm", "5 μm", "5um", " 5  um "] {
            assert_eq!(si(text, Kind::Length).to_bits(), 5e-6_f64.to_bits(), "{text}");
        }
        assert_eq!(si("0.3 mm", Kind::Length), 0.3e-3);
        assert_eq!(si("-1.7e2 nm", Kind::Length), -1.7e-7);
        assert_eq!(si("10 us", Kind::Time), 1e-5);
        assert_eq!(si("2 min", Kind::Time), 120.0);
        assert_eq!(si("90 deg", Kind::Angle), std::f64::consts::FRAC_PI_2);
        assert_eq!(si("180°", Kind::Angle), PI_ROUNDED);
        assert_eq!(si("9.81 m/s²", Kind::Acceleration), si("9.81 m/s^2", Kind::Acceleration));
        assert_eq!(si("1 N·s/m", Kind::Damping), 1.0);
        assert_eq!(si("2 N/µm", Kind::Stiffness), 2e6);
        assert_eq!(si("10 mg", Kind::Mass), 1e-5);
        assert_eq!(si("50 Ω", Kind::Resistance), 50.0);
        assert_eq!(si("0.0e-999999999999999999999 m", Kind::Length), 0.0);
    }

    const PI_ROUNDED: f64 = std::f64::consts::PI;

    #[test]
    fn what_is_no_quantity_is_refused() {
        for text in [
            "",
            " ",
            "um",
            "5",
            "5 N",
            "5 Um",
            "NaN m",
            "inf m",
            "1e999 m",
            "1e99999999999999999999 m",
            "1e-400 m",
            "1e-999999999999999999999 m",
            "5..1 m",
            "+5 m",
            "0x1 m",
            "5 m m",
            "5,0 m",
            "- 5 m",
            ".5 m",
            "5 e3",
            "5 * m",
            "5 m*",
            "5 ·m",
        ] {
            assert!(parse(text, Some(Kind::Length)).is_err(), "{text}");
        }
    }

    #[test]
    fn no_unit_has_two_meanings() {
        for (i, (symbol, ..)) in units::UNITS.iter().enumerate() {
            assert_eq!(units::normalise(symbol), *symbol);
            assert!(units::UNITS[..i].iter().all(|(other, ..)| other != symbol), "{symbol}");
        }
    }

    proptest! {
        /// Compares with the parser of the standard library, which reads digits, exponent and prefix as one literal.
        #[test]
        fn prefixes_shift_the_exponent(
            whole in 0..1_000_000_u32,
            fraction in "[0-9]{0,12}",
            exponent in prop::option::of(-30..30_i32),
            unit in prop::sample::select(vec![("nm", -9), ("um", -6), ("mm", -3), ("m", 0)]),
        ) {
            let dot = if fraction.is_empty() { String::new() } else { format!(".{fraction}") };
            let tail = exponent.map_or(String::new(), |e| format!("e{e}"));
            let literal = format!("{whole}{dot}e{}", exponent.unwrap_or(0) + unit.1);
            let text = format!("{whole}{dot}{tail} {}", unit.0);
            prop_assert_eq!(si(&text, Kind::Length).to_bits(), literal.parse::<f64>().unwrap().to_bits());
        }

        #[test]
        fn any_text_gets_an_answer(text in "\\PC{0,24}") {
            if let Ok((value, _)) = parse(&text, None) {
                prop_assert!(value.is_finite());
            }
        }
    }
}
