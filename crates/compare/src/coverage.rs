//! Completeness of two runs and of their comparison.

use super::channels::CommonRows;
use super::results::Results;
use serde::Serialize;
use serde_json::Value;
use stickslip_run::Real;

/// Compared fraction of run A, from 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Coverage {
    /// Time from the first to the last common row, divided by the simulated time of run A.
    pub time: Real,
    /// Number of rows of run A that run B has, divided by the number of all rows of run A.
    pub rows: Real,
}

impl Coverage {
    pub(super) fn new(a: &Results, rows: &CommonRows) -> Self {
        let time = |(i, _): &(usize, usize)| a.time().get(*i).copied();
        let ends = rows.pairs.first().and_then(time).zip(rows.pairs.last().and_then(time));
        let share = |part: f64, whole: f64| if whole > 0.0 { Real(part / whole) } else { Real(1.0) };
        Self {
            time: share(ends.map_or(0.0, |(first, last)| last - first), a.end),
            rows: share((rows.pairs.len() + rows.at_events) as f64, a.time().len() as f64),
        }
    }
}

/// Returns notes on runs or tables that are incomplete.
pub(super) fn extents(a: &Results, b: &Results) -> Vec<String> {
    let mut notes = Vec::new();
    for (name, results) in [("A", a), ("B", b)] {
        if results.is_excerpt() {
            let counted = results.summary.pointer("/counts/rows").and_then(Value::as_u64).unwrap_or(0);
            notes.push(format!("{name}: an excerpt with {} of {counted} rows", results.trace.rows()));
        }
        if !results.absent.is_empty() {
            notes.push(format!("{name}: missing, not compared: {}", results.absent.join(", ")));
        }
        if results.is_cut() {
            notes.push(format!(
                "{name}: the tables end at t = {:?} s, because the rest could not be written",
                results.end
            ));
        }
    }
    let Some([from, to]) = a.asked.common(&b.asked, 0.0) else {
        notes.push("events: not compared, because output.events, output.window or output.last of the scenarios differ".to_owned());
        return notes;
    };
    if !a.asked.has_same_window(&b.asked) {
        let to = to.min(a.end).min(b.end);
        notes.push(format!("events: compared from t = {from:?} s to {to:?} s, which both windows contain"));
    }
    if a.events_until.min(b.events_until).is_finite() {
        let until = a.events_until.min(b.events_until);
        notes.push(format!("events: compared until t = {until:?} s; later events are thinned"));
    }
    notes
}
