//! What a run hands to its record: rows on a regular grid, events, looks into the contacts.
//!
//! When something is due is decided here, what it is is worked out by the run: inside a step from its dense
//! output, inside a leap from its closed form. No step ends because of output, and evaluations that it costs
//! are counted apart.

mod marks;
mod rows;
mod turns;

use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::record::{self, Record};
use crate::state::{Layout, State};
use crate::{Model, Moments, Schedule};
use stickslip_contact::Memory;

pub(super) use marks::Marks;
pub(super) use rows::Rows;
pub(super) use turns::Turns;

/// What a run hands to its record. It reads states and dense outputs and changes neither: with it and without it a run has
/// the same bits.
pub(super) struct Output {
    /// Interval of the rows, s.
    pub(super) every: Option<f64>,
    pub(super) grid: Grid,
    pub(super) looks: Looks,
    pub(super) marks: Marks,
    pub(super) turns: Turns,
    pub(super) rows: Rows,
    row: Vec<f64>,
    /// Scratch: components of a moment, or their slopes.
    pub(super) components: Vec<f64>,
    /// Evaluations made for rows and looks, and others that are no part of the run.
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

    /// The same in the room there is.
    pub(super) fn renewed(mut self, every: Option<f64>, layout: Layout) -> Self {
        self.components.clear();
        self.components.resize(layout.total(), 0.0);
        let grid = Grid { row: self.grid.row, ..Grid::new(None, 0.0, EVERYWHERE) };
        let (marks, turns, rows) = (self.marks.renewed(), self.turns.renewed(), self.rows.renewed());
        Self { every, grid, looks: Looks::NONE, marks, turns, rows, evaluations: 0, ..self }
    }

    /// Begins the rows after a time, s. Rows in a run that `begins` there: the first one is at hand if it is on the grid.
    pub(super) fn set_out(&mut self, from: f64, record: &dyn Record) {
        let row = std::mem::take(&mut self.grid.row);
        self.grid = Grid { row, ..Grid::new(self.every, from, record.rows_within()) };
    }

    /// Asks for the first look and the first mark, and takes them if they are at hand.
    pub(super) fn begin_looks(
        &mut self,
        equations: &Equations<'_>,
        at: (&Model, &State),
        opening: Opening,
        record: &mut dyn Record,
    ) {
        self.looks = Looks::begin(at, opening, record);
        self.turns.begin(at.0, record.watched()[0].filter(|_| record.wants_events()));
        // Whoever listens now: a run may be told to another record on its way.
        self.rows.begin(at.0);
        self.marks.begin(equations, at, opening == Opening::Resumed, record);
    }

    /// Whether a row, a look or a mark is due at t or before it, or every step is read.
    ///
    /// A few comparisons: all that a step without output pays for it.
    #[inline(always)]
    pub(super) fn due(&self, t: f64) -> bool {
        self.marks.watches() || self.reads(t)
    }

    /// Whether something is read inside a step that ends at t.
    #[inline(always)]
    pub(super) fn reads(&self, t: f64) -> bool {
        self.grid.due(t).is_some() || self.looks.due(t).is_some() || self.marks.due(t).is_some()
    }

    /// Ends the rows at a time, s; the last of them is there, on the grid or not. Gives from when on a moment is the end.
    pub(super) fn end_at(&mut self, end: f64) -> f64 {
        self.grid.end_at(end)
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

    /// Tells turns of u up to a moment, s, of the present step; `y` reads a component at a moment.
    pub(super) fn tell_turns(
        &mut self,
        equations: &Equations<'_>,
        state: &State,
        until: f64,
        y: impl Fn(usize, f64) -> f64,
        record: &mut dyn Record,
    ) {
        while let Some((t, c)) = self.turns.take(until) {
            record::fill(equations, state, t, &|i| y(i, t), &mut self.row);
            record.event(&Event { t, source: Source::Contact(c), kind: EventKind::Turn }, &self.row);
        }
    }
}

/// How the output of a run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Opening {
    /// With a row of where it begins.
    Row,
    /// With a row only if one is due there.
    Grid,
    /// After what an earlier run has written up to there.
    Resumed,
}

impl Opening {
    /// Whether a row is to be written where a run begins, at t.
    pub(super) fn has_row(self, every: Option<f64>, t: f64) -> bool {
        match self {
            Self::Row => true,
            Self::Grid => every.is_some_and(|every| Schedule::new(Moments::Every(every), t, t).due() <= t),
            Self::Resumed => false,
        }
    }
}

/// No window: rows are wanted all the way.
const EVERYWHERE: [f64; 2] = [0.0, f64::INFINITY];
/// A row this near to the end of its window, in intervals, is in it: ends are rounded.
const SAME: f64 = 1e-9;

/// Rows due at multiples of an interval, within a window, and at the end of a run.
pub(super) struct Grid {
    schedule: Schedule,
    /// From when on none is wanted but the last, s.
    until: f64,
    /// The next row, s; infinite after the last one.
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

    /// The next row of the interval, s; infinite after the last one that is wanted.
    fn scheduled(&self) -> f64 {
        let due = self.schedule.due();
        if due <= self.until { due } else { f64::INFINITY }
    }

    /// The next row's time, if it lies at `t` or before it.
    #[inline]
    pub(super) fn due(&self, t: f64) -> Option<f64> {
        (self.next <= t && self.next < f64::INFINITY).then_some(self.next)
    }

    /// Ends the rows at another time, s.
    pub(super) fn end_at(&mut self, end: f64) -> f64 {
        self.end = end;
        self.schedule.end_at(end);
        self.next = self.scheduled().min(end);
        self.schedule.nearly()
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
        self.pass(t);
    }

    /// Moves on to the row after one at time t.
    pub(super) fn pass(&mut self, t: f64) {
        if self.schedule.due() <= t {
            self.schedule.advance();
        }
        self.next = if t < self.end { self.scheduled().min(self.end) } else { f64::INFINITY };
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
    due: f64,
}

impl Looks {
    /// Before a run: nobody has asked yet.
    pub(super) const NONE: Self = Self { due: f64::INFINITY };

    /// Asks for the first moment after the run's beginning; a look at the beginning itself is taken at once.
    fn begin((model, state): (&Model, &State), opening: Opening, record: &mut dyn Record) -> Self {
        let mut looks = Self { due: f64::NEG_INFINITY };
        looks.ask(record);
        let resumed = opening == Opening::Resumed;
        while looks.due < state.t || resumed && looks.due == state.t {
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
