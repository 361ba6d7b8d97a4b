//! The regular grid of rows.

use crate::equations::Equations;
use crate::record::{self, Record};
use crate::state::State;

/// Rows due at multiples of an interval. Times are k × interval, never summed up; the first and the last row are
/// written by the run itself.
pub(super) struct Grid {
    every: f64,
    next: u64,
    count: u64,
    row: Vec<f64>,
}

/// A grid point this near to the end of the run, in intervals, is the end.
const SAME: f64 = 1e-9;

impl Grid {
    pub(super) fn new(every: Option<f64>, from: f64, end: f64) -> Self {
        let every = every.unwrap_or(f64::INFINITY);
        let before = |t: f64| (t / every - SAME).ceil().max(1.0) as u64 - 1;
        Self { every, next: (from / every + SAME).floor() as u64 + 1, count: before(end), row: Vec::new() }
    }

    /// The next row's time, if it lies at `end` or before it.
    pub(super) fn due(&self, end: f64) -> Option<f64> {
        let t = self.every * self.next as f64;
        (self.next <= self.count && t <= end).then_some(t)
    }

    /// Writes the row at time t and moves on to the next.
    pub(super) fn write(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        t: f64,
        y: &impl Fn(usize) -> f64,
        record: &mut dyn Record,
    ) {
        record::fill(equations, state, t, y, &mut self.row);
        record.row(&self.row);
        self.next += 1;
    }

    /// Writes a row off the grid: the first and the last one.
    pub(super) fn write_now(&mut self, equations: &Equations<'_>, state: &State, record: &mut dyn Record) {
        record::fill(equations, state, state.t, &|i| state.y[i], &mut self.row);
        record.row(&self.row);
    }
}
