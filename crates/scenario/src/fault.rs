//! What is wrong, by key path; the document turns it into a report with a place in the file.

use crate::guide::Help;
use crate::path::{KeyPath, Step};
use crate::place::Span;
use serde_json::Value;
use std::fmt::Display;

/// Which half of an entry the marker stands under.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Its value.
    Value,
    /// Its key.
    Key,
}

/// What is put in the place of what is wrong, so that the rest can be judged.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Mend {
    /// An example of the schema; nothing, where the key itself is to blame.
    Example,
    /// An example for a key that is missing.
    Add(String),
    /// The same value under the key that was meant.
    Rename(String),
    /// An example for what the value stands in.
    Around(KeyPath),
    /// Another name for a part, or its section.
    Misnamed,
    /// Nothing: the key is not known here, and may be one that is missing.
    Stray,
    /// A value that the check knows to be right.
    With(Value),
    /// The name of a part that is there, for one that is not; where none is, an example of the part itself.
    Name { section: &'static str, name: String, instead: Option<String> },
    /// What is there: it can be read, though at this path, if any, it cannot be what was meant.
    Leave(Option<KeyPath>),
    /// Nothing: with this wrong nothing else can be judged.
    Nothing,
}

/// Something wrong in a scenario.
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

/// Where a fault is, and what it has to do with others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bearing {
    /// The place itself where it is known; otherwise it is looked up by path.
    pub(crate) span: Option<Span>,
    pub(crate) mend: Mend,
    /// Whether what stands inside the value has a say in it.
    pub(crate) inside: bool,
    /// Other places by which it was judged.
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

    /// A value that is not what was expected; the report adds what stands in the file.
    pub(crate) fn expected(path: KeyPath, what: impl Display) -> Self {
        Self::new(path, format!("expected {what}")).with_value().ask(Help::Meaning)
    }

    /// A key that must be there is not.
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

    /// Help from the schema, where there is no better one.
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

    /// Judged by the shape of the value alone, whatever stands inside.
    pub(crate) fn of_shape(mut self) -> Self {
        self.bearing.inside = false;
        self
    }

    /// Judged by other places, too, such as `contacts.*.between`: where one of them is wrong, this need not be.
    pub(crate) fn against<'a>(mut self, patterns: impl IntoIterator<Item = &'a str>) -> Self {
        self.bearing.against.extend(patterns.into_iter().filter_map(KeyPath::parse));
        self
    }

    /// Judged by the value at a path, too.
    pub(crate) fn against_path(mut self, path: KeyPath) -> Self {
        self.bearing.against.push(path);
        self
    }

    /// Judged by the scenario as a whole.
    pub(crate) fn against_all(self) -> Self {
        self.against_path(KeyPath::default())
    }

    /// Whether its key has no place there.
    pub(crate) fn goes(&self) -> bool {
        self.mark == Mark::Key && !matches!(self.bearing.mend, Mend::Add(_) | Mend::Around(_))
    }

    /// What it speaks of: a key that is missing, or the value at its path.
    pub(crate) fn subject(&self) -> KeyPath {
        let mut subject = self.path.clone();
        if let Mend::Add(key) = &self.bearing.mend {
            subject.0.push(Step::Key(key.clone()));
        }
        subject
    }
}
