//! What is wrong, by key path; the document turns it into a report with a place in the file.

use crate::path::KeyPath;
use crate::place::Span;

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
    pub(crate) help: Option<String>,
    /// Whether the report adds ", got …" from the file.
    pub(crate) value: bool,
}

impl Fault {
    pub(crate) fn new(path: KeyPath, message: impl Into<String>) -> Self {
        Self { path, mark: Mark::Value, span: None, message: message.into(), help: None, value: false }
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    pub(crate) fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
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
