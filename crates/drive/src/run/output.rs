//! What a run hands to its record: rows on a regular grid, events, looks into the contacts.
//!
//! When something is due is decided here, what it is is worked out by the run: inside a step from its dense
//! output, inside a leap from its closed form. No step ends because of output, and evaluations that it costs
//! are counted apart.

use crate::equations::Equations;
use crate::event::Event;
use crate::record::{self, Record};
use crate::state::{Layout, State};
use crate::{Model, Moments, Schedule};
use stickslip_contact::Memory;

/// What a run hands to its record. It reads states and dense outputs and changes neither: with it and without it a run has
/// the same bits.
pub(super) struct Output {
    /// Interval of the rows, s.
    every: Option<f64>,
    pub(super) grid: Grid,
    pub(super) looks: Looks,
    row: Vec<f64>,
    /// Scratch: components of a moment, or their slopes.
    pub(super) components: Vec<f64>,
    /// Evaluations made for rows and looks only.
    pub(super) evaluations: u64,
}

impl Output {
    pub(super) fn new(every: Option<f64>, layout: Layout) -> Self {
        let (row, components) = (Vec::new(), vec![0.0; layout.total()]);
        let grid = Grid::new(None, 0.0, 0.0);
        Self { every, grid, looks: Looks::NONE, row, components, evaluations: 0 }
    }

    /// Begins the rows of a run from one time to another, s.
    pub(super) fn set_out(&mut self, from: f64, end: f64) {
        self.grid = Grid::new(self.every, from, end);
    }

    /// Takes the first look.
    pub(super) fn begin_looks(&mut self, model: &Model, state: &State, record: &mut dyn Record) {
        self.looks = Looks::begin(model, state, record);
    }

    /// Whether a row or a look is due at t or before it.
    ///
    /// Two comparisons: all that a step without output pays for it.
    #[inline(always)]
    pub(super) fn due(&self, t: f64) -> bool {
        self.grid.due(t).is_some() || self.looks.due(t).is_some()
    }

    /// Ends the rows earlier.
    pub(super) fn end_at(&mut self, end: f64) {
        self.grid.end_at(end);
    }

    /// Writes a row off the grid: the first and the last one.
    pub(super) fn write_now(&mut self, equations: &Equations<'_>, state: &State, record: &mut dyn Record) {
        self.grid.write_now(equations, state, record);
    }

    /// Writes an event and the row after it.
    pub(super) fn event(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        event: &Event,
        record: &mut dyn Record,
    ) {
        record::fill(equations, state, state.t, &|i| state.y[i], &mut self.row);
        record.event(event, &self.row);
    }
}

/// Rows due at multiples of an interval. The first and the last row are written by the run itself.
pub(super) struct Grid {
    schedule: Schedule,
    end: f64,
    row: Vec<f64>,
}

impl Grid {
    pub(super) fn new(every: Option<f64>, from: f64, end: f64) -> Self {
        let moments = every.map_or(Moments::At(Vec::new()), Moments::Every);
        let mut schedule = Schedule::new(moments, from, end);
        if schedule.due() <= from {
            schedule.advance();
        }
        Self { schedule, end, row: Vec::new() }
    }

    /// The next row's time, if it lies at `t` or before it.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        let due = self.schedule.due();
        (due <= t && due < self.end).then_some(due)
    }

    /// Ends the rows earlier: the last one will be written there by the run itself.
    pub(super) fn end_at(&mut self, end: f64) {
        self.end = end;
        self.schedule.end_at(end);
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
        self.schedule.advance();
    }

    /// Writes a row off the grid: the first and the last one.
    pub(super) fn write_now(&mut self, equations: &Equations<'_>, state: &State, record: &mut dyn Record) {
        record::fill(equations, state, state.t, &|i| state.y[i], &mut self.row);
        record.row(&self.row);
    }
}

/// The looks into the contacts that a record asks for.
pub(super) struct Looks {
    /// The next moment, s; infinite where none is left.
    /// The next moment, s; infinite where none is left.
    due: f64,
}

impl Looks {
    /// Before a run: nobody has asked yet.
    pub(super) const NONE: Self = Self { due: f64::INFINITY };

    /// Asks for the first moment after the run's beginning; a look at the beginning itself is taken at once.
    pub(super) fn begin(model: &Model, state: &State, record: &mut dyn Record) -> Self {
        let mut looks = Self { due: f64::NEG_INFINITY };
        looks.ask(record);
        while looks.due < state.t {
            looks.ask(record);
        }
        if looks.due == state.t {
            record.look(state.t, &state.shifted_back(model));
            looks.ask(record);
        }
        looks
    }

    /// The next moment, if it lies at `t` or before it.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        (self.due <= t).then_some(self.due)
    }

    /// Shows the memories at the moment that is due and asks for the next one.
    ///
    /// Without memories, where a contact could not be followed to that moment, the look is left out.
    pub(super) fn show(&mut self, memories: Option<&[Memory]>, record: &mut dyn Record) {
        if let Some(memories) = memories {
            record.look(self.due, memories);
        }
        self.ask(record);
    }

    /// Moments that do not ascend end the looks.
    fn ask(&mut self, record: &mut dyn Record) {
        let next = record.next_look().unwrap_or(f64::INFINITY);
        self.due = if next > self.due { next } else { f64::INFINITY };
    }
}
