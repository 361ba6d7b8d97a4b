//! A scenario's text, its values and the place of each: what every report points into.

use crate::error::{Excerpt, Report, ScenarioError};
use crate::fault::{Fault, Mark};
use crate::path::KeyPath;
use crate::place::{Inner, Place, Span};
use crate::syntax;
use serde_json::Value;

/// A text that values come from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    /// The file as it was named; for an override the whole argument.
    pub(crate) name: String,
    pub(crate) text: String,
}

/// A read scenario before anybody has asked what it means.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Document {
    /// The file, then the overrides.
    pub(crate) sources: Vec<Source>,
    pub(crate) value: Value,
    pub(crate) root: Place,
}

/// Most characters of a value that a message repeats.
const SHOWN: usize = 60;

impl Document {
    /// Reads a text as strict JSON and notes where everything stands.
    pub(crate) fn read(file: &str, text: &str) -> Result<Self, ScenarioError> {
        let mut document = Self {
            sources: vec![Source { name: file.to_owned(), text: text.to_owned() }],
            value: Value::Null,
            root: Place { key: None, value: Span { source: 0, start: 0, end: 0 }, inner: Inner::Leaf },
        };
        match syntax::read(text, &syntax::Origin { source: 0, offset: 0, path: KeyPath::default() }) {
            Ok((value, root)) => {
                document.value = value;
                document.root = root;
                Ok(document)
            }
            Err(fault) => Err(document.report(fault)),
        }
    }

    /// What stands in the text under a path, strings without their quotes; none where nothing does.
    pub(crate) fn written(&self, path: &KeyPath) -> Option<String> {
        let (place, depth) = self.root.deepest(path);
        if depth < path.0.len() {
            return None;
        }
        Some(match place.inner {
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
    pub(crate) fn report(&self, fault: Fault) -> ScenarioError {
        let written = if fault.value { self.written(&fault.path) } else { None };
        let span = fault.span.unwrap_or_else(|| self.locate(&fault.path, fault.mark));
        let source = self.sources.get(span.source);
        ScenarioError::new(Report {
            file: source.map(|s| s.name.clone()).unwrap_or_default(),
            is_override: span.source > 0,
            excerpt: source.map(|s| excerpt(&s.text, span)),
            path: fault.path.to_string(),
            message: match written {
                Some(written) => format!("{}, got {written}", fault.message),
                None => fault.message,
            },
            help: fault.help,
        })
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
}

/// A value as a message repeats it: on one line and not without end.
pub(crate) fn shown(text: &str) -> String {
    let mut shown: String =
        text.chars().take(SHOWN).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    shown
}

/// Line, column and text around a span.
fn excerpt(text: &str, span: Span) -> Excerpt {
    let start = floor_boundary(text, span.start);
    let end = floor_boundary(text, span.end.max(span.start)).max(start);
    let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
    let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
    let line = text[line_start..line_end].trim_end_matches('\r');
    let column = text[line_start..start].chars().count();
    // The marker stays on its line; past the end of the line it still shows one caret.
    let width =
        text[start..end.clamp(start, line_start + line.len().max(start - line_start))].chars().count();
    Excerpt {
        line: text[..start].matches('\n').count() + 1,
        column: column + 1,
        text: line.to_owned(),
        marker: column..column + width.max(1),
    }
}

fn floor_boundary(text: &str, index: usize) -> usize {
    let mut index = index.min(text.len());
    while !text.is_char_boundary(index) {
        index -= 1;
    }
    index
}
