//! Results of a case: channels at the end of the run, and numbers and words of its summary.

use schemars::generate::SchemaSettings;
use serde_json::Value;
use std::sync::OnceLock;
use stickslip_drive::{Channel, state_name};
use stickslip_quantity::names;
use stickslip_run::{Job, Summary};
use stickslip_scenario::{ScenarioError, StudyFile, suggestion};

/// Part of the summary that differs between runs of the same case.
const UNSTEADY: &str = "timing";
/// Part of the summary that needs a search for the periodic orbit.
const OUTLOOK: &str = "steady_motion";
/// Results of settled steps that also need the search for the periodic orbit.
const COMPARED: [&str; 2] = ["steps.steady.error_m", "steps.steady.back_step"];

/// Returns whether a number of the summary is computed from rows of the time histories. Examples are peak loads and maxima of the energy
/// balance. All other numbers need only the end of the run and events.
pub(crate) fn needs_rows(name: &str) -> bool {
    match name.split('.').next() {
        Some("steps" | "status") => false,
        Some("energy") => name.contains("largest") || name.contains("throughput"),
        Some("contacts") => name.contains(".peak_") || name.contains(".normal."),
        _ => true,
    }
}

/// A result of each case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wanted {
    /// Name in the study file.
    pub(crate) name: String,
    pub(crate) place: Place,
    /// Words that the codes represent, by index; `None` for a number.
    pub(crate) codes: Option<Vec<String>>,
}

/// Source of a result.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Place {
    /// A channel at the end of the run, by its index in a row.
    End(usize),
    /// The summary, by keys and list indices.
    Summary(Vec<String>),
}

impl Wanted {
    /// Finds the result with a given name.
    ///
    /// # Errors
    /// Fails if the result does not exist, or is neither a number nor a word.
    pub(crate) fn named(
        file: &StudyFile,
        job: &Job,
        (key, name): (&str, &str),
    ) -> Result<Self, ScenarioError> {
        let channels = job.model.channels();
        let is = |channel: &Channel| channel.name == name || names::bare(&channel.name) == name;
        if let Some(place) = channels.iter().position(is) {
            let codes =
                channels[place].is_state.then(|| STATES.map(|code| state_name(code).to_owned()).to_vec());
            return Ok(Self { name: name.to_owned(), place: Place::End(place), codes });
        }
        let refused = |message: &str, help: Option<String>| Err(file.refusal(key, Some(name), message, help));
        let keys: Vec<String> =
            name.replace('[', ".").replace(']', "").split('.').map(str::to_owned).collect();
        if keys[0] == UNSTEADY {
            return refused("the computing time differs from run to run", None);
        }
        let root = summary_schema();
        let mut here = vec![root];
        for (depth, key) in keys.iter().enumerate() {
            let next: Vec<&Value> = here.iter().flat_map(|schema| inside(root, schema, key)).collect();
            let named = job.model.contacts().any(|(contact, _)| contact == key);
            if next.is_empty() || keys[..depth] == ["contacts"] && !named {
                let before: String = keys[..depth].iter().map(|key| format!("{key}.")).collect();
                let known = known(&here, job, (&keys[..depth], &channels));
                let whole: Vec<String> = known.iter().map(|key| format!("{before}{key}")).collect();
                let help = suggestion(&format!("{before}{key}"), whole.iter().map(String::as_str));
                return refused("there is no such result", help);
            }
            here = next;
        }
        match sort(root, &here) {
            Sort::Number => Ok(Self { name: name.to_owned(), place: Place::Summary(keys), codes: None }),
            Sort::Words(codes) => {
                Ok(Self { name: name.to_owned(), place: Place::Summary(keys), codes: Some(codes) })
            }
            Sort::Text => refused("this result is a text; expected a number or a keyword", None),
            Sort::Whole => {
                let known = known(&here, job, (&keys, &[]));
                let help = suggestion("", known.iter().map(String::as_str));
                refused("this is not a number, it has several results", help)
            }
        }
    }

    /// Returns whether the result belongs to the periodic orbit and needs no run.
    pub(crate) fn is_of_motion(&self) -> bool {
        matches!(&self.place, Place::Summary(keys) if keys[0] == OUTLOOK)
    }

    /// Returns whether the result needs the search for the periodic orbit.
    pub(crate) fn needs_outlook(&self) -> bool {
        self.is_of_motion() || COMPARED.contains(&self.name.as_str())
    }

    /// Returns whether the result is computed from rows of the time histories, see [`needs_rows`].
    pub(crate) fn needs_rows(&self) -> bool {
        matches!(self.place, Place::Summary(_)) && !self.is_of_motion() && needs_rows(&self.name)
    }

    /// Returns the value of the result in a summary: a number or the code of a word. Returns NaN if the summary lacks the result.
    pub(crate) fn of(&self, summary: &Value) -> f64 {
        let Place::Summary(keys) = &self.place else { return f64::NAN };
        let step = |here: &'_ Value, key: &String| match here {
            Value::Array(all) => all.get(key.parse::<usize>().ok()?).cloned(),
            here => here.get(key).cloned(),
        };
        let mut here = summary.clone();
        for key in keys {
            match step(&here, key) {
                Some(next) => here = next,
                None => return f64::NAN,
            }
        }
        let code =
            |word: &str| self.codes.as_ref()?.iter().position(|known| known == word).map(|code| code as f64);
        match &here {
            Value::Number(number) => number.as_f64().unwrap_or(f64::NAN),
            Value::String(word) => code(word).unwrap_or(f64::NAN),
            Value::Bool(is) => f64::from(u8::from(*is)),
            _ => f64::NAN,
        }
    }
}

/// Parts of the summary with results that are suggested in error messages.
const HOLDERS: [&str; 6] = ["contacts", "steps", "steady_motion", "energy", "drivers", "counts"];
/// Codes of the states of a contact.
const STATES: [f64; 4] = [0.0, 1.0, 2.0, 3.0];

/// Returns the JSON Schema of a summary.
fn summary_schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| {
        let settings = SchemaSettings::draft2020_12().for_serialize();
        settings.into_generator().into_root_schema_for::<Summary>().to_value()
    })
}

/// Collects a schema, its references and alternatives recursively.
fn parts<'a>(root: &'a Value, schema: &'a Value, found: &mut Vec<&'a Value>) {
    found.push(schema);
    let name = schema.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix("#/$defs/"));
    if let Some(named) = name.and_then(|name| root.get("$defs")?.get(name)) {
        parts(root, named, found);
    }
    for choice in ["oneOf", "anyOf", "allOf"].iter().filter_map(|key| schema.get(*key)?.as_array()).flatten()
    {
        parts(root, choice, found);
    }
}

/// Returns the schemas that a schema has for a key or a list index.
fn inside<'a>(root: &'a Value, schema: &'a Value, key: &str) -> Vec<&'a Value> {
    let mut all = Vec::new();
    parts(root, schema, &mut all);
    let is_place = key.parse::<usize>().is_ok();
    let of = |part: &&'a Value| {
        let own = part.get("properties").and_then(|keys| keys.get(key));
        let other = part.get("additionalProperties").filter(|other| other.is_object());
        own.or(other).or_else(|| part.get("items").filter(|_| is_place))
    };
    all.iter().filter_map(of).collect()
}

/// Type of a result.
enum Sort {
    Number,
    /// One of several words.
    Words(Vec<String>),
    /// Any text.
    Text,
    /// An object or list.
    Whole,
}

fn sort(root: &Value, schemas: &[&Value]) -> Sort {
    let mut all = Vec::new();
    schemas.iter().for_each(|schema| parts(root, schema, &mut all));
    let words: Vec<String> = all
        .iter()
        .flat_map(|part| {
            let list = part.get("enum").and_then(Value::as_array).into_iter().flatten();
            list.chain(part.get("const")).filter_map(Value::as_str).map(str::to_owned).collect::<Vec<_>>()
        })
        .collect();
    if !words.is_empty() {
        return Sort::Words(words);
    }
    let types = |part: &&Value| match part.get("type") {
        Some(Value::Array(all)) => all.iter().filter_map(Value::as_str).map(str::to_owned).collect(),
        Some(Value::String(one)) => vec![one.clone()],
        _ => Vec::new(),
    };
    let types: Vec<String> = all.iter().flat_map(types).collect();
    let has = |kind: &str| types.iter().any(|known| known == kind);
    match () {
        () if has("object") || has("array") => Sort::Whole,
        () if has("number") || has("integer") => Sort::Number,
        () if has("boolean") => Sort::Words(["false", "true"].map(str::to_owned).to_vec()),
        () => Sort::Text,
    }
}

/// Returns suggestions for an error message: keys at a path of the summary; at the root of the summary also the channels.
fn known(here: &[&Value], job: &Job, (path, channels): (&[String], &[Channel])) -> Vec<String> {
    if path == ["contacts"] {
        return job.model.contacts().map(|(name, _)| name.to_owned()).collect();
    }
    let root = summary_schema();
    let mut all = Vec::new();
    here.iter().for_each(|schema| parts(root, schema, &mut all));
    let keys = all.iter().filter_map(|part| part.get("properties")?.as_object()).flat_map(|keys| keys.keys());
    let keys = keys.filter(|key| !path.is_empty() || HOLDERS.contains(&key.as_str())).cloned();
    let channels = channels.iter().map(|channel| channel.name.clone()).filter(|_| path.is_empty());
    channels.chain(keys).collect()
}
