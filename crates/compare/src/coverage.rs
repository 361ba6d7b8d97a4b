//! How much of two runs was there, and compared.

use super::channels::CommonRows;
use super::results::Results;
use serde::Serialize;
use serde_json::Value;
use stickslip_run::Real;

/// What of A was compared, as shares of 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Coverage {
    /// From the first common row to the last, of the time that A reached.
    pub time: Real,
    /// Rows of A that B has, of those that A has.
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

/// Runs that are not there as a whole.
pub(super) fn extents(a: &Results, b: &Results) -> Vec<String> {
    let mut notes = Vec::new();
    for (name, results) in [("A", a), ("B", b)] {
        if results.is_excerpt() {
            let counted = results.summary.pointer("/counts/rows").and_then(Value::as_u64).unwrap_or(0);
            notes.push(format!("{name}: an excerpt, {} of {counted} rows", results.trace.rows()));
        }
        if !results.absent.is_empty() {
            notes.push(format!("{name}: not there, and not compared: {}", results.absent.join(", ")));
        }
        if results.is_cut() {
            notes
                .push(format!("{name}: the tables end at t = {:?} s: no more could be written", results.end));
        }
    }
    let Some([from, to]) = a.asked.common(&b.asked, 0.0) else {
        notes.push("events: A and B write others, as output.events, window and last of their scenarios say; not compared".to_owned());
        return notes;
    };
    if !a.asked.has_same_window(&b.asked) {
        let to = to.min(a.end).min(b.end);
        notes.push(format!("events: compared from t = {from:?} s to {to:?} s, where both windows are"));
    }
    if a.events_until.min(b.events_until).is_finite() {
        let until = a.events_until.min(b.events_until);
        notes.push(format!("events: compared until t = {until:?} s, from where on they are thinned"));
    }
    notes
}
