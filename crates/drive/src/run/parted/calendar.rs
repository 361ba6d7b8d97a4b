//! When the parts have events: known ahead of what is written of them, since a row of an event has the channels of all parts.

use super::cores::side_by_side;
use super::lane::Lane;
use super::sheet::{ASKS, key};
use crate::event::{Event, EventKind};
use crate::model::Part;
use crate::record::Record;
use crate::run::horizon::Goal;
use crate::run::located::LocatedRun;
use crate::run::output::Opening;
use crate::state::State;
use crate::{Plan, RunError};
use std::collections::VecDeque;
use stickslip_contact::Memory;

/// Order among the events of one moment: waveforms first, whose corners are those of all parts at once; then by their places.
pub(super) type Key = (u8, usize);

/// The moments at which the parts of a stretch are to be read.
pub(super) struct Calendar<'m> {
    /// Ahead of each part, where events are written.
    scouts: Vec<Scout<'m>>,
    /// The part that is most of the work: it goes first, read at the events of the others, and its own events are known when
    /// the others follow. So it is not gone through twice.
    pub(super) first: Option<usize>,
    /// Share of the work beyond which a part goes first.
    pub(super) most: f64,
    /// Moments of events, s, with their first ones and their parts.
    moments: Vec<(f64, Key, usize)>,
}

impl<'m> Calendar<'m> {
    /// Without anybody ahead.
    pub(super) fn new() -> Self {
        Self { scouts: Vec::new(), first: None, most: 0.5, moments: Vec::new() }
    }

    /// Sends a scout ahead of each part where events are written; without a record of events nobody runs ahead.
    pub(super) fn send(&mut self, lanes: &[Lane<'m>], wants_events: bool) {
        if wants_events == self.scouts.is_empty() {
            self.scouts = lanes.iter().filter(|_| wants_events).map(Lane::scout).collect();
            self.first = None;
        }
    }

    /// Chooses the part that goes first in the next stretch; `needs_all` says that none can.
    pub(super) fn choose(&mut self, lanes: &[Lane<'m>], needs_all: bool) {
        if self.scouts.is_empty() {
            return;
        }
        let all: f64 = lanes.iter().map(Lane::work).sum();
        let first = lanes.iter().position(|lane| lane.work() > self.most * all).filter(|_| !needs_all);
        if let Some(k) = self.first.filter(|_| first != self.first) {
            self.scouts[k].start_from(&lanes[k].state);
        }
        self.first = first;
    }

    /// Sends all scouts to where the parts stand.
    pub(super) fn call_back(&mut self, lanes: &[Lane<'m>]) {
        self.scouts.iter_mut().zip(lanes).for_each(|(scout, lane)| scout.start_from(&lane.state));
    }

    /// Lets all scouts go on past a time, s; false where they paused on the way.
    pub(super) fn pass(&mut self, threads: usize, until: f64) -> bool {
        let first = self.first;
        let done = |scout: &Scout<'_>| Some(scout.place) == first || scout.has_passed(until);
        side_by_side(threads, &mut self.scouts, |scout| {
            if !done(scout) {
                scout.pass(until, ASKS);
            }
        });
        self.scouts.iter().all(done)
    }

    /// Notes what the scouts found of a stretch.
    pub(super) fn note(&mut self, (t, until): (f64, f64)) {
        self.moments.clear();
        for scout in self.scouts.iter().filter(|scout| Some(scout.place) != self.first) {
            let place = scout.place;
            self.moments
                .extend(scout.moments(until).filter(|(at, _)| *at > t).map(|(at, key)| (at, key, place)));
        }
        self.sort();
    }

    /// Notes the events that a part has had itself.
    pub(super) fn note_events(&mut self, lane: &Lane<'_>, until: f64) {
        let mut last = f64::NEG_INFINITY;
        // Turns are told with no row of the other parts.
        let told = |event: &&Event| event.t <= until && event.kind != EventKind::Turn;
        for event in lane.sheet.events().iter().filter(told) {
            if event.t > last {
                self.moments.push((event.t, key(lane.part, event.source), lane.place));
                last = event.t;
            }
        }
        self.sort();
    }

    fn sort(&mut self) {
        self.moments.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }

    /// When a part is to be read, s: at events of others that are before its own of that moment.
    pub(super) fn moments_of(&self, k: usize) -> impl Iterator<Item = f64> {
        self.moments.chunk_by(|a, b| a.0 == b.0).filter_map(move |moment| {
            let own = moment.iter().find(|(_, _, part)| *part == k);
            own.is_none_or(|own| own.1 > moment[0].1).then_some(moment[0].0)
        })
    }

    /// Forgets what was up to a time, s.
    pub(super) fn forget(&mut self, t: f64) {
        self.scouts.iter_mut().for_each(|scout| scout.forget(t));
    }

    /// What the scouts have done.
    pub(super) fn work(&self, lanes: &[Lane<'m>]) -> f64 {
        self.scouts.iter().zip(lanes).map(|(scout, lane)| lane.weight * scout.attempts() as f64).sum()
    }
}

/// A part that runs ahead and notes when its events are.
pub(super) struct Scout<'m> {
    /// Place of its part.
    place: usize,
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
    pub(super) fn new((place, part): (usize, &'m Part), plan: &Plan, tolerance: f64, state: &State) -> Self {
        let mut notes = Notes { part, moments: VecDeque::new(), asks: 0 };
        // Where steps are constant the part itself ends.
        let plan = Plan { until_steady: None, every: None, ..*plan };
        let (mut run, mut state) = (LocatedRun::new(&part.model, &plan, tolerance), state.clone());
        run.set_out(&mut state, Opening::Resumed, &mut notes);
        Self { place, run, state, notes, failed: false }
    }

    /// Goes on from where its part stands.
    fn start_from(&mut self, state: &State) {
        self.state.copy(state);
        self.state.memories.iter_mut().for_each(Memory::make_room);
        self.notes.moments.clear();
        self.failed = false;
        self.run.set_out(&mut self.state, Opening::Resumed, &mut self.notes);
    }

    /// Whether it knows what is up to a time, s.
    fn has_passed(&self, t: f64) -> bool {
        self.failed || self.state.t >= t
    }

    /// Goes on past a time, s, or pauses on the way after so many asks for leave to go on.
    fn pass(&mut self, t: f64, asks: u32) {
        self.notes.asks = asks;
        let outcome = self.run.go(&mut self.state, Goal::Past(t), &mut self.notes);
        self.failed = outcome.is_err_and(|fault| !matches!(fault, RunError::Interrupted { .. }));
    }

    /// Forgets what was up to a time, s.
    fn forget(&mut self, t: f64) {
        while self.notes.moments.front().is_some_and(|(at, _)| *at <= t) {
            self.notes.moments.pop_front();
        }
    }

    /// The moments up to a time, s.
    fn moments(&self, t: f64) -> impl Iterator<Item = (f64, Key)> {
        self.notes.moments.iter().copied().take_while(move |(at, _)| *at <= t)
    }

    /// Attempts so far.
    fn attempts(&self) -> u64 {
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
