//! A scenario's text, its values and the place of each: what every report points into.

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

/// A text that values come from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    /// The file as it was named; for an override the whole argument.
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) kind: SourceKind,
}

/// What a text is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum SourceKind {
    Scenario,
    /// An argument of `--set`.
    Override,
    /// A table that the scenario names under a key.
    Table(KeyPath),
}

/// A read scenario before anybody has asked what it means.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Document {
    /// The scenario, then overrides and tables.
    pub(crate) sources: Vec<Source>,
    pub(crate) value: Value,
    pub(crate) root: Place,
    /// Tables whose points stand in files of their own.
    pub(crate) tables: Vec<TableFile>,
    /// The folder that these are looked for in; none of a scenario that may name no files.
    pub(crate) base: Option<PathBuf>,
    /// What the caller calls an override.
    pub(crate) word: &'static str,
    /// What is known of the keys of such files.
    pub(crate) guide: &'static Guide,
}

/// Most characters of a value that a message repeats.
const SHOWN: usize = 60;

impl Document {
    /// A text that nobody has read yet.
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

    /// Reads a text as strict JSON and notes where everything stands, and what JSON readers let pass in silence.
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

    /// The same of a study file.
    pub(crate) fn read_study(file: &str, text: &str) -> Result<(Self, Vec<Fault>), ScenarioError> {
        let (document, faults) = Self::read(file, text)?;
        Ok((Self { guide: Guide::of_studies(), ..document }, faults))
    }

    /// The table whose file holds the value at a path.
    pub(crate) fn table(&self, path: &KeyPath) -> Option<&KeyPath> {
        self.tables.iter().find(|table| table.has(path)).map(TableFile::path)
    }

    /// As it was before its tables were read.
    pub(crate) fn forget_tables(&mut self) {
        self.tables.clear();
        self.sources.retain(|source| !matches!(source.kind, SourceKind::Table(_)));
    }

    /// Adds a text to point into.
    pub(crate) fn add(&mut self, name: String, text: String, kind: SourceKind) -> &str {
        self.sources.push(Source { name, text, kind });
        self.sources.last().map_or("", |source| &source.text)
    }

    /// What stands in the text under a path, strings without their quotes; none where nothing does.
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

    /// The text of a span; empty where the span does not fit, which no caller brings about.
    pub(crate) fn slice(&self, span: Span) -> &str {
        self.sources.get(span.source).and_then(|s| s.text.get(span.start..span.end)).unwrap_or("")
    }

    /// A fault with its place in the file.
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

    /// The path of a value that the file may give by another key.
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

    /// Where a fault stands: its source, or the one that names it, the place there, and the place in a table.
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

    /// File, line and column of a value.
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

    /// The place of the deepest part of a path that stands in the file. A value over several lines is pointed at by
    /// its key.
    fn locate(&self, path: &KeyPath, mark: Mark) -> Span {
        let (place, depth) = self.root.deepest(path);
        let whole = depth == path.0.len();
        let spread = self.slice(place.value).contains('\n');
        match place.key {
            Some(key) if mark == Mark::Key || !whole || spread => key,
            _ => place.value,
        }
    }

    /// The place of a time or value of a table in a file of its own.
    fn cell(&self, path: &KeyPath) -> Option<Span> {
        self.tables.iter().find_map(|table| table.locate(path, &self.sources))
    }
}

/// A value as a message repeats it: on one line and not without end.
pub(crate) fn shown(text: &str) -> String {
    let mut shown: String = text.chars().take(SHOWN).map(visible).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    shown
}
