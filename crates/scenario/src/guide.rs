//! Help texts from the descriptions and examples of the schema, for messages without a more specific help.

use crate::path::{KeyPath, Step};
use crate::schema;
use serde_json::Value;
use std::cmp::Reverse;
use std::collections::HashSet;
use std::fmt::Write;
use std::sync::OnceLock;

/// Help of an error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Help {
    None,
    /// Text given with the error.
    Said(String),
    /// Description of the value, from the schema.
    Meaning,
    /// Example of the value, from the schema.
    Shape,
    /// Example and description of a missing key, from the schema.
    Missing(String),
}

impl Help {
    /// Returns the help text for the value at a path.
    pub(crate) fn about(self, path: &KeyPath, guide: &Guide) -> Option<String> {
        let mut path = path.clone();
        match self {
            Self::None => None,
            Self::Said(text) => Some(text),
            Self::Meaning => {
                // The description of a list says more than that of its entries.
                while path.0.pop_if(|last| matches!(last, Step::Index(_))).is_some() {}
                guide.description(guide.at(&path)?)
            }
            Self::Shape => Some(format!("such as {}", line(guide.example(guide.at(&path)?)?))),
            Self::Missing(key) => {
                let schema = guide.enter(guide.at(&path)?, &Step::Key(key.clone()))?;
                let (example, description) = (guide.example(schema)?, guide.description(schema)?);
                Some(format!("add \"{key}\": {} ({description})", line(example)))
            }
        }
    }
}

/// Schema for look-ups by key path.
#[derive(Debug, PartialEq)]
pub(crate) struct Guide {
    root: Value,
}

impl Guide {
    /// Returns the schema of scenario files, generated at the first call.
    pub(crate) fn get() -> &'static Self {
        static GUIDE: OnceLock<Guide> = OnceLock::new();
        GUIDE.get_or_init(|| Self { root: schema::tree() })
    }

    /// Returns the schema of study files.
    pub(crate) fn of_studies() -> &'static Self {
        static GUIDE: OnceLock<Guide> = OnceLock::new();
        GUIDE.get_or_init(|| Self { root: schema::study_tree() })
    }

    /// Returns the schema of the value at a path.
    pub(crate) fn at(&self, path: &KeyPath) -> Option<&Value> {
        path.0.iter().try_fold(&self.root, |schema, step| self.enter(schema, step))
    }

    /// Returns the schema one step deeper, in the first variant that has this key or index.
    pub(crate) fn enter<'a>(&'a self, schema: &'a Value, step: &Step) -> Option<&'a Value> {
        let inner = match step {
            Step::Key(key) => schema.get("properties").and_then(|keys| keys.get(key)),
            Step::Index(index) => schema.get("prefixItems").and_then(|items| items.get(index)),
        };
        let other = match step {
            Step::Key(_) => schema.get("additionalProperties"),
            Step::Index(_) => schema.get("items"),
        };
        if let Some(found) = inner.or(other).filter(|found| found.is_object()) {
            return Some(found);
        }
        self.parts(schema).find_map(|part| self.enter(part, step))
    }

    /// Returns the schemas that apply to the same value: the referenced type, and the variants.
    fn parts<'a>(&'a self, schema: &'a Value) -> impl Iterator<Item = &'a Value> {
        let name = schema.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix("#/$defs/"));
        let named = name.and_then(|name| self.root.get("$defs")?.get(name));
        let kinds = ["oneOf", "anyOf"].into_iter().filter_map(|key| schema.get(key)?.as_array()).flatten();
        named.into_iter().chain(kinds)
    }

    /// Returns the number under one of the keys, also from the referenced type or the first variant that has one.
    pub(crate) fn bound(&self, schema: &Value, keys: &[&str]) -> Option<f64> {
        let own = keys.iter().find_map(|key| schema.get(key)?.as_f64());
        own.or_else(|| self.parts(schema).find_map(|part| self.bound(part, keys)))
    }

    /// Returns the first sentence of the description, in lower case for use inside a sentence.
    pub(crate) fn description(&self, schema: &Value) -> Option<String> {
        let text = match schema.get("description") {
            Some(text) => text.as_str()?,
            None => return self.parts(schema).next().and_then(|part| self.description(part)),
        };
        let sentence = text.split(". ").next()?;
        let text = sentence.strip_suffix('.').unwrap_or(sentence).replace('`', "\"");
        let mut chars = text.chars();
        let first = chars.next()?;
        let word = text.split(' ').next()?;
        // Names of people and abbreviations keep their capitals.
        if word.ends_with("'s") || (word.len() > 1 && word.chars().all(char::is_uppercase)) {
            return Some(text);
        }
        Some(first.to_lowercase().chain(chars).collect())
    }

    /// Returns an example of a value of this schema.
    pub(crate) fn example<'a>(&'a self, schema: &'a Value) -> Option<&'a Value> {
        let own = schema.get("examples").and_then(|examples| examples.get(0));
        own.or_else(|| self.parts(schema).find_map(|part| self.example(part)))
    }

    /// Returns an example of the variant with this name.
    pub(crate) fn example_of(&self, path: &KeyPath, kind: &str) -> Option<String> {
        let schema = self.enter(self.at(path)?, &Step::Key(kind.to_owned()))?;
        Some(format!("{{\"{kind}\": {}}}", line(self.example(schema)?)))
    }

    /// Returns the words and keys that select the variant of the value at a path.
    pub(crate) fn kinds(&self, path: &KeyPath) -> Vec<String> {
        let mut kinds = Vec::new();
        if let Some(schema) = self.at(path) {
            self.add_kinds(schema, &mut kinds);
        }
        kinds
    }

    /// Returns the keys that select the variant of the value at a path, or none if there is no such choice.
    pub(crate) fn choices(&self, path: &KeyPath) -> Vec<String> {
        let chooses = self.at(path).is_some_and(|schema| self.is_choice(schema));
        if chooses { self.kinds(path) } else { Vec::new() }
    }

    /// Returns whether a schema is a choice between variants, each a plain value or an object with one required key. Objects whose keys
    /// may occur together and rules about keys are not a choice.
    fn is_choice(&self, schema: &Value) -> bool {
        let name = schema.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix("#/$defs/"));
        if let Some(named) = name.and_then(|name| self.root.get("$defs")?.get(name)) {
            return self.is_choice(named);
        }
        let kinds = ["oneOf", "anyOf"].iter().find_map(|key| schema.get(key)?.as_array());
        kinds.is_some_and(|kinds| kinds.iter().all(|kind| self.is_kind(kind)))
    }

    fn is_kind(&self, schema: &Value) -> bool {
        let plain = |kind: &Value| {
            let is_object = kind.get("type").and_then(Value::as_str) == Some("object");
            !is_object && ["required", "$ref", "oneOf", "anyOf"].iter().all(|key| kind.get(key).is_none())
        };
        let one_key = |kind: &Value| {
            let required = kind.get("required").and_then(Value::as_array);
            kind.get("properties").is_some() && required.is_some_and(|required| required.len() == 1)
        };
        let name = schema.get("$ref").and_then(Value::as_str).and_then(|name| name.strip_prefix("#/$defs/"));
        match name.and_then(|name| self.root.get("$defs")?.get(name)) {
            Some(named) => self.is_kind(named),
            None => plain(schema) || one_key(schema) || self.is_choice(schema),
        }
    }

    fn add_kinds(&self, schema: &Value, kinds: &mut Vec<String>) {
        let words = schema.get("enum").and_then(Value::as_array).into_iter().flatten();
        kinds.extend(words.filter_map(Value::as_str).map(str::to_owned));
        // If several keys are required, none of them selects the variant.
        let has_several = schema.get("required").and_then(Value::as_array).is_some_and(|keys| keys.len() > 1);
        if schema.get("oneOf").is_none() && !has_several {
            kinds.extend(self.keys_of(schema));
        }
        for part in self.parts(schema) {
            self.add_kinds(part, kinds);
        }
    }

    /// Returns whether a key is allowed in the value at a path.
    pub(crate) fn knows(&self, path: &KeyPath, key: &str) -> bool {
        let schema = self.at(path).and_then(|schema| self.enter(schema, &Step::Key(key.to_owned())));
        schema.is_some()
    }

    fn keys_of<'a>(&self, schema: &'a Value) -> impl Iterator<Item = String> + use<'a> {
        let keys = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
        keys.filter(|(_, inner)| inner.is_object()).map(|(key, _)| key.clone())
    }

    /// Returns the paths of the objects that may contain a key. Of all such objects, those with the longest common path with `sought` are
    /// returned, and of these the objects closest to the root. Names of parts that are not in common are written as NAME.
    pub(crate) fn homes(&self, sought: &KeyPath, key: &str) -> Vec<String> {
        let mut homes = self.places(sought, key);
        // Keys of plots are no help for a coordinate.
        let pictures = Step::Key("plots".to_owned());
        homes.retain(|home| home.0.first() != Some(&pictures) || sought.0.first() == Some(&pictures));
        let shared = |home: &KeyPath| home.0.iter().zip(&sought.0).take_while(|(a, b)| a == b).count();
        let rank = |home: &KeyPath| (shared(home), Reverse(home.0.len()));
        let best = homes.iter().map(rank).max();
        homes.retain(|home| Some(rank(home)) == best && !home.0.is_empty());
        homes.iter().map(KeyPath::to_string).collect()
    }

    /// Returns the paths of all objects that may contain a key.
    fn places(&self, sought: &KeyPath, key: &str) -> Vec<KeyPath> {
        let mut places: Vec<KeyPath> = Vec::new();
        let mut level = vec![(KeyPath::default(), &self.root)];
        while !level.is_empty() {
            let here = level.iter().filter(|(_, schema)| self.keys_of(schema).any(|known| known == key));
            places.extend(here.map(|(path, _)| path.clone()));
            level = level.iter().flat_map(|(path, schema)| self.next_level(sought, path, schema)).collect();
        }
        places
    }

    /// Returns the paths of objects that contain a key and end with some steps; only those closest to the root.
    fn places_ending(&self, steps: &[Step], key: &str) -> Vec<KeyPath> {
        let mut places = self.places(&KeyPath::default(), key);
        places.retain(|place| place.0.ends_with(steps));
        let least = places.iter().map(|place| place.0.len()).min();
        places.retain(|place| Some(place.0.len()) == least);
        places
    }

    fn next_level<'a>(
        &'a self,
        sought: &KeyPath,
        path: &KeyPath,
        schema: &'a Value,
    ) -> Vec<(KeyPath, &'a Value)> {
        let deeper = |step: Step| KeyPath(path.0.iter().cloned().chain([step]).collect());
        let mut level: Vec<_> = self.parts(schema).map(|part| (path.clone(), part)).collect();
        if let Some(keys) = schema.get("properties").and_then(Value::as_object) {
            level.extend(keys.iter().map(|(key, inner)| (deeper(Step::Key(key.clone())), inner)));
        }
        let on_the_way = sought.0.starts_with(&path.0);
        let name = sought.0.get(path.0.len()).filter(|_| on_the_way);
        let any = [("additionalProperties", Step::Key("NAME".to_owned())), ("items", Step::Index(0))];
        for (keyword, step) in any {
            let inner = schema.get(keyword).filter(|inner| inner.is_object());
            level.extend(inner.map(|inner| (deeper(name.cloned().unwrap_or(step)), inner)));
        }
        // A constant has no keys.
        level.retain(|(_, inner)| inner.get("const").is_none());
        level
    }
}

/// Returns the schema's description of a scenario key, given by its path, such as `contacts.ball.friction`, or by the end of the path.
/// Each entry is a path and its description. Equal descriptions are returned once; an unknown key gives an empty list.
pub fn explained(key: &str) -> Vec<(String, String)> {
    let guide = Guide::get();
    let Some(path) = KeyPath::parse(key).filter(|path| !path.0.is_empty()) else { return Vec::new() };
    let told = |path: &KeyPath| {
        let schema = guide.at(path)?;
        let own = schema
            .get("description")
            .or_else(|| guide.parts(schema).find_map(|part| part.get("description")));
        Some((path.to_string(), own?.as_str()?.to_owned()))
    };
    if let Some(found) = told(&path) {
        return vec![found];
    }
    let Some((Step::Key(name), before)) = path.0.split_last() else { return Vec::new() };
    if !before.is_empty() {
        // End of a path, such as `sawtooth.flyback`.
        let whole = guide.places_ending(before, name).into_iter().map(|mut place| {
            place.0.push(Step::Key(name.clone()));
            place
        });
        return whole.filter_map(|path| told(&path)).collect();
    }
    let mut seen = HashSet::new();
    let places = guide.places(&KeyPath::default(), name).into_iter().filter_map(|mut place| {
        place.0.push(Step::Key(name.clone()));
        told(&place)
    });
    places.filter(|(_, text)| seen.insert(text.clone())).collect()
}

/// Returns a value as JSON on one line, with blanks.
fn line(value: &Value) -> String {
    let mut text = String::new();
    match value {
        Value::Object(entries) => {
            let entries = entries.iter().map(|(key, value)| format!("\"{key}\": {}", line(value)));
            let _ = write!(text, "{{{}}}", entries.collect::<Vec<_>>().join(", "));
        }
        Value::Array(entries) => {
            let entries: Vec<_> = entries.iter().map(line).collect();
            let _ = write!(text, "[{}]", entries.join(", "));
        }
        plain => {
            // Writing to a string cannot fail.
            let _ = write!(text, "{plain}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str) -> KeyPath {
        KeyPath::parse(text).unwrap()
    }

    #[test]
    fn the_schema_answers() {
        let guide = Guide::get();
        let friction = "the Coulomb coefficient of the pair, 0 to 1000; typical 0.05 to 0.6";
        assert_eq!(Help::Meaning.about(&path("contacts.a b.friction"), guide).unwrap(), friction);
        assert_eq!(
            Help::Missing("friction".to_owned()).about(&path("contacts.ball"), guide).unwrap(),
            format!("add \"friction\": 0.2 ({friction})")
        );
        let modulus = Help::Meaning.about(&path("materials.x.youngs_modulus"), guide).unwrap();
        assert!(modulus.starts_with("Young's modulus E, Pa"));
        let radius = Help::Meaning.about(&path("contacts.c.profile.sphere.radius"), guide).unwrap();
        assert!(radius.ends_with("typical 0.1 mm to 50 mm"));
        assert_eq!(
            Help::Shape.about(&path("gravity"), guide).unwrap(),
            "such as {\"acceleration\": \"9.81 m/s²\", \"incline\": \"90 deg\"}"
        );
        let inline = Help::Meaning.about(&path("loads[3].x.follows.sine.delay"), guide).unwrap();
        assert!(inline.starts_with("delay, s, at least 0"));
        let points = Help::Meaning.about(&path("waveforms.w.table.points[2][0]"), guide).unwrap();
        assert!(points.starts_with("pairs of time and value"));
        assert_eq!(Help::Meaning.about(&path("nowhere.to.go"), guide), None);
    }

    #[test]
    fn kinds_and_homes_of_keys_are_known() {
        let guide = Guide::get();
        assert_eq!(guide.kinds(&path("bodies.a.x")), ["fixed", "free", "balanced", "follows"]);
        assert_eq!(guide.kinds(&path("contacts.a.normal")), ["coupled", "force", "indentation", "radius"]);
        assert_eq!(guide.kinds(&path("run.stepper")), ["event", "verlet", "rk4", "frames", "dopri5"]);
        assert_eq!(guide.kinds(&path("contacts.a.engine")), ["curve", "springs"]);
        assert_eq!(guide.kinds(&path("springs.a.direction")), ["x", "z"]);
        assert!(guide.kinds(&path("waveforms.a")).contains(&"chirp".to_owned()));
        let homes = |sought: &str, key: &str| guide.homes(&path(sought), key);
        assert_eq!(homes("materials.ruby", "friction"), ["contacts.NAME"]);
        assert_eq!(homes("contacts.ball", "mass"), ["bodies.NAME", "actuators.NAME"]);
        assert_eq!(homes("run", "on"), ["loads[0]", "stops.NAME"]);
        assert_eq!(homes("waveforms.saw", "order"), ["waveforms.saw.harmonics.terms[0]"]);
        assert_eq!(homes("bodies.foot", "follows"), ["bodies.foot.x", "bodies.foot.z", "bodies.foot.pitch"]);
        let profiles = ["cone", "truncated_cone"].map(|kind| format!("contacts.ball.profile.{kind}"));
        assert_eq!(homes("contacts.ball.profile.sphere", "slope"), profiles);
        assert_eq!(homes("run", "no_such_key"), [""; 0]);
        assert!(guide.knows(&path("bodies.a"), "mass") && guide.knows(&path("actuators.a"), "voltage"));
    }
}
