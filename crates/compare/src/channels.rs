//! Comparison of the channels of two traces at their common times.

use super::allowance::Allowance;
use super::results::Results;
use serde::Serialize;
use std::collections::HashSet;
use stickslip_quantity::names::unit;
use stickslip_run::Real;
use stickslip_run::frame::{Column, Values, Words};

/// Relative difference below which two times are equal. Rounding makes k·10 µs and 2k·5 µs differ.
const SAME_TIME: f64 = 4.0 * f64::EPSILON;

/// Rows of two traces at their common times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CommonRows {
    /// Pairs of row indices: first in run A, then in run B.
    pub pairs: Vec<(usize, usize)>,
    /// Rows of run A that coincide with an event. One run may have the state before the event, and the other run the state after it.
    pub on_events: HashSet<usize>,
    /// Number of rows omitted because they coincide with an event.
    pub at_events: usize,
}

/// Difference of one channel between two runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChannelDifference {
    /// Name of the channel.
    pub name: String,
    /// SI unit; empty if the channel has no unit.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    /// Largest difference, in the unit of the channel. `None` for words, which are equal or different.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst: Option<Real>,
    /// Time of the largest difference, or of the first different word, s. `None` if there is no difference.
    #[serde(rename = "at_s", skip_serializing_if = "Option::is_none")]
    pub at: Option<Real>,
    /// Largest allowed difference, in the unit of the channel. `None` for words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<Real>,
    /// First time at which the difference exceeds the allowed difference, s.
    #[serde(rename = "first_s", skip_serializing_if = "Option::is_none")]
    pub first: Option<Real>,
    /// Number of rows with a difference above the allowed difference.
    pub rows: usize,
}

impl CommonRows {
    /// Pairs the rows of two traces with equal times up to the time `end`, s.
    pub fn new(a: &[f64], b: &[f64], end: f64) -> Self {
        let (mut i, mut j) = (0, 0);
        let mut pairs = Vec::new();
        while let (Some(&s), Some(&t)) = (a.get(i), b.get(j)) {
            if (s - t).abs() <= SAME_TIME * s.abs() {
                if s <= end * (1.0 + SAME_TIME) {
                    pairs.push((i, j));
                }
                (i, j) = (i + 1, j + 1);
            } else if s < t {
                i += 1;
            } else {
                j += 1;
            }
        }
        Self { pairs, ..Self::default() }
    }

    /// Removes the pairs of rows within `tolerance` (s) of an event, because the two runs may show the states before and after the event.
    ///
    /// `a` and `b` are the row times of the traces, and `events` are the times of all events. Pairs of rows for which `is_sure` returns
    /// true are kept.
    pub fn told_from_events(
        mut self,
        (a, b): (&[f64], &[f64]),
        mut events: Vec<f64>,
        tolerance: f64,
        is_sure: impl Fn(f64, f64) -> bool,
    ) -> Self {
        events.sort_unstable_by(f64::total_cmp);
        let is_clear = |t: f64| {
            let tolerance = tolerance.max(SAME_TIME * t.abs());
            let next = events.partition_point(|event| *event < t - tolerance);
            events.get(next).is_none_or(|event| *event > t + tolerance)
        };
        let before = self.pairs.len();
        self.pairs.retain(|&(i, j)| is_sure(a[i], b[j]) || is_clear(a[i]));
        self.at_events = before - self.pairs.len();
        self.on_events = self.pairs.iter().map(|(i, _)| *i).filter(|&i| !is_clear(a[i])).collect();
        self
    }

    /// Returns the number of rows of run A up to the time `end`, s, that run B lacks. `a` are the row times of run A.
    pub(super) fn lone(&self, a: &[f64], end: f64) -> usize {
        let until = a.partition_point(|t| *t <= end * (1.0 + SAME_TIME));
        until.saturating_sub(self.pairs.len() + self.at_events)
    }
}

impl ChannelDifference {
    /// Returns whether no row differs by more than the allowed difference.
    pub fn is_same(&self) -> bool {
        self.rows == 0
    }

    /// Returns the largest difference divided by the allowed difference.
    pub fn excess(&self) -> f64 {
        let (Some(worst), Some(allowed)) = (self.worst, self.allowed) else { return 0.0 };
        if worst.0 == 0.0 { 0.0 } else { worst.0 / allowed.0 }
    }
}

/// Compares all channels that both traces have, except the time.
pub(super) fn compare(
    a: &Results,
    b: &Results,
    rows: &CommonRows,
    allowance: &Allowance,
) -> Vec<ChannelDifference> {
    let wanted = |column: &&Column| column.name != "time_s" && !allowance.ignores(&column.name);
    let compare = |column: &Column| match &column.values {
        Values::Numbers(first) => {
            let second = b.trace.numbers(&column.name)?;
            Some(numbers(&column.name, a.time(), (first, second), rows, allowance))
        }
        Values::Words(first) => {
            let second = b.trace.words(&column.name)?;
            Some(words(&column.name, a.time(), (first, second), rows))
        }
    };
    a.trace.columns().iter().filter(wanted).filter_map(compare).collect()
}

/// Returns the names of the channels of `a` that `b` lacks.
pub(super) fn missing(a: &Results, b: &Results) -> Vec<String> {
    let has = |name: &str| b.trace.numbers(name).is_some() || b.trace.words(name).is_some();
    a.trace.columns().iter().map(|column| &column.name).filter(|name| !has(name)).cloned().collect()
}

fn numbers(
    name: &str,
    time: &[f64],
    (a, b): (&[f64], &[f64]),
    rows: &CommonRows,
    allowance: &Allowance,
) -> ChannelDifference {
    let values = || rows.pairs.iter().filter_map(|(i, j)| Some((*time.get(*i)?, *a.get(*i)?, *b.get(*j)?)));
    let finite = values().flat_map(|(_, x, y)| [x.abs(), y.abs()]).filter(|x| x.is_finite());
    let allowed = allowance.of(name, finite.fold(0.0, f64::max));
    let (mut worst, mut at, mut first, mut count) = (0.0, None, None, 0);
    for (t, x, y) in values() {
        let apart = distance(x, y);
        if apart > worst {
            (worst, at) = (apart, Some(Real(t)));
        }
        if apart > allowed {
            first = first.or(Some(Real(t)));
            count += 1;
        }
    }
    let (worst, allowed) = (Some(Real(worst)), Some(Real(allowed)));
    ChannelDifference { name: name.to_owned(), unit: unit(name), worst, at, allowed, first, rows: count }
}

/// Returns |x - y|. The distance is infinite if one value is not finite and the other value differs.
pub(super) fn distance(x: f64, y: f64) -> f64 {
    if x == y || (x.is_nan() && y.is_nan()) {
        return 0.0;
    }
    let distance = (x - y).abs();
    if distance.is_nan() { f64::INFINITY } else { distance }
}

fn words(name: &str, time: &[f64], (a, b): (&Words, &Words), rows: &CommonRows) -> ChannelDifference {
    let differ = rows.pairs.iter().filter(|(i, j)| a.get(*i) != b.get(*j) && !rows.on_events.contains(i));
    let first = differ.clone().next().and_then(|(i, _)| time.get(*i)).map(|t| Real(*t));
    ChannelDifference {
        name: name.to_owned(),
        unit: "",
        worst: None,
        at: first,
        allowed: None,
        first,
        rows: differ.count(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_meet_at_common_times_only() {
        let grid = |n: u32, step: f64| (0..n).map(|k| f64::from(k) * step).collect::<Vec<f64>>();
        let (coarse, fine) = (grid(11, 3e-5), grid(31, 1e-5));
        let pairs = CommonRows::new(&coarse, &fine, 1.0).pairs;
        assert_eq!(pairs, (0..11).map(|k| (k, 3 * k)).collect::<Vec<_>>());
        assert_eq!(CommonRows::new(&coarse, &fine, 6e-5).pairs, [(0, 0), (1, 3), (2, 6)]);
        // NaN equals no time.
        assert_eq!(CommonRows::new(&[0.0, 1.0], &[0.5, f64::NAN, 1.0], 1.0).pairs, [(1, 2)]);
    }

    #[test]
    fn rows_at_events_are_left_out_where_they_may_show_either_side() {
        let time = [0.0, 1.0, 2.0, 3.0];
        let events = vec![2.001, 0.99, 1.5];
        let rows = CommonRows::new(&time, &time, 3.0);
        let cleared = rows.clone().told_from_events((&time, &time), events.clone(), 0.01, |_, _| false);
        assert_eq!((cleared.pairs, cleared.at_events), (vec![(0, 0), (3, 3)], 2));
        let rounded = [0.0, 1.0_f64.next_up(), 2.0, 3.0_f64.next_up()];
        let cleared = rows.told_from_events((&time, &rounded), events, 0.01, |s, t| s == t);
        assert_eq!((cleared.pairs, cleared.at_events), (vec![(0, 0), (2, 2), (3, 3)], 1));
    }

    #[test]
    fn what_is_not_finite_equals_itself_only() {
        assert_eq!(distance(f64::NAN, f64::NAN), 0.0);
        assert_eq!(distance(f64::INFINITY, f64::INFINITY), 0.0);
        assert_eq!(distance(f64::NAN, 1.0), f64::INFINITY);
        assert_eq!(distance(f64::INFINITY, f64::NEG_INFINITY), f64::INFINITY);
        assert_eq!(distance(1.0, -0.5), 1.5);
    }
}
