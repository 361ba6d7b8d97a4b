//! Settings of a scenario that select the written events and rows. Equivalent settings compare equal.

use serde_json::{Value, json};
use std::path::Path;
use stickslip_run::files::SCENARIO;
use stickslip_run::guard;
use stickslip_scenario::Scenario;

/// Time window of a whole run, s.
const EVERYWHERE: [f64; 2] = [0.0, f64::INFINITY];

/// Settings of a scenario that determine which events and rows are written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asked {
    /// Kinds and contacts of the written events, and whether events are written at all. The maximum number of events is not included,
    /// because all events before the first omitted one are compared.
    events: Value,
    /// Time window of the rows and events, s.
    window: [f64; 2],
    /// Time interval of the rows, s. `None` if it is unknown.
    every: Option<Value>,
}

impl Asked {
    /// Reads the settings from the scenario in a results folder.
    ///
    /// A missing scenario counts as a scenario that writes all events.
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

    /// Returns the settings of a scenario file that this program version cannot read.
    fn unread(scenario: &Value) -> Self {
        let of = |key: &str| scenario.pointer(&format!("/output/{key}")).cloned();
        let said = ["events", "window", "last"].map(of);
        let events = if said.iter().all(Option::is_none) { json!([null, null, false]) } else { json!(said) };
        Self { events, window: EVERYWHERE, every: None }
    }

    /// Returns the time window in which both runs write the same kinds of events, s, or `None` without a common window.
    ///
    /// If the windows differ, the result is narrowed by `tolerance`, because an event near an edge may be within one window only.
    pub(super) fn common(&self, other: &Self, tolerance: f64) -> Option<[f64; 2]> {
        let ([a_from, a_to], [b_from, b_to]) = (self.window, other.window);
        let from = if a_from == b_from { a_from } else { a_from.max(b_from) + tolerance };
        let to = if a_to == b_to { a_to } else { a_to.min(b_to) - tolerance };
        (self.events == other.events && from <= to).then_some([from, to])
    }

    /// Returns whether both runs have the same time window.
    pub(super) fn has_same_window(&self, other: &Self) -> bool {
        self.window == other.window
    }

    /// Returns whether both runs write rows at the same times, as far as the settings are known.
    pub(super) fn has_same_rows(&self, other: &Self) -> bool {
        let has_same_interval = match (&self.every, &other.every) {
            (Some(a), Some(b)) => a == b,
            _ => true,
        };
        has_same_interval && self.window == other.window
    }
}
