//! Quantities: numbers in SI, or strings with a unit.

mod pattern;
mod reading;

pub(crate) use reading::{convert, number_help, out_of_reach};

use crate::document::shown;
use crate::units::{self, Kind};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// Character that separates message and help text in error strings of serde.
pub(crate) const HELP: char = '\u{1e}';

/// Largest magnitude of a quantity in its SI unit. Products of four such quantities, as in energies, still are finite numbers.
pub(crate) const LARGEST: f64 = 1e30;

/// Smallest magnitude of a quantity that must be above zero. Divisions by this value stay finite.
pub(crate) const SMALLEST: f64 = 1e-40;

/// Dimension as a type.
pub(crate) trait Dimension {
    const KIND: Kind;
}

/// Quantity of a known dimension, in SI.
#[derive(Debug)]
pub(crate) struct Quantity<D> {
    pub(crate) si: f64,
    dimension: PhantomData<D>,
}

/// Quantity of any dimension, in SI. A number without a unit has no `kind`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AnyQuantity {
    pub(crate) si: f64,
    pub(crate) kind: Option<Kind>,
}

macro_rules! dimensions {
    ($($name:ident)*) => {
        /// Dimensions of the quantities in the file.
        pub(crate) mod dimension {
            $(
                #[derive(Debug, Clone, Copy, PartialEq)]
                pub(crate) struct $name;
                impl super::Dimension for $name {
                    const KIND: super::Kind = super::Kind::$name;
                }
            )*
        }
        $(
            #[allow(dead_code, reason = "some quantities are used only as dimensions")]
            pub(crate) type $name = Quantity<dimension::$name>;
        )*
    };
}

dimensions! {
    Length Time Frequency Velocity AngularVelocity Acceleration Mass Inertia Force Moment Stiffness Damping Pressure Angle Storage
    Resistance StrokePerVoltage Voltage Current Capacitance
}

impl<D> Quantity<D> {
    /// Returns a quantity from a value in SI without a check.
    pub(crate) const fn new(si: f64) -> Self {
        Self { si, dimension: PhantomData }
    }
}

impl<D: Dimension> Quantity<D> {
    /// Returns a quantity from a value in SI. Fails if the value is not finite or too large.
    pub(crate) fn from_si(si: f64) -> Result<Self, String> {
        QuantityVisitor(Some(D::KIND)).number(si).map(|quantity| Self::new(quantity.si))
    }

    /// Reads a string with a unit.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        QuantityVisitor(Some(D::KIND)).text(text).map(|quantity| Self::new(quantity.si))
    }
}

/// Reads a quantity whose SI unit is `unit`, such as `m/s`. The text is a number in this unit, or a number with any unit of the same
/// dimension.
///
/// # Errors
/// A text that is not such a quantity. The error is a message and, if there is one, a help text on the next line.
pub fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    if let Ok(value) = text.trim().parse::<f64>() {
        return if value.is_finite() { Ok(value) } else { Err("expected a finite number".to_owned()) };
    }
    let Some(kind) = units::of_si(unit) else {
        let wanted = if unit.is_empty() { "a number".to_owned() } else { format!("a number in {unit}") };
        return Err(format!("expected {wanted}, got \"{}\"", shown(text)));
    };
    let read = reading::parse(text, Some(kind)).map(|(si, _)| si);
    read.map_err(|message| message.replace(HELP, "\n   help: "))
}

impl<D> Clone for Quantity<D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D> Copy for Quantity<D> {}

struct QuantityVisitor(Option<Kind>);

impl Visitor<'_> for QuantityVisitor {
    type Value = AnyQuantity;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let wanted = self.0.map_or("a quantity", Kind::article);
        write!(f, "{wanted} such as \"{}\"", self.0.unwrap_or(Kind::Length).example())
    }

    fn visit_f64<E: de::Error>(self, si: f64) -> Result<AnyQuantity, E> {
        self.number(si).map_err(E::custom)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<AnyQuantity, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<AnyQuantity, E> {
        self.visit_f64(value as f64)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<AnyQuantity, E> {
        self.text(text).map_err(E::custom)
    }
}

impl QuantityVisitor {
    /// Checks a number in SI.
    fn number(&self, si: f64) -> Result<AnyQuantity, String> {
        if !si.is_finite() {
            return Err("expected a finite number".to_owned());
        }
        within_reach(si, self.0, format_args!("{si:e}"))?;
        Ok(AnyQuantity { si, kind: self.0 })
    }

    /// Reads a number with its unit.
    fn text(&self, text: &str) -> Result<AnyQuantity, String> {
        let (si, kind) = reading::parse(text, self.0)?;
        within_reach(si, Some(kind), format_args!("\"{}\"", shown(text)))?;
        Ok(AnyQuantity { si, kind: Some(kind) })
    }
}

/// Checks that the magnitude of a value in SI is at most [`LARGEST`]; `got` is the text in the file.
fn within_reach(si: f64, kind: Option<Kind>, got: fmt::Arguments<'_>) -> Result<(), String> {
    if si.abs() <= LARGEST {
        return Ok(());
    }
    let (wanted, unit) = kind.map_or(("a quantity", "in SI"), |kind| (kind.article(), kind.si()));
    Err(format!("expected {wanted} between -{LARGEST:e} and {LARGEST:e} {unit}, got {got}"))
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

impl<D: Dimension> JsonSchema for Quantity<D> {
    fn schema_name() -> Cow<'static, str> {
        format!("{:?}", D::KIND).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        pattern::schema_of(Some(D::KIND))
    }
}

impl JsonSchema for AnyQuantity {
    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        pattern::schema_of(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_quantity_in_a_given_unit_is_a_number_or_has_a_unit_of_its_dimension() {
        assert_eq!(quantity("2e-6", "m"), Ok(2e-6));
        assert_eq!(quantity("2 um", "m"), Ok(2e-6));
        assert_eq!(quantity("3 mm/s", "m/s"), Ok(3e-3));
        assert_eq!((quantity("1e-9", "J"), quantity("0.5", "")), (Ok(1e-9), Ok(0.5)));
        assert_eq!(quantity("1 nJ", "J"), Err("expected a number in J, got \"1 nJ\"".to_owned()));
        assert!(quantity("1 N", "m").unwrap_err().contains("\n   help: N is a unit of a force"));
        assert!(quantity("inf", "m").is_err() && quantity("", "m").is_err());
    }

    proptest! {
        /// A quantity that is printed in SI and read again keeps all bits.
        #[test]
        fn numbers_survive_printing(value in prop::num::f64::NORMAL | prop::num::f64::ZERO | prop::num::f64::SUBNORMAL) {
            prop_assume!(value.abs() <= LARGEST);
            let text = serde_json::to_string(&Length::new(value)).unwrap();
            let again: Length = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(again.si.to_bits(), value.to_bits());
        }
    }
}
