//! When the parts have events: known ahead of what is written of them, since a row of an event has the channels of all parts.

use super::sheet::key;
use crate::event::Event;
use crate::model::Part;
use crate::record::Record;
use crate::run::horizon::Goal;
use crate::run::located::LocatedRun;
use crate::run::output::Opening;
use crate::state::State;
use crate::{Plan, RunError};
use std::collections::VecDeque;

/// Order among the events of one moment: waveforms first, whose corners are those of all parts at once; then by their places.
pub(super) type Key = (u8, usize);

/// A part that runs ahead and notes when its events are.
pub(super) struct Scout<'m> {
    run: LocatedRun<'m>,
    state: State,
    notes: Notes<'m>,
    /// Whether it came to a fault, which the part will come to itself.
    failed: bool,
}

/// Moments of events, s, each with the first of them.
struct Notes<'m> {
    part: &'m Part,
    moments: VecDeque<(f64, Key)>,
    asks: u32,
}

impl<'m> Scout<'m> {
    /// Ahead of a part that stands in a state.
    pub(super) fn new(part: &'m Part, plan: &Plan, tolerance: f64, state: &State) -> Self {
        let mut notes = Notes { part, moments: VecDeque::new(), asks: 0 };
        // Where steps are constant the part itself ends.
        let plan = Plan { until_steady: None, every: None, ..*plan };
        let (mut run, mut state) = (LocatedRun::new(&part.model, &plan, tolerance), state.clone());
        run.set_out(&mut state, Opening::Resumed, &mut notes);
        Self { run, state, notes, failed: false }
    }

    /// Whether it knows what is up to a time, s.
    pub(super) fn has_passed(&self, t: f64) -> bool {
        self.failed || self.state.t >= t
    }

    /// Goes on past a time, s, or pauses on the way after so many asks for leave to go on.
    pub(super) fn pass(&mut self, t: f64, asks: u32) {
        if !self.has_passed(t) {
            self.notes.asks = asks;
            let outcome = self.run.go(&mut self.state, Goal::Past(t), &mut self.notes);
            self.failed = outcome.is_err_and(|fault| !matches!(fault, RunError::Interrupted { .. }));
        }
    }

    /// Forgets what was up to a time, s.
    pub(super) fn forget(&mut self, t: f64) {
        while self.notes.moments.front().is_some_and(|(at, _)| *at <= t) {
            self.notes.moments.pop_front();
        }
    }

    /// The moments up to a time, s.
    pub(super) fn moments(&self, t: f64) -> impl Iterator<Item = (f64, Key)> {
        self.notes.moments.iter().copied().take_while(move |(at, _)| *at <= t)
    }

    /// Attempts so far.
    pub(super) fn attempts(&self) -> u64 {
        self.state.counts.steps + self.state.counts.rejected
    }
}

impl Record for Notes<'_> {
    fn row(&mut self, _: &[f64]) {}

    fn event(&mut self, event: &Event, _: &[f64]) {
        if self.moments.back().is_none_or(|(t, _)| *t < event.t) {
            self.moments.push_back((event.t, key(self.part, event.source)));
        }
    }

    fn wants_event_rows(&self) -> bool {
        false
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.asks = self.asks.saturating_sub(1);
        self.asks > 0
    }
}
