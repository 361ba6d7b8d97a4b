//! Why a value does not fit the form: what serde's derived code finds, kept as parts and not as a sentence.

use crate::quantity::HELP;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// Why a value does not fit the form.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Misfit {
    /// A key that has no place here, and those that have.
    UnknownKey { name: String, known: &'static [&'static str] },
    /// A word or key that names no kind of value.
    UnknownKind(String),
    /// A key that must be there is not.
    Missing(&'static str),
    /// No key that says which kind of value it is, or several.
    NotOneKind,
    /// Another sort of value is wanted.
    Unfit(Wanted),
    /// A list of another length is wanted.
    Length { wanted: String, got: usize },
    /// What a reader of the form says in its own words.
    Said { message: String, help: Option<String> },
}

/// What is wanted in place of a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wanted {
    Number,
    WholeNumber,
    Text,
    List,
    Object,
    /// A word that names a kind of value, or an object whose only key does.
    Kind,
    /// Nothing inside a kind that has no inside.
    Nothing,
    /// The inside of a kind whose name stands alone.
    Inside,
    /// An object or a list that has a name of its own.
    Shape(String),
    /// The name of something else in the file, or that thing itself.
    Name(String),
    /// What a reader of the form calls it.
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

/// For serde, which wants it; whoever wrote the file is told by a refusal.
impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}
