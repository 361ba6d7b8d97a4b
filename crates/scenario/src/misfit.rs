//! Error type of the deserializer: the reason why a value does not fit its key, as data instead of text.

use crate::quantity::HELP;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// Reason why a value does not fit its key.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Misfit {
    /// Unknown key, and the allowed keys.
    UnknownKey { name: String, known: &'static [&'static str] },
    /// Word or key that is not the name of a variant.
    UnknownKind(String),
    /// Missing key.
    Missing(&'static str),
    /// Object without a key that selects a variant, or with several such keys.
    NotOneKind,
    /// Value of another type.
    Unfit(Wanted),
    /// List of another length.
    Length { wanted: String, got: usize },
    /// Message of a custom deserializer.
    Said { message: String, help: Option<String> },
}

/// Expected type of a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wanted {
    Number,
    WholeNumber,
    Text,
    List,
    Object,
    /// Name of a variant, or an object whose only key is the name of a variant.
    Kind,
    /// No contents, because the variant has none.
    Nothing,
    /// Contents of a variant whose name stands alone.
    Inside,
    /// Object or list of a type with this description.
    Shape(String),
    /// Reference to another part of the file, or the part itself.
    Name(String),
    /// Value of a type with this description.
    Value(String),
}

impl de::Error for Misfit {
    fn custom<T: fmt::Display>(message: T) -> Self {
        let message = message.to_string();
        match message.split_once(HELP) {
            Some((message, help)) => Self::Said { message: message.to_owned(), help: Some(help.to_owned()) },
            None => Self::Said { message, help: None },
        }
    }

    fn invalid_type(_: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        Self::Unfit(Wanted::Value(wanted.to_string()))
    }

    fn invalid_value(_: Unexpected<'_>, wanted: &dyn Expected) -> Self {
        Self::Unfit(Wanted::Value(wanted.to_string()))
    }

    fn invalid_length(got: usize, wanted: &dyn Expected) -> Self {
        Self::Length { wanted: wanted.to_string(), got }
    }

    fn unknown_variant(name: &str, _: &'static [&'static str]) -> Self {
        Self::UnknownKind(name.to_owned())
    }

    fn unknown_field(name: &str, known: &'static [&'static str]) -> Self {
        Self::UnknownKey { name: name.to_owned(), known }
    }

    fn missing_field(name: &'static str) -> Self {
        Self::Missing(name)
    }
}

impl std::error::Error for Misfit {}

/// serde requires this implementation. Users see the message from the module `refusal` instead.
impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}
