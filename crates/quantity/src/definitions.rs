//! Definitions of all columns and results. Columns take them from the tables in [`columns`](crate::columns), keys of
//! reports from the doc comments of the fields. `stickslip explain` and the page `docs/definitions.md` print them.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::fmt::Write;

/// Definition of a column or key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Definition {
    /// Name of the file or report, such as `trace.csv`.
    pub file: &'static str,
    /// Name of the column or path of the key. Words in capitals such as `BODY` stand for names of the scenario or run.
    pub name: Cow<'static, str>,
    /// Meaning, with formula.
    pub text: Cow<'static, str>,
}

/// Columns of a table with their definitions.
#[derive(Debug, Clone, Copy)]
pub struct Columns {
    /// Name of the file.
    pub file: &'static str,
    /// Names in their order.
    pub names: &'static [&'static str],
    /// Definitions in the same order.
    pub texts: &'static [&'static str],
}

impl Columns {
    /// Returns the definition of a column of a written table, such as `slider.x_m`. Returns an empty text for an
    /// unknown name.
    #[must_use]
    pub fn text(&self, name: &str) -> &'static str {
        let columns = || self.names.iter().zip(self.texts);
        // An exact name has priority: `energy.elastic_J` also fits `CONTACT.elastic_J`.
        let own = columns().find(|(known, _)| **known == name);
        own.or_else(|| columns().find(|(known, _)| is_written_out(known, name))).map_or("", |(_, text)| text)
    }

    /// Returns the definitions of all columns.
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

/// Words that stand for names of the scenario or run.
const PLACEHOLDERS: [&str; 9] =
    ["ACTUATOR", "AXIS", "BODY", "CODE", "CONTACT", "COORDINATE", "FILE", "LOAD", "WAVEFORM"];
/// Schema keyword with the placeholder for the names of a map or of several fields.
const NAMED: &str = "x-name";

/// Returns the definitions of all numbers and words of a report, taken from the schema of its type.
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

/// Collects names and texts of the leaves of a schema, that is of everything that contains no object. A field without a
/// comment takes the comment of its enum variant. The tag of a variant takes the comment of the field that holds the
/// enum.
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

/// Returns whether a schema describes an object, or a list or choice of objects.
fn holds_others(schema: &Map<String, Value>) -> bool {
    let within = |key: &str| match schema.get(key) {
        Some(Value::Array(all)) => all.iter().filter_map(Value::as_object).any(holds_others),
        Some(Value::Object(one)) => holds_others(one),
        _ => false,
    };
    ["properties", "additionalProperties"].iter().any(|key| schema.contains_key(*key))
        || ["anyOf", "oneOf", "allOf", "items"].iter().any(|key| within(key))
}

/// Returns whether one of the choices of a schema is a string.
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
    /// Returns whether a name means this definition. `slider.x_m` means `BODY.x_m`; the end of a path, such as
    /// `steady.step_m`, is sufficient.
    pub fn is(&self, asked: &str) -> bool {
        let mut known: Vec<&str> = self.name.split('.').collect();
        // A placeholder at the end may be omitted.
        while known.last().is_some_and(|last| PLACEHOLDERS.contains(last)) {
            known.pop();
        }
        let asked: Vec<&str> = asked.split('.').collect();
        let fits =
            |known: &str, asked: &str| known == asked || (PLACEHOLDERS.contains(&known) && !asked.is_empty());
        asked.len() <= known.len()
            && known.iter().rev().zip(asked.iter().rev()).all(|(known, asked)| fits(known, asked))
    }

    /// Returns whether a name is that of an object which contains this key, such as `drivers` or `at_limit`.
    pub fn is_within(&self, asked: &str) -> bool {
        self.name.rsplit_once('.').is_some_and(|(holders, _)| {
            holders.split('.').any(|holder| holder == asked && !PLACEHOLDERS.contains(&holder))
        })
    }

    /// Returns whether the text begins with a symbol, as in `u_c = κd …` or `a, contact radius …`. A digit matches its
    /// subscript, and `Q` matches `Q*`.
    pub fn has_symbol(&self, asked: &str) -> bool {
        let Some((symbol, _)) = self.text.split_once([' ', ',']) else { return false };
        let rest = &self.text[symbol.len()..];
        let plain: String = symbol.chars().map(|c| lowered(c).unwrap_or(c)).collect();
        // Q means Q*, too.
        let is = |symbol: &str| symbol == asked || symbol.strip_suffix('*') == Some(asked);
        (rest.starts_with(',') || rest.starts_with(" = ")) && (is(symbol) || is(&plain))
    }

    /// Returns whether a word stands between backticks in the text, such as `partial` among the states.
    pub fn says(&self, asked: &str) -> bool {
        self.text.split('`').skip(1).step_by(2).any(|word| word == asked)
    }

    /// Returns whether this is the definition of a column or key of a written file.
    pub fn defines(&self, file: &str, name: &str) -> bool {
        self.file == file && is_written_out(&self.name, name)
    }
}

/// Returns whether a name results from a known name by replacing its placeholders.
fn is_written_out(known: &str, name: &str) -> bool {
    known.split('.').count() == name.split('.').count()
        && known
            .split('.')
            .zip(name.split('.'))
            .all(|(known, given)| known == given || PLACEHOLDERS.contains(&known))
}

/// Returns the digit of a subscript digit.
fn lowered(below: char) -> Option<char> {
    char::from_digit(u32::from(below).checked_sub(u32::from('₀'))?, 10)
}

/// Returns the page `docs/definitions.md` in Markdown. The definitions must be sorted by file.
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

All columns of tables and all keys of results, with formulas: files of runs and studies, and the output of `info`, `contact`, `steady`,
`branch`, `curve`, `sensitivity`, `map`, `study`, `check`, `validate` and `realtime`. `stickslip explain NAME` prints the
rows of a name, symbol or term, `stickslip explain` prints this page. Keys of scenarios are in [reference/scenario.md](reference/scenario.md).

* A name ends with its SI unit: `step_m` is in m, `stiffness_N_m` in N/m, `velocity_m_s` in m/s, `work_J_m2` in J/m². Names without a
  unit are ratios, counts, words or lists.
* Words in capitals stand for names of the scenario, such as BODY and CONTACT. LOAD is `start`, or `smallest` and `largest` for a varying
  load.
* *Absent* means that the key is missing, *empty* that the cell of a table is empty.
* Numbers in parentheses, such as (4.26), are equations of the *Handbook of Contact Mechanics* (Popov, Heß, Willert 2019).

[Evaluation of runs](theory/evaluation.md) describes how steps and loops are evaluated, [physics](theory/physics.md) the equations of the
model, [contact mechanics](theory/contact_mechanics.md) the contacts, [periodic orbits](theory/periodic_orbits.md) multipliers and errors.
These symbols occur in many rows:

| symbol | meaning | symbol | meaning |
| --- | --- | --- | --- |
| u | tangential displacement of a contact | F_x | tangential force |
| d | indentation | F_N | normal force |
| a | contact radius | μ | coefficient of friction |
| c | stick radius | E\\*, G\\* | effective modulus, effective shear modulus |
| s | tangential stretch of a spring | κ | stick slope μE\\*/G\\* |
| u_c | gross slip displacement κd | f(r), g(x) | profile, substitute profile |
| S₀ | zero-step stroke | λ | Floquet multiplier |
";

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Serialize;

    /// Report with all kinds of fields.
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
        // A placeholder at the end may be omitted.
        let states = Definition { file: "", name: Cow::Borrowed("states.CODE"), text: Cow::Borrowed("") };
        assert!(states.is("states"));
    }

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
        // Words of sentences are no symbols.
        for word in ["time", "displacement", "the", "₀", ""] {
            assert_eq!(found(word), 0, "{word}");
        }
    }
}
