//! Errors of a scenario, identified by key path. The document converts them to reports with positions.

use crate::guide::Help;
use crate::path::{KeyPath, Step};
use crate::place::Span;
use serde_json::Value;
use std::fmt::Display;

/// Part of an entry that the report marks: the key or the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Value.
    Value,
    /// Key.
    Key,
}

/// Replacement of an invalid value, so that the rest of the scenario can be checked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Mend {
    /// Example value from the schema, or removal if the key is wrong.
    Example,
    /// Example value from the schema for a missing key.
    Add(String),
    /// The same value under the intended key.
    Rename(String),
    /// Example value from the schema for a parent of the value.
    Around(KeyPath),
    /// Another name for a part.
    Misnamed,
    /// Removal of an unknown key, which may be a misspelt missing key.
    Stray,
    /// Value that the check knows to be valid.
    With(Value),
    /// Name of an existing part instead of an unknown one. If there is none, an example of the part is added.
    Name { section: &'static str, name: String, instead: Option<String> },
    /// No replacement: the value is readable, but the value at the given path is not the intended one.
    Leave(Option<KeyPath>),
    /// No replacement: nothing else can be checked.
    Nothing,
}

/// Error in a scenario.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub(crate) path: KeyPath,
    pub(crate) mark: Mark,
    pub(crate) message: String,
    pub(crate) help: Help,
    /// Whether the report adds ", got …" from the file.
    pub(crate) value: bool,
    pub(crate) bearing: Box<Bearing>,
}

/// Position of an error, and the other values on which its check depends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bearing {
    /// Position, if known; otherwise it follows from the path.
    pub(crate) span: Option<Span>,
    pub(crate) mend: Mend,
    /// Whether the check depends on the contents of the value.
    pub(crate) inside: bool,
    /// Paths of other values on which the check depends.
    pub(crate) against: Vec<KeyPath>,
}

impl Fault {
    pub(crate) fn new(path: KeyPath, message: impl Into<String>) -> Self {
        let message = message.into();
        Self {
            path,
            mark: Mark::Value,
            message,
            help: Help::None,
            value: false,
            bearing: Box::new(Bearing { span: None, mend: Mend::Example, inside: true, against: Vec::new() }),
        }
    }

    /// Returns the error for an unexpected value; the report adds the value in the file.
    pub(crate) fn expected(path: KeyPath, what: impl Display) -> Self {
        Self::new(path, format!("expected {what}")).with_value().ask(Help::Meaning)
    }

    /// Returns the error for a missing key.
    pub(crate) fn missing(path: KeyPath, key: &str) -> Self {
        let fault = Self::new(path, format!("missing key \"{key}\"")).on_key();
        fault.ask(Help::Missing(key.to_owned())).mend(Mend::Add(key.to_owned()))
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Help::Said(help.into());
        self
    }

    pub(crate) fn maybe_help(mut self, help: Option<String>) -> Self {
        if let Some(help) = help {
            self.help = Help::Said(help);
        }
        self
    }

    /// Sets the help from the schema, if there is no other help.
    pub(crate) fn ask(mut self, help: Help) -> Self {
        if self.help == Help::None {
            self.help = help;
        }
        self
    }

    pub(crate) fn on_key(mut self) -> Self {
        self.mark = Mark::Key;
        self.bearing.inside = false;
        self
    }

    pub(crate) fn with_value(mut self) -> Self {
        self.value = true;
        self
    }

    pub(crate) fn at_span(mut self, span: Span) -> Self {
        self.bearing.span = Some(span);
        self
    }

    pub(crate) fn mend(mut self, mend: Mend) -> Self {
        self.bearing.mend = mend;
        self
    }

    /// States that the check depends only on the type of the value, not on its contents.
    pub(crate) fn of_shape(mut self) -> Self {
        self.bearing.inside = false;
        self
    }

    /// Adds other paths on which the check depends, such as `contacts.*.between`. If one of these values is invalid, the error may be a
    /// follow-on error.
    pub(crate) fn against<'a>(mut self, patterns: impl IntoIterator<Item = &'a str>) -> Self {
        self.bearing.against.extend(patterns.into_iter().filter_map(KeyPath::parse));
        self
    }

    /// Adds one path on which the check depends.
    pub(crate) fn against_path(mut self, path: KeyPath) -> Self {
        self.bearing.against.push(path);
        self
    }

    /// States that the check depends on the whole scenario.
    pub(crate) fn against_all(self) -> Self {
        self.against_path(KeyPath::default())
    }

    /// Returns whether the key is not allowed at its position.
    pub(crate) fn goes(&self) -> bool {
        self.mark == Mark::Key && !matches!(self.bearing.mend, Mend::Add(_) | Mend::Around(_))
    }

    /// Returns the path of the missing key or the invalid value.
    pub(crate) fn subject(&self) -> KeyPath {
        let mut subject = self.path.clone();
        if let Mend::Add(key) = &self.bearing.mend {
            subject.0.push(Step::Key(key.clone()));
        }
        subject
    }
}
