//! Quantities: a number in SI, or a string with a unit.

use crate::document::shown;
use crate::suggest;
use crate::units::{self, Kind, Scale};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// Separates a message from its help in the plain strings that serde carries.
pub(crate) const HELP: char = '\u{1e}';

/// A dimension as a type.
pub(crate) trait Dimension {
    const KIND: Kind;
}

/// A quantity of a known dimension, in SI.
#[derive(Debug)]
pub(crate) struct Quantity<D> {
    pub(crate) si: f64,
    dimension: PhantomData<D>,
}

/// A quantity of any dimension, in SI; a bare number does not tell which.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AnyQuantity {
    pub(crate) si: f64,
    pub(crate) kind: Option<Kind>,
}

macro_rules! dimensions {
    ($($name:ident)*) => {
        /// The dimensions the form uses.
        pub(crate) mod dimension {
            $(
                #[derive(Debug, Clone, Copy, PartialEq)]
                pub(crate) struct $name;
                impl super::Dimension for $name {
                    const KIND: super::Kind = super::Kind::$name;
                }
            )*
        }
        $(pub(crate) type $name = Quantity<dimension::$name>;)*
    };
}

dimensions! { Length Time Frequency Velocity Acceleration Mass Force Stiffness Damping Pressure Angle }

impl<D> Quantity<D> {
    /// A quantity in SI.
    pub(crate) const fn new(si: f64) -> Self {
        Self { si, dimension: PhantomData }
    }
}

impl<D: Dimension> Quantity<D> {
    /// Reads a string with a unit.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        parse(text, Some(D::KIND)).map(|(si, _)| Self::new(si))
    }
}

impl<D> Clone for Quantity<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Quantity<D> {}

/// Reads `"5 um"`: value in SI and dimension. An error is a message and, after [`HELP`], its help.
pub(crate) fn parse(text: &str, kind: Option<Kind>) -> Result<(f64, Kind), String> {
    let wanted = kind.map_or("a quantity", Kind::article);
    let example = kind.unwrap_or(Kind::Length).example();
    let refuse = |help: Option<String>| {
        let help = help.map(|help| format!("{HELP}{help}")).unwrap_or_default();
        Err(format!("expected {wanted} such as \"{example}\", got \"{}\"{help}", shown(text)))
    };
    let trimmed = text.trim();
    let number = number_length(trimmed);
    let (digits, unit) = trimmed.split_at(number);
    if number == 0 {
        return refuse(None);
    }
    if unit.is_empty() {
        let help = match kind {
            Some(kind) => format!("add a unit, or write a number without quotes: it is in {}", kind.si()),
            None => "add a unit, or write a number without quotes: it is in SI".to_owned(),
        };
        return refuse(Some(help));
    }
    let Some((found, scale)) = units::find(unit) else {
        return refuse(unit_help(unit, kind));
    };
    if let Some(kind) = kind.filter(|kind| *kind != found) {
        let units: Vec<_> = units::symbols(Some(kind)).collect();
        let help =
            format!("{} is the unit of {}; units here: {}", unit.trim(), found.article(), units.join(", "));
        return refuse(Some(help));
    }
    match convert(digits, scale) {
        Some(si) => Ok((si, found)),
        None => refuse(Some("the number is beyond the largest floating-point number, 1.8e308".to_owned())),
    }
}

/// Reads a quantity in the SI unit `unit`, such as `m/s`: a number in it or, where a scenario knows units of its
/// dimension, a number with one of them. An error is a message and, on a second line, its help.
pub fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    if let Ok(value) = text.trim().parse::<f64>() {
        return if value.is_finite() { Ok(value) } else { Err("expected a finite number".to_owned()) };
    }
    let Some(kind) = units::of_si(unit) else {
        let wanted = if unit.is_empty() { "a number".to_owned() } else { format!("a number in {unit}") };
        return Err(format!("expected {wanted}, got \"{}\"", shown(text)));
    };
    let read = parse(text, Some(kind)).map(|(si, _)| si);
    read.map_err(|message| message.replace(HELP, "\n   help: "))
}

fn unit_help(unit: &str, kind: Option<Kind>) -> Option<String> {
    if unit.starts_with(',') {
        return Some("decimals stand after a point, not after a comma".to_owned());
    }
    suggest::help(&units::normalise(unit), units::symbols(kind))
}

/// Length of the number at the start: `-?digits(.digits)?(e±digits)?`.
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

/// A power of ten goes into the exponent of the string: "5 um" is 5e-6 to the last bit.
fn convert(digits: &str, scale: Scale) -> Option<f64> {
    let value = match scale {
        Scale::Factor(factor) => digits.parse::<f64>().ok()? * factor,
        Scale::Ten(shift) => {
            let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
            // An exponent of more than 18 digits is zero or infinity whatever the shift.
            match exponent.parse::<i64>() {
                Ok(exponent) => {
                    format!("{mantissa}e{}", exponent.saturating_add(shift.into())).parse().ok()?
                }
                Err(_) => digits.parse().ok()?,
            }
        }
    };
    value.is_finite().then_some(value)
}

struct QuantityVisitor(Option<Kind>);

impl Visitor<'_> for QuantityVisitor {
    type Value = AnyQuantity;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let wanted = self.0.map_or("a quantity", Kind::article);
        write!(f, "{wanted} such as \"{}\"", self.0.unwrap_or(Kind::Length).example())
    }

    fn visit_f64<E: de::Error>(self, si: f64) -> Result<AnyQuantity, E> {
        if !si.is_finite() {
            return Err(E::custom("expected a finite number"));
        }
        Ok(AnyQuantity { si, kind: self.0 })
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<AnyQuantity, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<AnyQuantity, E> {
        self.visit_f64(value as f64)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<AnyQuantity, E> {
        let (si, kind) = parse(text, self.0).map_err(E::custom)?;
        Ok(AnyQuantity { si, kind: Some(kind) })
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Quantity<D> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_any(QuantityVisitor(Some(D::KIND))).map(|quantity| Self::new(quantity.si))
    }
}

impl<'de> Deserialize<'de> for AnyQuantity {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        deserializer.deserialize_any(QuantityVisitor(None))
    }
}

impl<D> Serialize for Quantity<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.si)
    }
}

impl Serialize for AnyQuantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.si)
    }
}

/// Spellings of a unit in a pattern: what [`units::normalise`] takes back.
fn pattern_of(symbol: &str) -> String {
    let micro = if symbol.starts_with('u') || symbol.contains("/u") {
        symbol.replacen('u', "[uµμ]", 1)
    } else {
        symbol.to_owned()
    };
    micro
        .replace("^2", "(\\^2|²)")
        .replace("ohm", "(ohm|Ω|Ω)")
        .replace("deg", "(deg|°)")
        .replace(' ', "[ ·*]")
}

fn schema_of(kind: Option<Kind>) -> Schema {
    let units: Vec<String> = units::symbols(kind).map(pattern_of).collect();
    let pattern = format!(r"^\s*-?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?\s*({})\s*$", units.join("|"));
    let description = match kind {
        Some(kind) => {
            let (article, si, example) = (capital(kind.article()), kind.si(), kind.example());
            format!("{article}: a number in {si}, or a string such as \"{example}\".")
        }
        None => "A quantity: a number in SI, or a string with a unit such as \"5 um\". Its dimension is that of the \
                 place that follows the waveform."
            .to_owned(),
    };
    json_schema!({
        "description": description,
        "anyOf": [{ "type": "number" }, { "type": "string", "pattern": pattern }]
    })
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|c| c.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

impl<D: Dimension> JsonSchema for Quantity<D> {
    fn schema_name() -> Cow<'static, str> {
        format!("{:?}", D::KIND).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        schema_of(Some(D::KIND))
    }
}

impl JsonSchema for AnyQuantity {
    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        schema_of(None)
    }
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
        assert_eq!(si("1e-999999999999999999999 m", Kind::Length), 0.0);
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
            "5..1 m",
            "+5 m",
            "0x1 m",
            "5 m m",
            "5,0 m",
            "- 5 m",
            ".5 m",
            "5 e3",
        ] {
            assert!(parse(text, Some(Kind::Length)).is_err(), "{text}");
        }
    }

    #[test]
    fn a_quantity_in_a_given_unit_is_a_number_or_has_a_unit_of_its_dimension() {
        assert_eq!(quantity("2e-6", "m"), Ok(2e-6));
        assert_eq!(quantity("2 um", "m"), Ok(2e-6));
        assert_eq!(quantity("3 mm/s", "m/s"), Ok(3e-3));
        assert_eq!((quantity("1e-9", "J"), quantity("0.5", "")), (Ok(1e-9), Ok(0.5)));
        assert_eq!(quantity("1 nJ", "J"), Err("expected a number in J, got \"1 nJ\"".to_owned()));
        assert!(quantity("1 N", "m").unwrap_err().contains("\n   help: N is the unit of a force"));
        assert!(quantity("inf", "m").is_err() && quantity("", "m").is_err());
    }

    #[test]
    fn no_unit_has_two_meanings() {
        for (i, (symbol, ..)) in units::UNITS.iter().enumerate() {
            assert_eq!(units::normalise(symbol), *symbol);
            assert!(units::UNITS[..i].iter().all(|(other, ..)| other != symbol), "{symbol}");
        }
    }

    proptest! {
        /// The standard library's parser is the judge: digits, exponent and prefix written as one literal.
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

        /// Printed in SI and read again, a quantity keeps its bits.
        #[test]
        fn numbers_survive_printing(value in prop::num::f64::NORMAL | prop::num::f64::ZERO | prop::num::f64::SUBNORMAL) {
            let text = serde_json::to_string(&Length::new(value)).unwrap();
            let again: Length = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(again.si.to_bits(), value.to_bits());
        }
    }
}
