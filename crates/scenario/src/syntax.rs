//! Parser of JSON with comments. The parser checks limits, syntax and duplicate keys, and records the positions of all values.

mod bracket;
mod comment;
mod slip;

use crate::fault::{Fault, Mend};
use crate::path::{KeyPath, Step};
use crate::place::{Inner, Place, Span};
use crate::quantity::out_of_reach;
use jsonc_parser::ast;
use jsonc_parser::common::{Range, Ranged};
use jsonc_parser::{CollectOptions, ParseOptions};
use serde_json::Value;
use slip::Slip;
use std::borrow::Cow;
use std::collections::HashMap;

/// Maximum size of a scenario, bytes.
pub(crate) const MAX_BYTES: usize = 4 << 20;
/// Maximum number of errors of one text.
const MAX_FAULTS: usize = 100;
/// Maximum nesting depth of objects and lists. Valid scenarios need less than ten.
const MAX_DEPTH: usize = 64;

/// Origin of a text, to which positions and paths refer.
pub(crate) struct Origin {
    /// Index of the text in the list of sources.
    pub(crate) source: usize,
    /// Number of bytes of the source before the text.
    pub(crate) offset: usize,
    /// Path of the value in the text.
    pub(crate) path: KeyPath,
}

impl Origin {
    fn span(&self, range: Range) -> Span {
        Span { source: self.source, start: self.offset + range.start, end: self.offset + range.end }
    }

    fn fault(&self, range: Range, message: impl Into<String>) -> Fault {
        Fault::new(self.path.clone(), message).at_span(self.span(range))
    }

    fn slipped(&self, slip: Slip) -> Fault {
        let range = Range::new(slip.range.start, slip.range.end);
        self.fault(range, format!("not JSON: {}", slip.message)).maybe_help(slip.help)
    }
}

/// Parsed text.
pub(crate) struct Read {
    /// JSON value.
    pub(crate) value: Value,
    /// Position of each value.
    pub(crate) place: Place,
    /// Errors that JSON parsers do not report.
    pub(crate) faults: Vec<Fault>,
}

/// Parses a text. The first syntax error ends the parsing.
pub(crate) fn read(text: &str, origin: &Origin) -> Result<Read, Fault> {
    if text.len() > MAX_BYTES {
        let message = format!("a scenario has at most {MAX_BYTES} bytes, this one has {}", text.len());
        return Err(origin.fault(Range::new(0, 1), message));
    }
    let text = &*comment::blanked(text).map_err(|range| {
        let fault = origin.fault(Range::new(range.start, range.end), "not JSON: this comment does not end");
        fault.help("close it with */, or begin it with // to end with its line")
    })?;
    check_outline(text, origin)?;
    let tree = parse(text, origin)?;
    let mut walk = Walk { origin, path: origin.path.clone(), faults: Vec::new(), unread: Vec::new() };
    let place = walk.value(&tree, None);
    // The values are read a second time by serde_json, which rounds numbers correctly. It also refuses texts that the first
    // parser accepts although they are not JSON.
    let mut plain = Cow::Borrowed(text);
    for range in walk.unread {
        let number = format!("{:<1$}", 0, range.end - range.start);
        plain.to_mut().replace_range(range.start..range.end, &number);
    }
    let value = serde_json::from_str(&plain).map_err(|error| second_opinion(text, &error, origin))?;
    Ok(Read { value, place, faults: walk.faults })
}

/// Checks nesting depth and unterminated strings before the recursive parser runs.
fn check_outline(text: &str, origin: &Origin) -> Result<(), Fault> {
    let (mut depth, mut string, mut escaped) = (0_usize, None, false);
    for (i, byte) in text.bytes().enumerate() {
        match (byte, string) {
            (b'\n', Some(_)) => return Err(origin.slipped(slip::quote_missing(text, i))),
            (0..0x20, Some(_)) => {
                let fault =
                    origin.fault(Range::new(i, i + 1), "not JSON: a control character inside a string");
                return Err(fault.help("write a space, or \\t for a tab"));
            }
            _ if escaped => escaped = false,
            (b'\\', Some(_)) => escaped = true,
            (b'"', Some(_)) => string = None,
            (_, Some(_)) => {}
            (b'"', None) => string = Some(i),
            (b'{' | b'[', None) => {
                depth += 1;
                if depth > MAX_DEPTH {
                    let message = format!("objects and lists are nested more than {MAX_DEPTH} deep");
                    return Err(origin.fault(Range::new(i, i + 1), message));
                }
            }
            (b'}' | b']', None) => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    match string {
        Some(_) => Err(origin.slipped(slip::quote_missing(text, text.len()))),
        None => Ok(()),
    }
}

fn parse<'a>(text: &'a str, origin: &Origin) -> Result<ast::Value<'a>, Fault> {
    let strict = ParseOptions {
        // Comments are already replaced by blanks.
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    };
    match jsonc_parser::parse_to_ast(text, &CollectOptions::default(), &strict) {
        Ok(result) => result.value.ok_or_else(|| {
            origin
                .fault(Range::new(0, 1), "the file is empty: a scenario is a JSON object")
                .help("start with { \"stickslip\": 1, \"title\": \"…\" }")
        }),
        Err(error) => Err(origin.slipped(slip::of(text, &error))),
    }
}

/// Converts an error of `serde_json`, whose position is a line and a column in bytes.
fn second_opinion(text: &str, error: &serde_json::Error, origin: &Origin) -> Fault {
    let line_start: usize =
        text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let at = line_start + error.column().saturating_sub(1);
    if let Some(slip) = slip::at_character(text, at) {
        return origin.slipped(slip);
    }
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    origin.fault(Range::new(at, at + 1), format!("not JSON: {message}"))
}

/// Records positions, and errors that JSON parsers do not report.
struct Walk<'a> {
    origin: &'a Origin,
    path: KeyPath,
    faults: Vec<Fault>,
    /// Ranges of numbers that are too large or too small for a floating-point number.
    unread: Vec<Range>,
}

impl Walk<'_> {
    fn note(&mut self, fault: Fault) {
        if self.faults.len() < MAX_FAULTS {
            self.faults.push(fault);
        }
    }

    fn value(&mut self, value: &ast::Value<'_>, key: Option<Span>) -> Place {
        let span = self.origin.span(value.range());
        let inner = match value {
            ast::Value::Object(object) => self.object(object),
            ast::Value::Array(array) => {
                let mut places = Vec::with_capacity(array.elements.len());
                for (i, element) in array.elements.iter().enumerate() {
                    self.path.0.push(Step::Index(i));
                    places.push(self.value(element, None));
                    self.path.0.pop();
                }
                Inner::List(places)
            }
            ast::Value::NumberLit(number) => {
                // A number literal of the parser is a number.
                let value = number.value.parse().unwrap_or(f64::NAN);
                if let Some(why) = out_of_reach(number.value, value) {
                    self.note(Fault::new(self.path.clone(), why).at_span(span));
                    self.unread.push(number.range);
                }
                Inner::Leaf
            }
            // An end without a stop.
            ast::Value::NullKeyword(_) if is_stop(&self.path.0) => Inner::Leaf,
            ast::Value::NullKeyword(_) => {
                let fault = Fault::new(self.path.clone(), "null is not a value of a scenario").at_span(span);
                self.note(fault.help("leave the key out for its default"));
                Inner::Leaf
            }
            ast::Value::StringLit(_) | ast::Value::BooleanLit(_) => Inner::Leaf,
        };
        Place { key, value: span, inner }
    }

    fn object(&mut self, object: &ast::Object<'_>) -> Inner {
        let mut first: HashMap<&str, usize> = HashMap::new();
        let mut entries = Vec::with_capacity(object.properties.len());
        for property in &object.properties {
            let name = property.name.as_str();
            let range = match &property.name {
                ast::ObjectPropName::String(literal) => literal.range,
                ast::ObjectPropName::Word(literal) => literal.range,
            };
            let span = self.origin.span(range);
            self.path.0.push(Step::Key(name.to_owned()));
            if let Some(&before) = first.get(name) {
                let twice = Fault::new(self.path.clone(), "this key occurs twice").at_span(span);
                let help = format!("remove one; the first is {}", brief(&object.properties[before].value));
                self.note(twice.help(help).mend(Mend::Leave(Some(self.path.clone()))));
            } else {
                first.insert(name, entries.len());
            }
            let place = self.value(&property.value, Some(span));
            self.path.0.pop();
            entries.push((name.to_owned(), place));
        }
        Inner::Object(entries)
    }
}

fn brief(value: &ast::Value<'_>) -> String {
    match value {
        ast::Value::StringLit(literal) => format!("\"{}\"", crate::document::shown(&literal.value)),
        ast::Value::NumberLit(literal) => crate::document::shown(literal.value),
        ast::Value::BooleanLit(literal) => literal.value.to_string(),
        ast::Value::Object(_) => "an object".to_owned(),
        ast::Value::Array(_) => "a list".to_owned(),
        ast::Value::NullKeyword(_) => "null".to_owned(),
    }
}

/// Whether a path leads to an end of a stop, such as `stops.travel.x[0]`.
fn is_stop(path: &[Step]) -> bool {
    matches!(path, [Step::Key(part), Step::Key(_), Step::Key(_), Step::Index(_)] if part == "stops")
}
