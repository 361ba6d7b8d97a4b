//! What one part writes of a stretch, until those of all parts are put together.

use super::calendar::Key;
use super::rows::Rows;
use crate::event::{Event, Source};
use crate::model::Part;
use crate::record::{Extent, Record};
use stickslip_contact::{Memory, Segment};

/// Asks for leave to go on after which a part pauses, so that whoever watches the run is asked in time.
pub(super) const ASKS: u32 = 16;

/// A record that keeps what it is told of one part.
pub(super) struct Sheet {
    /// Values of a row.
    width: usize,
    /// Up to here all is written, s: a step that is taken again tells it again.
    written: f64,
    window: [f64; 2],
    pub(super) wants_events: bool,
    follows: bool,
    watched: [Option<usize>; 2],
    /// Whether the step at hand will be taken again: paths are told then.
    pub(super) glances: bool,
    /// The next look and the moments to be read, s.
    look: Option<f64>,
    asked: Vec<f64>,
    next_asked: usize,
    /// Whether the part has to ask again what is wanted of it.
    anew: bool,
    /// Asks for leave to go on that are left.
    asks: u32,
    rows: Rows,
    events: Vec<Event>,
    event_rows: Vec<f64>,
    next_event: usize,
    reads: Rows,
    pub(super) memories: Option<Vec<Memory>>,
    paths: Vec<(usize, Segment)>,
    /// How far its bodies went since the last mark.
    pub(super) extents: [Extent; 2],
    /// The same at the beginning of the stretch, and whether the way up to there is told again.
    extents_before: [Extent; 2],
    repeats: Repeats,
}

/// Whether the way of a body is told again from a step before.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Repeats {
    No,
    /// Up to the first moment that is read.
    Yes,
    /// It has been.
    Over,
}

impl Sheet {
    /// For a part, of what a record of the whole wants.
    pub(super) fn new(part: &Part, record: &dyn Record) -> Self {
        Self {
            width: part.model.channel_count(),
            written: f64::NEG_INFINITY,
            window: record.rows_within(),
            wants_events: record.wants_events(),
            follows: record.follows(),
            watched: record.watched().map(|body| part.bodies.iter().position(|b| Some(*b) == body)),
            glances: false,
            look: None,
            asked: Vec::new(),
            next_asked: 0,
            anew: false,
            asks: ASKS,
            rows: Rows::default(),
            events: Vec::new(),
            event_rows: Vec::new(),
            next_event: 0,
            reads: Rows::default(),
            memories: None,
            paths: Vec::new(),
            extents: [Extent::NONE; 2],
            extents_before: [Extent::NONE; 2],
            repeats: Repeats::No,
        }
    }

    /// Whether it is to tell how far its body went.
    pub(super) fn watches(&self) -> bool {
        self.watched.iter().any(Option::is_some)
    }

    /// Numbers of the rows that are asked of it in a stretch.
    pub(super) fn numbers(&self) -> usize {
        self.width * self.asked.len()
    }

    /// Forgets what is asked of the part, for another stretch; `repeats` says that it begins before where the whole stands.
    pub(super) fn ask_anew(&mut self, repeats: bool) {
        self.anew = !self.asked.is_empty();
        self.asked.clear();
        self.look = None;
        self.extents_before = self.extents;
        self.repeats = if repeats && self.watches() { Repeats::Yes } else { Repeats::No };
    }

    /// Asks for what it is at a moment, s, after all before.
    pub(super) fn ask(&mut self, t: f64) {
        self.asked.push(t);
        self.anew = true;
    }

    /// Asks for what it is at a moment, s, wherever that lies among the others.
    pub(super) fn ask_amid(&mut self, t: f64) {
        let place = self.asked.partition_point(|asked| *asked < t);
        if self.asked.get(place) != Some(&t) {
            self.asked.insert(place, t);
            self.anew = true;
        }
    }

    /// Asks for its memories at a moment, s.
    pub(super) fn look_at(&mut self, t: f64) {
        (self.look, self.anew) = (Some(t), true);
    }

    /// Whether the part has to ask again what is wanted of it.
    pub(super) fn begins_anew(&self) -> bool {
        self.anew
    }

    /// The part asks again.
    pub(super) fn begin(&mut self) {
        (self.next_asked, self.anew) = (0, false);
    }

    /// Goes on after a time up to which all is written, s.
    pub(super) fn go_on_from(&mut self, t: f64) {
        self.clear();
        self.written = t;
    }

    /// Forgets a stretch.
    pub(super) fn give_up(&mut self) {
        self.clear();
        (self.extents, self.glances) = (self.extents_before, false);
        if self.repeats == Repeats::Over {
            self.repeats = Repeats::Yes;
        }
    }

    fn clear(&mut self) {
        self.rows.clear();
        self.reads.clear();
        self.events.clear();
        self.event_rows.clear();
        self.next_event = 0;
        self.paths.clear();
        self.memories = None;
    }

    /// Takes a row of whatever time.
    pub(super) fn take_any(&mut self) {
        self.go_on_from(f64::NEG_INFINITY);
    }

    /// Gives leave to go on again.
    pub(super) fn refill(&mut self) {
        self.asks = ASKS;
    }

    /// The row of a time, s.
    pub(super) fn row_at(&mut self, due: f64) -> Option<&[f64]> {
        self.rows.until(due, self.width).filter(|row| row[0] == due)
    }

    /// The row told last.
    pub(super) fn last_row(&mut self) -> Option<&[f64]> {
        self.rows.last(self.width)
    }

    /// What was read at a moment asked for, s: at the end of a step just before it where that is as good as there.
    pub(super) fn read_at(&mut self, t: f64) -> Option<&[f64]> {
        self.reads.until(t, self.width)
    }

    /// The next event.
    pub(super) fn event(&self) -> Option<&Event> {
        self.events.get(self.next_event)
    }

    /// The events of a stretch.
    pub(super) fn events(&self) -> &[Event] {
        &self.events
    }

    /// Takes the next event.
    pub(super) fn pass_event(&mut self) {
        self.next_event += 1;
    }

    /// The row of the event taken last, where that was at time `t`, s; otherwise what was read at that moment.
    pub(super) fn row_of(&mut self, t: f64) -> Option<&[f64]> {
        let last =
            self.next_event.checked_sub(1).filter(|last| self.events.get(*last).is_some_and(|e| e.t == t));
        match last {
            Some(last) => self.event_rows.get(last * self.width..(last + 1) * self.width),
            None => self.read_at(t),
        }
    }

    /// Tells the paths of its contacts, as the whole counts them.
    pub(super) fn tell_paths(&mut self, part: &Part, record: &mut dyn Record) {
        self.paths.drain(..).for_each(|(c, path)| record.path(part.contacts[c], path));
    }
}

impl Record for Sheet {
    fn row(&mut self, values: &[f64]) {
        if values.first().is_some_and(|t| *t > self.written) {
            self.rows.push(values);
        }
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        if event.t > self.written {
            self.events.push(*event);
            self.event_rows.extend_from_slice(values);
        }
    }

    fn next_look(&mut self) -> Option<f64> {
        self.look.take()
    }

    fn look(&mut self, _: f64, memories: &[Memory]) {
        self.memories = Some(memories.to_vec());
    }

    fn follows(&self) -> bool {
        self.follows
    }

    fn path(&mut self, c: usize, segment: Segment) {
        if !self.glances {
            self.paths.push((c, segment));
        }
    }

    fn next_mark(&mut self) -> Option<f64> {
        self.next_asked += 1;
        self.asked.get(self.next_asked - 1).copied()
    }

    fn mark(&mut self, values: &[f64]) {
        if self.repeats == Repeats::Yes {
            (self.extents, self.repeats) = (self.extents_before, Repeats::Over);
        }
        self.reads.push(values);
    }

    fn watched(&self) -> [Option<usize>; 2] {
        self.watched
    }

    fn extents(&mut self, [body, foot]: [Extent; 2]) {
        self.extents = [self.extents[0].join(body), self.extents[1].join(foot)];
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.asks = self.asks.saturating_sub(1);
        self.asks > 0
    }

    fn rows_within(&self) -> [f64; 2] {
        self.window
    }

    fn wants_events(&self) -> bool {
        self.wants_events
    }
}

/// The order of an event among those of one moment: waveforms first, whose corners are those of all parts at once.
pub(super) fn key(part: &Part, source: Source) -> Key {
    match source {
        Source::Waveform(w) => (0, part.waveforms[w]),
        Source::Contact(c) => (1, part.contacts[c]),
        Source::Block(k) => (2, k),
    }
}
