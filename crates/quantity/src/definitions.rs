//! What every column of every table and every number of every report is: columns have a table of their own, of a report the
//! comments of its fields say it. `stickslip explain` and the page `docs/definitions.md` read both.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::fmt::Write;

/// What a column or a key is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Definition {
    /// The file, such as `trace.csv`.
    pub file: &'static str,
    /// Its name there, which ends with the unit: words in capitals such as `BODY` stand for names that the scenario or the run gives.
    pub name: Cow<'static, str>,
    /// What it is, with its formula.
    pub text: Cow<'static, str>,
}

/// The columns of a table.
#[derive(Debug, Clone, Copy)]
pub struct Columns {
    /// The file.
    pub file: &'static str,
    /// Their names, in order.
    pub names: &'static [&'static str],
    /// What they are, in the same order.
    pub texts: &'static [&'static str],
}

impl Columns {
    /// What a column is by its name, written out; empty where there is none.
    #[must_use]
    pub fn text(&self, name: &str) -> &'static str {
        let columns = || self.names.iter().zip(self.texts);
        // `energy.elastic_J` is not the elastic energy of a contact.
        let own = columns().find(|(known, _)| **known == name);
        own.or_else(|| columns().find(|(known, _)| is_written_out(known, name))).map_or("", |(_, text)| text)
    }

    /// What they are.
    pub fn definitions(&self) -> impl Iterator<Item = Definition> + use<> {
        let file = self.file;
        let columns = self.names.iter().zip(self.texts);
        columns.map(move |(name, text)| Definition {
            file,
            name: Cow::Borrowed(name),
            text: Cow::Borrowed(text),
        })
    }
}

/// Names that are not the same in every run.
const PLACEHOLDERS: [&str; 9] =
    ["ACTUATOR", "AXIS", "BODY", "CODE", "CONTACT", "COORDINATE", "FILE", "LOAD", "WAVEFORM"];
/// The word for the names of a map, or for a name of several, in the schema of a field.
const NAMED: &str = "x-name";

/// The numbers of a report: the comment of a field is what it is.
#[must_use]
pub fn report<T: JsonSchema>(file: &'static str) -> Vec<Definition> {
    let settings = SchemaSettings::draft2020_12().for_serialize().with(|settings| {
        settings.inline_subschemas = true;
        settings.meta_schema = None;
    });
    let schema = settings.into_generator().into_root_schema_for::<T>();
    let mut found = Vec::new();
    if let Some(schema) = schema.as_object() {
        leaves(schema, "", "", &mut found);
    }
    let definition = |(name, text)| Definition { file, name: Cow::Owned(name), text: Cow::Owned(text) };
    found.into_iter().map(definition).collect()
}

/// Names and texts of what a schema of a name and a text holds: a leaf is what holds no others. What has no comment takes that of the variant
/// that it stands in, but for the word that says which variant it is: there the comment of the field counts.
fn leaves(schema: &Map<String, Value>, name: &str, text: &str, found: &mut Vec<(String, String)>) {
    let comment =
        |schema: &'_ Map<String, Value>| schema.get("description").and_then(Value::as_str).map(str::to_owned);
    let described = |inner: &Map<String, Value>| {
        let of_variant = || comment(schema).filter(|_| !inner.contains_key("const"));
        comment(inner).or_else(of_variant).unwrap_or_else(|| text.to_owned())
    };
    let mut holds = false;
    for (key, inner) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
        let Some(inner) = inner.as_object() else { continue };
        let key = named(inner).filter(|_| !inner.contains_key("additionalProperties")).unwrap_or(key);
        leaves(inner, &joined(name, key), &described(inner), found);
        holds = true;
    }
    let map = schema.get("additionalProperties").and_then(Value::as_object);
    if let (Some(key), Some(inner)) = (named(schema), map) {
        leaves(inner, &joined(name, key), &described(inner), found);
        holds = true;
    }
    let items = schema.get("items").and_then(Value::as_object);
    let variants =
        ["anyOf", "oneOf", "allOf"].iter().filter_map(|kind| schema.get(*kind)?.as_array()).flatten();
    for inner in items.into_iter().chain(variants.filter_map(Value::as_object)) {
        if holds_others(inner) {
            leaves(inner, name, text, found);
            holds |= items.is_some() || !has_words(schema);
        }
    }
    if !holds && !name.is_empty() && found.iter().all(|(known, _)| known != name) {
        found.push((name.to_owned(), text.replace('\n', " ")));
    }
}

/// Whether a schema is one of an object, or of a list or choice of objects.
fn holds_others(schema: &Map<String, Value>) -> bool {
    let within = |key: &str| match schema.get(key) {
        Some(Value::Array(all)) => all.iter().filter_map(Value::as_object).any(holds_others),
        Some(Value::Object(one)) => holds_others(one),
        _ => false,
    };
    ["properties", "additionalProperties"].iter().any(|key| schema.contains_key(*key))
        || ["anyOf", "oneOf", "allOf", "items"].iter().any(|key| within(key))
}

/// Whether one of the choices is a word.
fn has_words(schema: &Map<String, Value>) -> bool {
    let choices = ["anyOf", "oneOf"].iter().filter_map(|kind| schema.get(*kind)?.as_array()).flatten();
    choices.filter_map(Value::as_object).any(|choice| choice.get("type").is_some_and(|kind| kind == "string"))
}

fn named(schema: &Map<String, Value>) -> Option<&str> {
    schema.get(NAMED).and_then(Value::as_str)
}

fn joined(name: &str, key: &str) -> String {
    if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") }
}

impl Definition {
    /// Whether it is what a name means: `slider.x_m` is `BODY.x_m`, `x_m` and `steady.step_m` are ends of names.
    pub fn is(&self, asked: &str) -> bool {
        let mut known: Vec<&str> = self.name.split('.').collect();
        // What is the same for all names at its end is asked for without one.
        while known.last().is_some_and(|last| PLACEHOLDERS.contains(last)) {
            known.pop();
        }
        let asked: Vec<&str> = asked.split('.').collect();
        let fits =
            |known: &str, asked: &str| known == asked || (PLACEHOLDERS.contains(&known) && !asked.is_empty());
        asked.len() <= known.len()
            && known.iter().rev().zip(asked.iter().rev()).all(|(known, asked)| fits(known, asked))
    }

    /// Whether a name is that of something which holds it: `drivers`, `at_limit`.
    pub fn is_within(&self, asked: &str) -> bool {
        self.name.rsplit_once('.').is_some_and(|(holders, _)| {
            holders.split('.').any(|holder| holder == asked && !PLACEHOLDERS.contains(&holder))
        })
    }

    /// Whether its text begins with a symbol and what that is: `u_c = κd …` or `a, contact radius …`; digits may stand for those
    /// below the line.
    pub fn has_symbol(&self, asked: &str) -> bool {
        let Some((symbol, _)) = self.text.split_once([' ', ',']) else { return false };
        let rest = &self.text[symbol.len()..];
        let plain: String = symbol.chars().map(|c| lowered(c).unwrap_or(c)).collect();
        // Amplitudes, as in Q*, are asked for without their stars as well.
        let is = |symbol: &str| symbol == asked || symbol.strip_suffix('*') == Some(asked);
        (rest.starts_with(',') || rest.starts_with(" = ")) && (is(symbol) || is(&plain))
    }

    /// Whether a word is one of those that it may say, such as `partial` of a state.
    pub fn says(&self, asked: &str) -> bool {
        self.text.split('`').skip(1).step_by(2).any(|word| word == asked)
    }

    /// Whether it is the definition of this column or key of its file, written out.
    pub fn defines(&self, file: &str, name: &str) -> bool {
        self.file == file && is_written_out(&self.name, name)
    }
}

/// Whether a name is a known one with its words in capitals replaced.
fn is_written_out(known: &str, name: &str) -> bool {
    known.split('.').count() == name.split('.').count()
        && known
            .split('.')
            .zip(name.split('.'))
            .all(|(known, given)| known == given || PLACEHOLDERS.contains(&known))
}

/// The digit that stands below the line.
fn lowered(below: char) -> Option<char> {
    char::from_digit(u32::from(below).checked_sub(u32::from('₀'))?, 10)
}

/// The page `docs/definitions.md`, in Markdown; definitions of one file stand together.
#[must_use]
pub fn page(definitions: &[Definition]) -> String {
    let mut page = INTRODUCTION.to_owned();
    let mut file = "";
    for definition in definitions {
        if definition.file != file {
            file = definition.file;
            let _ = write!(page, "\n## {file}\n\n| name | what it is |\n| --- | --- |\n");
        }
        let _ = writeln!(page, "| `{}` | {} |", definition.name, definition.text.replace('|', "\\|"));
    }
    page
}

const INTRODUCTION: &str = "\
# Definitions

Every column of the tables of runs and studies, every key of `summary.json`, and what `info`, `contact`, `steady`, `check`,
`validate`, `curve`, `sensitivity` and `realtime` print. `stickslip explain NAME` prints one of these lines, `stickslip explain`
without a name this page. Names end with their unit. BODY, CONTACT and other words in capitals stand for names of the scenario; LOAD is
`start`, or `smallest` and `largest` of a load that varies. [Figures](figures.md) describes how steps and loops are measured, and how
exactly; [physics](physics.md) what the contacts obey. Numbers in brackets such as (4.26) are equations of the *Handbook of Contact
Mechanics* (Popov, Heß, Willert 2019). `info` and `contact` print the same numbers as tables for people, with the symbols that stand
first here. `stickslip explain` knows the keys of scenarios, too.
";

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Serialize;

    /// A report of all kinds of fields.
    #[derive(Serialize, JsonSchema)]
    #[allow(dead_code, reason = "only the types are read")]
    struct Whole {
        /// a number
        one: f64,
        /// of one
        #[schemars(extend("x-name" = "LOAD"))]
        least: Option<Part>,
        /// of the other
        #[schemars(extend("x-name" = "LOAD"))]
        most: Option<Part>,
        #[serde(flatten)]
        flat: Option<Flat>,
        /// `a` or `b`
        state: Tagged,
        /// `still`, or what moves it
        moves: Moves,
        list: Vec<Part>,
    }

    #[derive(Serialize, JsonSchema)]
    struct Part {
        /// a force
        /// of two lines
        #[serde(rename = "force_N", skip_serializing_if = "Option::is_none")]
        force: Option<f64>,
    }

    #[derive(Serialize, JsonSchema)]
    struct Flat {
        /// flat
        inner: bool,
    }

    #[derive(Serialize, JsonSchema)]
    #[serde(tag = "kind", rename_all = "snake_case")]
    #[allow(dead_code, reason = "only the types are read")]
    enum Tagged {
        /// The first of two.
        A,
        B {
            /// of b
            height_m: f64,
        },
    }

    #[derive(Serialize, JsonSchema)]
    #[serde(rename_all = "snake_case")]
    #[allow(dead_code, reason = "only the types are read")]
    enum Moves {
        /// The first of two.
        Still,
        /// its waveform
        Follows(String),
    }

    #[test]
    fn fields_of_reports_are_found_with_their_comments() {
        let found = report::<Whole>("whole.json");
        let found: Vec<_> = found.iter().map(|one| (one.name.as_ref(), one.text.as_ref())).collect();
        let expected = [
            ("one", "a number"),
            ("LOAD.force_N", "a force of two lines"),
            ("inner", "flat"),
            ("state.kind", "`a` or `b`"),
            ("state.height_m", "of b"),
            ("moves.follows", "its waveform"),
            ("moves", "`still`, or what moves it"),
            ("list.force_N", "a force of two lines"),
        ];
        assert_eq!(found, expected);
    }

    fn known() -> Vec<Definition> {
        use crate::columns::{CONTACT_NORMAL, EVENTS, TRACE};
        [TRACE, EVENTS, CONTACT_NORMAL].iter().flat_map(Columns::definitions).collect()
    }

    #[test]
    fn names_are_found_whole_and_by_their_ends() {
        let all = known();
        let found = |asked: &str| {
            all.iter().filter(|d| d.is(asked)).map(|d| (d.file, d.name.as_ref())).collect::<Vec<_>>()
        };
        assert_eq!(found("slider.x_m"), [("trace.csv", "BODY.x_m")]);
        assert_eq!(found("stick_m"), [("trace.csv", "CONTACT.stick_m")]);
        assert!(found("nothing").is_empty() && found("BODY").is_empty() && found("").is_empty());
        // What ends with a name is found without one.
        let states = Definition { file: "", name: Cow::Borrowed("states.CODE"), text: Cow::Borrowed("") };
        assert!(states.is("states"));
    }

    /// States and regimes were called by nothing.
    #[test]
    fn words_of_states_are_found() {
        let all = known();
        for (word, name) in [("slip", "CONTACT.state"), ("gross slip", "kind")] {
            assert!(all.iter().any(|definition| definition.says(word) && definition.name == name), "{word}");
        }
        assert!(!all.iter().any(|definition| definition.says("") || definition.says("no word")));
    }

    #[test]
    fn symbols_are_found_where_a_text_begins_with_them() {
        let all = known();
        let found = |asked: &str| all.iter().filter(|definition| definition.has_symbol(asked)).count();
        for symbol in ["u_c", "F_N", "a", "d"] {
            assert!(found(symbol) > 0, "{symbol}");
        }
        let starred =
            Definition { file: "", name: Cow::Borrowed("x"), text: Cow::Borrowed("S₀ = κd, so") };
        assert!(starred.has_symbol("S₀") && starred.has_symbol("S0"));
        let starred = Definition { text: Cow::Borrowed("Q* = (F_max - F_min)/2"), ..starred };
        assert!(starred.has_symbol("Q") && starred.has_symbol("Q*"));
        // Words of sentences are none.
        for word in ["time", "displacement", "the", "₀", ""] {
            assert_eq!(found(word), 0, "{word}");
        }
    }
}
