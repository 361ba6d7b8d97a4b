//! What is wrong, by key path; the document turns it into a report with a place in the file.

use crate::guide::Help;
use crate::path::KeyPath;
use crate::place::Span;
use std::fmt::Display;

/// Which half of an entry the marker stands under.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Its value.
    Value,
    /// Its key.
    Key,
}

/// Something wrong in a scenario.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub(crate) path: KeyPath,
    pub(crate) mark: Mark,
    /// The place itself where it is known; otherwise it is looked up by path.
    pub(crate) span: Option<Span>,
    pub(crate) message: String,
    pub(crate) help: Help,
    /// Whether the report adds ", got …" from the file.
    pub(crate) value: bool,
}

impl Fault {
    pub(crate) fn new(path: KeyPath, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { path, mark: Mark::Value, span: None, message, help: Help::None, value: false }
    }

    /// A value that is not what was expected; the report adds what stands in the file.
    pub(crate) fn expected(path: KeyPath, what: impl Display) -> Self {
        Self::new(path, format!("expected {what}")).with_value().ask(Help::Meaning)
    }

    /// A key that must be there is not.
    pub(crate) fn missing(path: KeyPath, key: &str) -> Self {
        Self::new(path, format!("missing key \"{key}\"")).on_key().ask(Help::Missing(key.to_owned()))
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

    /// Help from the schema, where there is no better one.
    pub(crate) fn ask(mut self, help: Help) -> Self {
        if self.help == Help::None {
            self.help = help;
        }
        self
    }

    pub(crate) fn on_key(mut self) -> Self {
        self.mark = Mark::Key;
        self
    }

    pub(crate) fn with_value(mut self) -> Self {
        self.value = true;
        self
    }

    pub(crate) fn at_span(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }
}
