//! Finds numbers of a scenario that may be varied, by key path.

use crate::error::ScenarioError;
use crate::guide::Guide;
use crate::path::{KeyPath, Step};
use crate::scenario::Scenario;
use crate::suggest;
use crate::units::Kind;
use serde_json::Value;
use std::collections::HashSet;

/// Maximum depth of the search for the dimension in the schema.
const DEEPEST: usize = 8;
/// Sections that concern execution of a run and have no influence on the motion.
const OF_A_RUN: [&str; 3] = ["output", "plots", "run"];

/// Keys of the schema for the bounds of a number.
const BELOW: [&str; 2] = ["minimum", "exclusiveMinimum"];
const ABOVE: [&str; 2] = ["maximum", "exclusiveMaximum"];
/// Longest list whose numbers are parameters. Longer lists are data, such as the points of a waveform.
const LIST: usize = 4;
/// Sections of the scenario whose entries have an effect only if another part refers to them by name.
const LISTS: [&str; 2] = ["materials", "waveforms"];
/// Keys that only limit the duration of a waveform.
const LENGTHS: [&str; 1] = ["cycles"];

/// Number of a scenario that may be varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Key path, such as `contacts.ball.friction`.
    pub path: String,
    /// Value in `unit`, or the default. `None` if the scenario omits the key and there is no known default.
    pub value: Option<f64>,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Whether the number is an integer, such as a count.
    pub is_whole: bool,
    /// Smallest and largest value that the schema allows, bounds themselves included or not; infinite without a bound.
    pub range: [f64; 2],
    /// First sentence of the description.
    pub text: String,
}

impl Scenario {
    /// Returns the number at a key path, if the motion depends on it continuously.
    ///
    /// # Errors
    /// No number at the path, an integer, or a key of `run`, `output` or `plots`.
    pub fn parameter(&self, path: &str) -> Result<Parameter, ScenarioError> {
        let is_in =
            |steps: &KeyPath, part: &&str| KeyPath::parse(part).is_some_and(|part| steps.lies_in(&part));
        if KeyPath::parse(path).is_some_and(|steps| OF_A_RUN.iter().any(|part| is_in(&steps, part))) {
            let message = "this key sets execution or output of the run and has no effect on the motion";
            return Err(self.locate(path, message, None));
        }
        let found = self.number(path)?;
        if found.is_whole {
            let message = "this is a count; expected a continuous number";
            return Err(self.locate(path, message, None));
        }
        Ok(found)
    }

    /// Returns all numbers of the scenario on which the motion depends continuously, except those of unused materials and waveforms.
    #[must_use]
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut tree: Value = serde_json::from_str(&self.resolved()).unwrap_or_default();
        let mut named = HashSet::new();
        strings(&tree, &mut named);
        for list in LISTS {
            if let Some(entries) = tree.get_mut(list).and_then(Value::as_object_mut) {
                entries.retain(|name, _| named.contains(name));
            }
        }
        let mut paths = Vec::new();
        leaves(String::new(), &tree, &mut paths);
        paths
            .iter()
            .filter_map(|path| self.parameter(path).ok())
            .filter(|found| found.value.is_some())
            .collect()
    }

    /// Returns the periods or frequencies of all named waveforms.
    #[must_use]
    pub fn periods(&self) -> Vec<Parameter> {
        let tree = serde_json::to_value(&self.form).unwrap_or_default();
        let all = tree["waveforms"].as_object().into_iter().flatten();
        let periods = all.filter_map(|(name, form)| {
            let (kind, keys) = form.as_object()?.iter().next()?;
            let key = ["period", "frequency"].into_iter().find(|key| keys[key].is_number())?;
            let path = ["waveforms", name, kind, key].map(|key| Step::Key(key.to_owned()));
            self.number(&KeyPath(path.to_vec()).to_string()).ok()
        });
        periods.collect()
    }

    /// Returns the number at a key path of any section, integers included.
    ///
    /// # Errors
    /// No number at the path.
    pub fn number(&self, path: &str) -> Result<Parameter, ScenarioError> {
        let refused = |message: &str, help: Option<String>| Err(self.locate(path, message, help));
        let Some(steps) = KeyPath::parse(path).filter(|steps| !steps.0.is_empty()) else {
            let help = "such as contacts.ball.friction or loads[0].x".to_owned();
            return refused("expected a key path", Some(help));
        };
        let tree = serde_json::to_value(&self.form).unwrap_or_default();
        let schema = Guide::get().at(&steps);
        let found = match (look(&tree, &steps.0), schema) {
            (Err(help), _) => return refused("the scenario has no value at this path", help),
            (Ok(None), None) => {
                let keys = steps.0.split_last().map(|(_, parent)| keys(&tree, parent));
                let help = steps.0.last().zip(keys).and_then(|(last, keys)| slip(last, &keys));
                return refused("the scenario has no value at this path", help);
            }
            (Ok(found), _) => found,
        };
        let value = match found {
            None => schema.and_then(|schema| schema.get("default")).and_then(Value::as_f64),
            Some(Value::Number(number)) => number.as_f64(),
            Some(other) => {
                return refused(&format!("expected a number, got {}", kind_of(other)), None);
            }
        };
        let Some(schema) = schema else { return refused("the scenario has no value at this path", None) };
        let (kind, takes) = dimension(schema, DEEPEST);
        let kind = match takes {
            Takes::Nothing if !is_whole(schema) => return refused("expected the path of a number", None),
            // The value of a waveform has the dimension of the quantity that follows the waveform. A factor has no dimension.
            Takes::Values => kind.or_else(|| followed(&tree, &steps)),
            Takes::Numbers | Takes::Nothing => kind,
        };
        let unit = kind.map_or("", Kind::si);
        let guide = Guide::get();
        let range = [guide.bound(schema, &BELOW), guide.bound(schema, &ABOVE)];
        let range = [range[0].unwrap_or(f64::NEG_INFINITY), range[1].unwrap_or(f64::INFINITY)];
        let text = guide.description(schema).unwrap_or_default();
        Ok(Parameter { path: path.to_owned(), value, unit, is_whole: is_whole(schema), range, text })
    }
}

/// Collects all strings in the values of a JSON tree.
fn strings(here: &Value, found: &mut HashSet<String>) {
    match here {
        Value::Object(entries) => entries.values().for_each(|inner| strings(inner, found)),
        Value::Array(entries) => entries.iter().for_each(|inner| strings(inner, found)),
        Value::String(text) => found.extend([text.clone()]),
        _ => {}
    }
}

/// Collects the key paths of all numbers.
fn leaves(path: String, here: &Value, found: &mut Vec<String>) {
    match here {
        Value::Object(entries) => {
            for (key, inner) in entries.iter().filter(|(key, _)| !LENGTHS.contains(&key.as_str())) {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                leaves(path, inner, found);
            }
        }
        // Lists of objects contain parts of the scenario, such as loads.
        Value::Array(entries) if entries.len() <= LIST || entries.iter().all(Value::is_object) => {
            entries.iter().enumerate().for_each(|(i, inner)| leaves(format!("{path}[{i}]"), inner, found));
        }
        Value::Number(_) => found.push(path),
        _ => {}
    }
}

/// Returns the value at a path, or `None` if only the last key is missing. The error is a help text.
fn look<'a>(tree: &'a Value, path: &[Step]) -> Result<Option<&'a Value>, Option<String>> {
    let mut here = tree;
    for (depth, step) in path.iter().enumerate() {
        let next = match step {
            Step::Key(key) => here.get(key),
            Step::Index(index) => here.get(index),
        };
        here = match next {
            Some(next) => next,
            None if depth + 1 == path.len() && here.is_object() && matches!(step, Step::Key(_)) => {
                return Ok(None);
            }
            None if here.is_array() && matches!(step, Step::Key(_)) => {
                let list = KeyPath(path[..depth].to_vec());
                return Err(Some(format!("entries of a list have an index: {list}[0] is the first")));
            }
            None => return Err(slip(step, &keys(tree, &path[..depth]))),
        };
    }
    Ok(Some(here))
}

/// Returns the keys of the object at a path.
fn keys(tree: &Value, path: &[Step]) -> Vec<String> {
    let here = look(tree, path).ok().flatten().and_then(Value::as_object);
    here.into_iter().flat_map(|entries| entries.keys().cloned()).collect()
}

fn slip(step: &Step, keys: &[String]) -> Option<String> {
    match step {
        Step::Key(key) => suggest::help(key, keys.iter().map(String::as_str)),
        Step::Index(_) => None,
    }
}

fn kind_of(value: &Value) -> &'static str {
    match value {
        Value::Object(_) => "an object",
        Value::Array(_) => "a list",
        Value::String(_) => "a text",
        Value::Bool(_) => "true or false",
        Value::Null | Value::Number(_) => "nothing",
    }
}

/// Returns whether a schema requires an integer.
fn is_whole(schema: &Value) -> bool {
    let is_integer = |kind: &Value| kind.as_str() == Some("integer");
    schema.get("type").is_some_and(|kind| {
        is_integer(kind) || kind.as_array().is_some_and(|kinds| kinds.iter().any(is_integer))
    })
}

/// Kind of number that a schema accepts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Takes {
    /// No number.
    Nothing,
    /// Plain numbers, or quantities of a given dimension.
    Numbers,
    /// Quantities whose dimension depends on other keys.
    Values,
}

/// Returns the dimension in a schema and the kind of number that it accepts. `deepest` limits the recursion.
fn dimension(schema: &Value, deepest: usize) -> (Option<Kind>, Takes) {
    let named = schema.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix("#/$defs/"));
    if let Some(name) = named {
        let kind = Kind::named(name.strip_prefix("Moving").unwrap_or(name));
        if kind.is_some() {
            return (kind, Takes::Numbers);
        }
        if name == "Quantity" {
            return (None, Takes::Values);
        }
    }
    let kind = schema.get("type");
    let is_number = kind.is_some_and(|kind| {
        let is = |kind: &Value| kind.as_str() == Some("number");
        is(kind) || kind.as_array().is_some_and(|kinds| kinds.iter().any(is))
    });
    if is_number || deepest == 0 {
        return (None, if is_number { Takes::Numbers } else { Takes::Nothing });
    }
    let parts = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array()).flatten();
    let parts = parts.map(|part| dimension(part, deepest - 1));
    parts.fold((None, Takes::Nothing), |(kind, takes), (other, also)| (kind.or(other), takes.max(also)))
}

/// Returns the dimension of a waveform's values: the dimension of the first quantity that follows the waveform, by name or inline.
fn followed(tree: &Value, path: &KeyPath) -> Option<Kind> {
    let follows = Step::Key("follows".to_owned());
    if let Some(depth) = path.0.iter().position(|step| *step == follows) {
        return place(&path.0[..depth]);
    }
    match path.0.as_slice() {
        [Step::Key(part), Step::Key(name), ..] if part == "waveforms" => {
            let mut places = Vec::new();
            following(tree, name, &mut Vec::new(), &mut places);
            places.iter().find_map(|found| place(found))
        }
        _ => None,
    }
}

/// Returns the dimension of a quantity that may follow a waveform.
fn place(path: &[Step]) -> Option<Kind> {
    match path {
        [Step::Key(part), _, Step::Key(axis)] if part == "bodies" => {
            Some(if axis == "pitch" { Kind::Angle } else { Kind::Length })
        }
        path => dimension(Guide::get().at(&KeyPath(path.to_vec()))?, DEEPEST).0,
    }
}

/// Collects the paths of all quantities that follow the waveform of this name.
fn following(here: &Value, name: &str, path: &mut Vec<Step>, places: &mut Vec<Vec<Step>>) {
    match here {
        Value::Object(entries) => {
            if entries.get("follows").and_then(Value::as_str) == Some(name) {
                places.push(path.clone());
            }
            for (key, inner) in entries {
                path.push(Step::Key(key.clone()));
                following(inner, name, path, places);
                path.pop();
            }
        }
        Value::Array(entries) => {
            for (index, inner) in entries.iter().enumerate() {
                path.push(Step::Index(index));
                following(inner, name, path, places);
                path.pop();
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUICKSTART: &str = include_str!("../../../scenarios/quickstart.json");
    const STAGE: &str = include_str!("../../../docs/piezo/stage.json");

    fn found(text: &str, path: &str) -> Result<(Option<f64>, &'static str), String> {
        let scenario = Scenario::from_str(text, "drive.json", "").unwrap();
        let parameter = scenario.parameter(path).map_err(|error| error.to_string())?;
        Ok((parameter.value, parameter.unit))
    }

    #[test]
    fn numbers_are_found_with_their_units() {
        let quickstart = |path: &str| found(QUICKSTART, path);
        assert_eq!(quickstart("contacts.ball.friction"), Ok((Some(0.2), "")));
        assert_eq!(quickstart("contacts.ball.normal.force"), Ok((Some(0.3), "N")));
        assert_eq!(quickstart("loads[0].x"), Ok((Some(-0.02), "N")));
        assert_eq!(quickstart("bodies.slider.mass"), Ok((Some(0.01), "kg")));
        assert_eq!(quickstart("materials.ruby.youngs_modulus"), Ok((Some(4e11), "Pa")));
        assert_eq!(quickstart("waveforms.drive.sawtooth.stroke"), Ok((Some(2e-7), "m")));
        assert_eq!(quickstart("waveforms.drive.sawtooth.period"), Ok((Some(1e-2), "s")));
        // The key is allowed, but not given.
        assert_eq!(quickstart("waveforms.drive.sawtooth.frequency"), Ok((None, "Hz")));
        assert_eq!(quickstart("contacts.ball.damping"), Ok((None, "s")));
        assert_eq!(found(STAGE, "waveforms.drive.sawtooth.stroke"), Ok((Some(120.0), "V")));
        assert_eq!(found(STAGE, "actuators.stack.driver.current"), Ok((Some(2.0), "A")));
    }

    #[test]
    fn what_is_no_number_that_can_change_is_refused_with_its_place() {
        let refused = |path: &str| found(QUICKSTART, path).unwrap_err();
        assert!(refused("contacts.bal.friction").contains("did you mean \"ball\"?"));
        assert!(refused("contacts.ball.fricton").contains("did you mean \"friction\"?"));
        assert!(refused("waveforms.drive.sine.amplitude").contains("the scenario has no value at this path"));
        assert!(refused("contacts.ball").contains("expected a number, got an object"));
        assert!(refused("contacts.ball.materials[0]").contains("got a text"));
        assert!(refused("contacts.ball.count").contains("this is a count"));
        assert!(refused("run.duration").contains("has no effect on the motion"));
        assert!(refused("run.stepper.event.tolerance").contains("has no effect on the motion"));
        assert!(refused("loads[7].x").contains("the scenario has no value at this path"));
        for path in ["", ".", "a..b", "[0]"] {
            assert!(refused(path).contains("expected a key path"), "{path}");
        }
    }
}
