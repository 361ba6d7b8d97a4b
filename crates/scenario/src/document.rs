//! Text, values and positions of a scenario.

use crate::error::{Report, ScenarioError};
use crate::excerpt::{Excerpt, visible};
use crate::fault::{Fault, Mark};
use crate::guide::Guide;
use crate::path::{KeyPath, Step};
use crate::place::{Inner, Place, Span};
use crate::syntax;
use crate::tables::TableFile;
use serde_json::Value;
use std::path::PathBuf;

/// Text that contains values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    /// File name as given; for an override the whole argument.
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) kind: SourceKind,
}

/// Kind of a source text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SourceKind {
    Scenario,
    /// Argument of `--set`.
    Override,
    /// File of a table, with the key path that names the file.
    Table(KeyPath),
}

/// Parsed scenario or study file before its keys are interpreted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Document {
    /// File, then overrides and tables.
    pub(crate) sources: Vec<Source>,
    pub(crate) value: Value,
    pub(crate) root: Place,
    /// Tables whose points are in separate files.
    pub(crate) tables: Vec<TableFile>,
    /// Folder that contains the table files; `None` if the scenario may not name files.
    pub(crate) base: Option<PathBuf>,
    /// Name of overrides in messages, such as `--set`.
    pub(crate) word: &'static str,
    /// Schema from which help texts are taken.
    pub(crate) guide: &'static Guide,
}

/// Maximum number of characters of a value in a message.
const SHOWN: usize = 60;

impl Document {
    /// Returns a document with a text that is not parsed yet.
    pub(crate) fn new(file: &str, text: &str) -> Self {
        let whole = Span { source: 0, start: 0, end: text.len() };
        let mut document = Self {
            sources: Vec::new(),
            value: Value::Null,
            root: Place { key: None, value: whole, inner: Inner::Leaf },
            tables: Vec::new(),
            base: None,
            word: "--set",
            guide: Guide::get(),
        };
        document.add(file.to_owned(), text.to_owned(), SourceKind::Scenario);
        document
    }

    /// Parses a text as JSON with comments. Returns the document and errors that JSON parsers do not report, such as duplicate keys.
    pub(crate) fn read(file: &str, text: &str) -> Result<(Self, Vec<Fault>), ScenarioError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut document = Self::new(file, text);
        match syntax::read(text, &syntax::Origin { source: 0, offset: 0, path: KeyPath::default() }) {
            Ok(read) => {
                document.value = read.value;
                document.root = read.place;
                Ok((document, read.faults))
            }
            Err(fault) => Err(ScenarioError::from(document.report(fault)).unread()),
        }
    }

    /// Parses a study file like [`Self::read`].
    pub(crate) fn read_study(file: &str, text: &str) -> Result<(Self, Vec<Fault>), ScenarioError> {
        let (document, faults) = Self::read(file, text)?;
        Ok((Self { guide: Guide::of_studies(), ..document }, faults))
    }

    /// Returns the path of the table whose file contains the value at a path.
    pub(crate) fn table(&self, path: &KeyPath) -> Option<&KeyPath> {
        self.tables.iter().find(|table| table.has(path)).map(TableFile::path)
    }

    /// Removes all tables, which restores the document before the tables were read.
    pub(crate) fn forget_tables(&mut self) {
        self.tables.clear();
        self.sources.retain(|source| !matches!(source.kind, SourceKind::Table(_)));
    }

    /// Adds a source text and returns it.
    pub(crate) fn add(&mut self, name: String, text: String, kind: SourceKind) -> &str {
        self.sources.push(Source { name, text, kind });
        self.sources.last().map_or("", |source| &source.text)
    }

    /// Returns the value at a path as shown in messages: strings without quotes, containers as words such as "an object". Returns `None`
    /// if there is no such value.
    pub(crate) fn written(&self, path: &KeyPath) -> Option<String> {
        if let Some(cell) = self.cell(path) {
            return Some(shown(self.slice(cell)));
        }
        let (place, depth) = self.root.deepest(path);
        if depth < path.0.len() {
            return None;
        }
        Some(match &place.inner {
            Inner::Object(entries) if entries.is_empty() => "an empty object".to_owned(),
            Inner::List(entries) if entries.is_empty() => "an empty list".to_owned(),
            Inner::Object(_) => "an object".to_owned(),
            Inner::List(_) => "a list".to_owned(),
            Inner::Leaf => {
                let text = self.slice(place.value);
                let bare = text.strip_prefix('"').and_then(|t| t.strip_suffix('"')).unwrap_or(text);
                shown(bare)
            }
        })
    }

    /// Returns the text of a span, or an empty text for an invalid span.
    pub(crate) fn slice(&self, span: Span) -> &str {
        self.sources.get(span.source).and_then(|s| s.text.get(span.start..span.end)).unwrap_or("")
    }

    /// Converts an error to a report with its position in the file.
    pub(crate) fn report(&self, mut fault: Fault) -> Report {
        fault.path = self.given(&fault.path);
        let written = if fault.value { self.written(&fault.path) } else { None };
        let span = self.span(&fault);
        let help = fault.help.about(&fault.path, self.guide);
        let mut report = Report {
            file: String::new(),
            is_override: false,
            word: self.word,
            excerpt: None,
            path: fault.path.to_string(),
            message: match written {
                Some(written) => format!("{}, got {written}", fault.message),
                None => fault.message,
            },
            help,
        };
        if let Some(source) = self.sources.get(span.source) {
            report.file.clone_from(&source.name);
            report.excerpt = Some(Excerpt::of(&source.text, span.start..span.end));
            report.is_override = source.kind == SourceKind::Override;
            if let SourceKind::Table(named) = &source.kind {
                let place = format!("the table is named in {}", self.address(named));
                report.help = Some(match report.help {
                    Some(help) => format!("{help}; {place}"),
                    None => place,
                });
            }
        }
        report
    }

    /// Returns the path under which the file gives a value: `radius` may be given as `diameter`.
    fn given(&self, path: &KeyPath) -> KeyPath {
        let mut other = path.clone();
        if let Some(Step::Key(key)) = other.0.last_mut()
            && key == "radius"
        {
            "diameter".clone_into(key);
        }
        let stands = |path: &KeyPath| self.root.deepest(path).1 == path.0.len();
        if !stands(path) && stands(&other) { other } else { path.clone() }
    }

    fn span(&self, fault: &Fault) -> Span {
        let span = fault.bearing.span.or_else(|| self.cell(&fault.path));
        span.unwrap_or_else(|| self.locate(&fault.path, fault.mark))
    }

    /// Returns the sort key of an error: source, position in the source, position in a table. For an error in a table, source and position
    /// are those of the key that names the table's file.
    pub(crate) fn order(&self, fault: &Fault) -> (usize, usize, usize) {
        let span = self.span(fault);
        match self.sources.get(span.source).map(|source| &source.kind) {
            Some(SourceKind::Table(named)) => {
                let named = self.locate(named, Mark::Value);
                (named.source, named.start, span.start)
            }
            _ => (span.source, span.start, 0),
        }
    }

    /// Returns file, line and column of a value.
    fn address(&self, path: &KeyPath) -> String {
        let span = self.locate(path, Mark::Value);
        let Some(source) = self.sources.get(span.source) else { return String::new() };
        match &source.kind {
            SourceKind::Override => format!("{} {}", self.word, source.name).trim_start().to_owned(),
            _ => {
                let excerpt = Excerpt::of(&source.text, span.start..span.end);
                format!("{}:{}:{}", source.name, excerpt.line, excerpt.column)
            }
        }
    }

    /// Returns the span of the deepest part of a path that exists in the file. For a value of several lines, returns the span of its key.
    fn locate(&self, path: &KeyPath, mark: Mark) -> Span {
        let (place, depth) = self.root.deepest(path);
        let whole = depth == path.0.len();
        let spread = self.slice(place.value).contains('\n');
        match place.key {
            Some(key) if mark == Mark::Key || !whole || spread => key,
            _ => place.value,
        }
    }

    /// Returns the span of a number in the file of a table.
    fn cell(&self, path: &KeyPath) -> Option<Span> {
        self.tables.iter().find_map(|table| table.locate(path, &self.sources))
    }
}

/// Returns a value as shown in messages: on one line and at most 60 characters long.
pub(crate) fn shown(text: &str) -> String {
    let mut shown: String = text.chars().take(SHOWN).map(visible).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    shown
}
