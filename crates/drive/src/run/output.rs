//! Output of a run: rows on a regular time grid, events, snapshots of slip memories, and sample rows.
//!
//! A record requests the times of snapshots and sample rows. This module decides when output is due. The run computes the output from the
//! dense output of a step or from the closed form of an interval. Output never ends a step; evaluations for output are counted separately.

mod marks;
mod rows;
mod turns;

use crate::equations::Equations;
use crate::event::Event;
use crate::record::{self, Due, Entry, EventDetail, Record};
use crate::state::{Layout, State};
use crate::{Model, Moments, Schedule};
use stickslip_contact::Memory;

pub(super) use marks::{Marks, Point};
pub(super) use rows::Rows;
pub(super) use turns::Turns;

/// Output of a run to its record.
///
/// Output only reads states and dense outputs, so a run has the same bits with and without output.
pub(super) struct Output {
    /// Interval of the rows, s.
    pub(super) every: Option<f64>,
    pub(super) grid: Grid,
    pub(super) looks: Looks,
    pub(super) marks: Marks,
    pub(super) turns: Turns,
    pub(super) rows: Rows,
    pub(super) row: Vec<f64>,
    /// Scratch memory for the components at one time, or for their time derivatives.
    pub(super) components: Vec<f64>,
    /// Number of evaluations for output and other purposes that do not belong to the run.
    pub(super) evaluations: u64,
}

impl Output {
    pub(super) fn new(every: Option<f64>, layout: Layout) -> Self {
        let grid = Grid::new(None, 0.0, EVERYWHERE);
        let (row, components) = (Vec::new(), Vec::new());
        let (looks, marks, turns, rows) = (Looks::NONE, Marks::none(), Turns::default(), Rows::default());
        let blank = Self { every, grid, looks, marks, turns, rows, row, components, evaluations: 0 };
        blank.renewed(every, layout)
    }

    /// Returns an output without data in the storage of an earlier one.
    pub(super) fn renewed(mut self, every: Option<f64>, layout: Layout) -> Self {
        self.components.clear();
        self.components.resize(layout.total(), 0.0);
        let grid = Grid { row: self.grid.row, ..Grid::new(None, 0.0, EVERYWHERE) };
        let (marks, turns, rows) = (self.marks.renewed(), self.turns.renewed(), self.rows.renewed());
        Self { every, grid, looks: Looks::NONE, marks, turns, rows, evaluations: 0, ..self }
    }

    /// Starts the rows after time `from`, s, within the time window of the record.
    pub(super) fn set_out(&mut self, from: f64, record: &dyn Record) {
        let row = std::mem::take(&mut self.grid.row);
        self.grid = Grid { row, ..Grid::new(self.every, from, record.wants().rows_within) };
    }

    /// Requests the first snapshot and the first sample row, and writes those that are due now.
    pub(super) fn begin_looks(
        &mut self,
        equations: &Equations<'_>,
        at: (&Model, &State),
        opening: Opening,
        record: &mut dyn Record,
    ) {
        self.looks = Looks::begin(at, opening, record);
        self.turns
            .begin(at.0, record.wants().watched[0].filter(|_| record.wants().events != EventDetail::None));
        // The record may change during a run.
        self.rows.begin(at.0);
        self.marks.begin(equations, at, opening == Opening::Resumed, record);
    }

    /// Whether output is due at time t or before, or whether the record needs every step. The check costs a few comparisons.
    #[inline(always)]
    pub(super) fn due(&self, t: f64) -> bool {
        self.marks.watches() || self.reads(t)
    }

    /// Whether output is due inside a step that ends at time t.
    #[inline(always)]
    pub(super) fn reads(&self, t: f64) -> bool {
        self.grid.due(t).is_some() || self.looks.due(t).is_some() || self.marks.due(t).is_some()
    }

    /// Sets the time of the last row, s. Returns the time from which this end counts as reached, s.
    pub(super) fn end_at(&mut self, end: f64) -> f64 {
        self.grid.end_at(end)
    }

    /// Writes a row outside the grid: the first or the last row of a run.
    pub(super) fn write_now(&mut self, equations: &Equations<'_>, state: &State, record: &mut dyn Record) {
        self.grid.write_now(equations, state, record);
    }

    /// Reports an event with the row of values immediately after the event.
    pub(super) fn event(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        event: &Event,
        record: &mut dyn Record,
    ) {
        record::fill(equations, state, state.t, &|i| state.y[i], &mut self.row);
        record.take(Entry::Event(event, &self.row));
    }
}

/// First output of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Opening {
    /// A row at the start.
    Row,
    /// A row at the start only if the grid has one there.
    Grid,
    /// No row at the start, because an earlier run has written the row.
    Resumed,
}

impl Opening {
    /// Whether a row is written at the start of a run, at time t.
    pub(super) fn has_row(self, every: Option<f64>, t: f64) -> bool {
        match self {
            Self::Row => true,
            Self::Grid => every.is_some_and(|every| Schedule::new(Moments::Every(every), t, t).due() <= t),
            Self::Resumed => false,
        }
    }
}

/// Time window without limits, s.
const EVERYWHERE: [f64; 2] = [0.0, f64::INFINITY];
/// Largest distance beyond the end of a time window that counts as rounding, in row intervals.
const SAME: f64 = 1e-9;

/// Rows at multiples of an interval within a time window, and a last row at the end of a run.
pub(super) struct Grid {
    schedule: Schedule,
    /// End of the time window, s; after this time only the last row of the run is written.
    until: f64,
    /// Time of the next row, s; ∞ after the last one.
    next: f64,
    end: f64,
    row: Vec<f64>,
}

impl Grid {
    pub(super) fn new(every: Option<f64>, from: f64, [opens, closes]: [f64; 2]) -> Self {
        let moments = every.map_or(Moments::At(Vec::new()), Moments::Every);
        let schedule = if opens > from {
            Schedule::new(moments, opens, f64::INFINITY)
        } else {
            Schedule::after(moments, from, f64::INFINITY)
        };
        let until = closes + SAME * every.unwrap_or(0.0);
        let mut grid = Self { schedule, until, next: 0.0, end: f64::INFINITY, row: Vec::new() };
        grid.next = grid.scheduled();
        grid
    }

    /// Returns the time of the next regular row within the window, s; ∞ after the last one.
    fn scheduled(&self) -> f64 {
        let due = self.schedule.due();
        if due <= self.until { due } else { f64::INFINITY }
    }

    /// Returns the time of the next row, if that is at or before `t`.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        (self.next <= t && self.next < f64::INFINITY).then_some(self.next)
    }

    /// Sets the time of the last row, s. Returns the time from which this end counts as reached, s.
    pub(super) fn end_at(&mut self, end: f64) -> f64 {
        self.end = end;
        self.schedule.end_at(end);
        self.next = self.scheduled().min(end);
        self.schedule.nearly()
    }

    /// Writes the row at time t and advances to the next row.
    pub(super) fn write(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        t: f64,
        y: &impl Fn(usize) -> f64,
        record: &mut dyn Record,
    ) {
        record::fill(equations, state, t, y, &mut self.row);
        record.take(Entry::Row(&self.row));
        self.pass(t);
    }

    /// Moves to the row after time t.
    pub(super) fn pass(&mut self, t: f64) {
        if self.schedule.due() <= t {
            self.schedule.advance();
        }
        self.next = if t < self.end { self.scheduled().min(self.end) } else { f64::INFINITY };
    }

    /// Writes a row outside the grid: the first or the last row of a run.
    pub(super) fn write_now(&mut self, equations: &Equations<'_>, state: &State, record: &mut dyn Record) {
        record::fill(equations, state, state.t, &|i| state.y[i], &mut self.row);
        record.take(Entry::Row(&self.row));
    }
}

/// Snapshots of the slip memories that a record requests.
pub(super) struct Looks {
    /// Time of the next snapshot, s; ∞ if there is none.
    due: f64,
}

impl Looks {
    /// Value before a run, without a requested snapshot.
    pub(super) const NONE: Self = Self { due: f64::INFINITY };

    /// Requests the first snapshot at or after the start of a run. A snapshot at the start is taken at once.
    fn begin((model, state): (&Model, &State), opening: Opening, record: &mut dyn Record) -> Self {
        let mut looks = Self { due: f64::NEG_INFINITY };
        looks.ask(record);
        let resumed = opening == Opening::Resumed;
        while looks.due < state.t || resumed && looks.due == state.t {
            looks.ask(record);
        }
        if looks.due == state.t {
            let contacts = model.contacts().count();
            record.take(Entry::Look(state.t, &state.shifted_back(model)[..contacts]));
            looks.ask(record);
        }
        looks
    }

    /// Returns the time of the next snapshot, if that is at or before `t`.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        (self.due <= t).then_some(self.due)
    }

    /// Passes the slip memories at the time of the snapshot to the record and requests the next one.
    ///
    /// Without memories the snapshot is omitted, because a contact could not follow its path to that time.
    pub(super) fn show(&mut self, model: &Model, memories: Option<&[Memory]>, record: &mut dyn Record) {
        if let Some(memories) = memories {
            // Stops have no slip memory to look at.
            record.take(Entry::Look(self.due, &memories[..model.contacts().count()]));
        }
        self.ask(record);
    }

    /// Requests the next snapshot. A requested time that is not later than the last one ends the snapshots.
    fn ask(&mut self, record: &mut dyn Record) {
        let next = record.next(Due::Look).unwrap_or(f64::INFINITY);
        self.due = if next > self.due { next } else { f64::INFINITY };
    }
}
