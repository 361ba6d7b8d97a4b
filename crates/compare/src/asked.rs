//! Which events and rows a scenario asks for, told so that two ways to say the same are the same.

use serde_json::{Value, json};
use std::path::Path;
use stickslip_run::files::SCENARIO;
use stickslip_run::guard;
use stickslip_scenario::Scenario;

/// All of a run.
const EVERYWHERE: [f64; 2] = [0.0, f64::INFINITY];

/// Which events and rows are written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asked {
    /// Kinds and contacts of events, and whether there are any. How many are written before they are thinned does not matter:
    /// until then all are there.
    events: Value,
    /// From when until when, s.
    window: [f64; 2],
    /// Interval of the rows, s; none where that is not known.
    every: Option<Value>,
}

impl Asked {
    /// What the scenario beside results asks for. An excerpt has none; it is of a run that leaves nothing out.
    pub(super) fn of(folder: &Path) -> Self {
        let path = folder.join(SCENARIO);
        match Scenario::load(&path) {
            Ok(scenario) => Self::by(&scenario),
            Err(_) => Self::unread(&guard::json(&path).unwrap_or_default()),
        }
    }

    fn by(scenario: &Scenario) -> Self {
        let written = &scenario.written;
        let sorted = |mut words: Vec<String>| {
            words.sort_unstable();
            words
        };
        let kinds = written.events.kinds.as_ref();
        let kinds = kinds.map(|kinds| sorted(kinds.iter().map(|kind| (*kind).to_owned()).collect()));
        let name = |c: &usize| scenario.scene.contacts.get(*c).map(|contact| contact.name.clone());
        let contacts = written.events.contacts.as_ref();
        let contacts = contacts.map(|contacts| sorted(contacts.iter().filter_map(name).collect()));
        Self {
            events: json!([kinds, contacts, written.events.most == 0]),
            window: written.window,
            every: Some(json!(scenario.plan.every)),
        }
    }

    /// One that another program wrote and this one does not read.
    fn unread(scenario: &Value) -> Self {
        let of = |key: &str| scenario.pointer(&format!("/output/{key}")).cloned();
        let said = ["events", "window", "last"].map(of);
        let events = if said.iter().all(Option::is_none) { json!([null, null, false]) } else { json!(said) };
        Self { events, window: EVERYWHERE, every: None }
    }

    /// The times in which both write the same kinds of events, s; none where there are none. Where the windows differ, an event
    /// within `tolerance` of their edges may be in one of them only.
    pub(super) fn common(&self, other: &Self, tolerance: f64) -> Option<[f64; 2]> {
        let ([a_from, a_to], [b_from, b_to]) = (self.window, other.window);
        let from = if a_from == b_from { a_from } else { a_from.max(b_from) + tolerance };
        let to = if a_to == b_to { a_to } else { a_to.min(b_to) - tolerance };
        (self.events == other.events && from <= to).then_some([from, to])
    }

    /// Whether both write events in the same window.
    pub(super) fn has_same_window(&self, other: &Self) -> bool {
        self.window == other.window
    }

    /// Whether both write rows at the same moments, as far as they say.
    pub(super) fn has_same_rows(&self, other: &Self) -> bool {
        let has_same_interval = match (&self.every, &other.every) {
            (Some(a), Some(b)) => a == b,
            _ => true,
        };
        has_same_interval && self.window == other.window
    }
}
