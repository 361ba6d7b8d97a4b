//! Where events accumulate: the whole law, kinks included, for a part of a natural period.
//!
//! Some motions have no next smooth interval: both edges of a contact stand still at once, it opens and closes within rounding,
//! ringing fades along a line on which the law changes sides. Nothing is wrong with them, and steps that do not look for events
//! go through. So that is what is done: every contact goes by the whole law of its memory for a part of the natural period of
//! the one whose events accumulate, under error control by halved steps, since embedded estimates see neither kinks nor growth.
//! Then events are located again. The state counts how often; a detour always moves on, so that no run can loop in them.
//!
//! A step h by the classical Runge–Kutta method is compared with two of h/2, the memory moved in between. Across a kink both are
//! of second order: a third of the difference is the error of the halves.

mod blocks;
mod ends;
#[cfg(test)]
mod tests;
mod way;

use super::Located;
use crate::RunError;
use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::method::Method;
use crate::record::{self, Record};
use crate::run::horizon::Progress;
use crate::state::{Detour, State, Whereabouts};
use blocks::Fall;
use stickslip_contact::{Memory, Segment, Timed};
use stickslip_stepper::{Attempt, FixedStep, Rk4, Stepping, System};
use way::Way;

/// Part of the step that would just meet the tolerance.
const SAFETY: f64 = 0.8;
/// What of the difference of a step and its halves is the error of the halves.
const THIRD: f64 = 1.0 / 3.0;
/// Longest step, rad of the fastest swing: a longer one and its halves may agree by accident.
const LONGEST: f64 = 0.1;
/// Where another swing is far faster than that of the contact whose events accumulate, a step may be this part of the detour: its
/// error tells then, and not the swing.
const PART: f64 = 0.125;
/// Shortest step, as a part of the detour: where that is too long there is no way on …
const SHORTEST: f64 = 1e-10;
/// … but where damped springs stick and slip in turn the law itself jumps, and the motion slides along the jump: no shorter step
/// agrees better with its halves, and what both err is taken.
const SLIDING: f64 = 1e-4;

/// What rounding leaves of the books, relative to all that is in them.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Room for the steps of a detour, made when the first one begins.
pub(super) struct Halves {
    stepper: Rk4,
    /// The end by one step; the middle and the end by two.
    one: Vec<f64>,
    half: Vec<f64>,
    two: Vec<f64>,
    /// What the contacts remember in the middle.
    memories: Vec<Memory>,
    /// Components at the start, and slopes at both ends of a half that is read inside.
    start: Vec<f64>,
    slopes: [Vec<f64>; 2],
    /// The same of the second half, where both are looked at.
    later: [Vec<f64>; 2],
    /// What a block remembers, for what it would lose on the way.
    kept: Vec<f64>,
    /// The channels of a moment, for the books.
    row: Vec<f64>,
}

/// A step under way: its start, its middle and its end, s.
#[derive(Clone, Copy)]
struct Times {
    from: f64,
    middle: f64,
    to: f64,
}

impl Times {
    fn halved(from: f64, to: f64) -> Self {
        Self { from, middle: from + 0.5 * (to - from), to }
    }

    /// Whether numbers tell its middle from its ends.
    fn moves_on(self) -> bool {
        self.from < self.middle && self.middle < self.to
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Puts every contact on its whole law. The solver stays behind: steps by halves have no use for it.
    pub(super) fn take_whole(&mut self, state: &mut State) {
        self.motion.whereabouts = Whereabouts::Behind;
        state.modes.fill(Mode::Whole { sense: 0.0 });
        state.grew.fill(false);
        self.takeoff = None;
    }

    /// One attempt by the whole law and, if its halves agree with it, all that belongs to the step.
    pub(super) fn step_whole(
        &mut self,
        state: &mut State,
        mut detour: Detour,
        record: &mut dyn Record,
    ) -> Result<Progress, RunError> {
        let mut times = self.times(state, &detour);
        let h = times.to - times.from;
        if self.horizon.is_beyond(times.to) {
            return Ok(Progress::Short);
        }
        if !self.setting.model.balanced.is_empty() {
            let least = SHORTEST * detour.length;
            times = Times::halved(times.from, self.until_overloaded(state, times.to, least)?);
        }
        if !times.moves_on() {
            return self.step_instant(state, (times.to, &detour), record);
        }
        let mut halves = self.halves.take().unwrap_or_else(|| Box::new(self.room(state)));
        let slides = self.slides && h <= SLIDING * detour.length;
        let (error, times, fall) = self.try_up_to_fall(&mut halves, state, (times, slides))?;
        let outcome = if error <= 1.0 || slides && error.is_finite() {
            state.counts.missed += u64::from(error > 1.0);
            // What a block has cut adds nothing to the wish, and takes nothing from it.
            if fall.is_none() {
                detour.step = h * (SAFETY * math::powf(error.max(1e-6), -1.0 / 3.0)).clamp(1.0, 4.0);
            }
            self.take_halves(&mut halves, state, (times, fall), record)
        } else {
            self.refuse_halves(state, (&mut detour, times.to - times.from), (error, &halves.two))
        };
        self.halves = Some(halves);
        self.detour = Some(detour);
        outcome?;
        if state.t >= detour.end {
            self.arrive(state, &detour, record);
        }
        self.bounds.step(state, record).map(|()| Progress::Made)
    }

    /// To a corner or an end that is a last place of t or two away: one instant, in which nothing moves.
    fn step_instant(
        &mut self,
        state: &mut State,
        (to, detour): (f64, &Detour),
        record: &mut dyn Record,
    ) -> Result<Progress, RunError> {
        if to <= state.t {
            return Err(RunError::StepTooSmall { t: state.t, step: to - state.t });
        }
        state.t = to;
        self.watch.fired.clear();
        self.turn_in_detour(state, record)?;
        if to >= detour.end {
            self.arrive(state, detour, record);
        }
        self.bounds.step(state, record).map(|()| Progress::Made)
    }

    /// What the waveforms do where a step ends at a corner, and what blocks do there and where their guards have fallen.
    fn turn_in_detour(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        let corner = state.t == self.horizon.corner && !state.waits_for_input(self.setting.model);
        if corner {
            self.turn_corners(state, record)?;
            self.turned(state);
            self.take_whole(state);
        }
        let outcome = self.pass_blocks(state, (0, corner), record);
        self.watch.fired.clear();
        outcome
    }

    fn room(&self, state: &State) -> Halves {
        let layout = self.setting.layout;
        let nothing = || vec![0.0; layout.total()];
        Halves {
            stepper: Rk4::new(layout.dimension(), layout.total()),
            one: nothing(),
            half: nothing(),
            two: nothing(),
            memories: state.memories.clone(),
            start: nothing(),
            slopes: [nothing(), nothing()],
            later: [nothing(), nothing()],
            kept: Vec::new(),
            row: Vec::new(),
        }
    }

    /// The next step: at most the one wished for, and up to no more than the end of the detour, a corner, or where the run
    /// is to stop.
    fn times(&self, state: &State, detour: &Detour) -> Times {
        let from = state.t;
        let bound = detour.end.min(self.horizon.next());
        let left = bound - from;
        let agreed = (LONGEST / self.setting.model.fastest).max(PART * detour.length);
        let to = match detour.step.min(self.motion.longest(from)).min(agreed) {
            step if step >= 0.999 * left => bound,
            step if 2.0 * step > left => from + 0.5 * left,
            step => from + step,
        };
        Times::halved(from, to)
    }

    /// Tries a step and its halves; gives the error of the halves in units of what is allowed.
    fn try_halves(&mut self, halves: &mut Halves, state: &mut State, times: Times) -> Result<f64, RunError> {
        let Times { from, middle, to } = times;
        let Halves { stepper, one, half, two, memories, row, kept, .. } = halves;
        let spent = stepper.evaluations();
        let eq = self.setting.plain(state);
        let (before, size) = record::balance(&eq, state, from, &|i| state.y[i], row);
        let mut friction = 0.0;
        one.copy_from_slice(&state.y);
        stepper.step(&eq, from, one, to - from);
        half.copy_from_slice(&state.y);
        stepper.step(&eq, from, half, middle - from);
        if half.iter().all(|y| y.is_finite()) {
            memories.clone_from(&state.memories);
            for (c, (contact, memory)) in
                self.setting.model.contacts.iter().zip(memories.iter_mut()).enumerate()
            {
                let path = chord(&eq, contact, middle, |i| half[i]);
                let work = memory.commit(&contact.interface, Timed { path, duration: middle - from });
                friction +=
                    contact.count * work.map_err(|source| self.setting.model.refused(c, middle, source))?;
            }
        }
        let eq = Equations { memories, ..eq };
        two.copy_from_slice(half);
        stepper.step(&eq, middle, two, to - middle);
        if !self.setting.model.blocks.is_empty() {
            friction += self.ledger.would_lose(&eq, [(middle, half), (to, two)], kept)?;
        }
        // Books that do not close tell of what places and velocities do not: work of friction on a way that bends.
        let books = record::balance(&eq, state, to, &|i| two[i], row).0 - friction - before;
        state.counts.evaluations += stepper.evaluations() - spent;
        let scale = &self.motion.allowance.allowed.scale;
        let off = |i: usize| THIRD * (one[i] - two[i]).abs() / scale[i];
        let books = books.abs() / (scale[self.setting.layout.input()] + ROUNDING * size);
        let components = (0..one.len()).filter(|i| scale[*i] > 0.0);
        // Not a number must not be lost in a maximum.
        let most = components
            .map(off)
            .chain([books])
            .fold(0.0, |most: f64, off| if off <= most || most.is_nan() { most } else { off });
        Ok(most)
    }

    /// Shortens the wish; fails where it is as short as can be, and where not even the shortest leads to a number.
    fn refuse_halves(
        &self,
        state: &mut State,
        (detour, h): (&mut Detour, f64),
        (error, end): (f64, &[f64]),
    ) -> Result<(), RunError> {
        state.counts.rejected += 1;
        let factor = SAFETY * math::powf(error, -1.0 / 3.0);
        detour.step = h * if factor > 0.1 { factor } else { 0.1 };
        if detour.step < SHORTEST * detour.length {
            if !error.is_finite() {
                let i = end.iter().position(|y| !y.is_finite()).unwrap_or(self.setting.layout.input());
                return Err(self.setting.model.not_finite(state.t, i));
            }
            return Err(RunError::StepTooSmall { t: state.t, step: detour.step });
        }
        Ok(())
    }

    /// Rows of the step, then both halves one after the other, then what waveforms and blocks do at its end.
    fn take_halves(
        &mut self,
        halves: &mut Halves,
        state: &mut State,
        (times, fall): (Times, Option<Fall>),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.watch.fired.clear();
        if let Some(fall) = fall {
            self.note_falls(state, halves, (times, fall));
        }
        if !times.moves_on() {
            return self.turn_in_detour(state, record);
        }
        let Times { from, middle, to } = times;
        let Halves { half, two, start, slopes, .. } = halves;
        start.copy_from_slice(&state.y);
        for (from, to) in [((from, &**start), (middle, &**half)), ((middle, &**half), (to, &**two))] {
            if state.t < self.horizon.end {
                if self.is_read_inside(to.0) {
                    self.fill_slopes(state, [from, to], slopes);
                }
                let half = Way { from, to, slopes, free: self.setting.layout.free };
                self.take_half(state, &half, record)?;
            }
        }
        state.counts.steps += 1;
        state.tally.step(Method::Whole);
        // The run may have ended before it.
        if state.t < to {
            self.watch.fired.clear();
        }
        self.turn_in_detour(state, record)
    }

    /// Whether anything is read of a half that ends at t before its end.
    fn is_read_inside(&self, t: f64) -> bool {
        let watches = self.output.turns.watches();
        watches || self.output.reads(t) || t > self.horizon.end || self.horizon.steps.due(t).is_some()
    }

    /// The slopes at both ends of a half, whose memories are those of its start.
    fn fill_slopes(&self, state: &State, ends: [(f64, &[f64]); 2], slopes: &mut [Vec<f64>; 2]) {
        let eq = self.setting.plain(state);
        for ((t, y), slopes) in ends.into_iter().zip(slopes) {
            eq.slopes(t, &y[..self.setting.layout.dimension()], slopes);
        }
    }

    /// One half: its rows, its end, and the memories of all contacts with it.
    fn take_half(
        &mut self,
        state: &mut State,
        half: &Way<'_>,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.take_periods(state, half);
        let t = half.to.0.min(self.horizon.end);
        let y = |i: usize| half.value(i, t);
        let eq = self.setting.plain(state);
        while let Some(due) = self.output.grid.due(t) {
            self.output.grid.write(&eq, state, due, &|i| half.value(i, due), record);
        }
        let at = |i: usize, t: f64| half.value(i, t);
        if self.output.turns.notice(&eq, (state.t, &state.y), (t, y), self.setting.tolerance) {
            self.output.turns.locate(&eq, [state.t, t], at);
        }
        while let Some(due) = self.output.marks.due(t) {
            self.output.tell_turns(&eq, state, due, at, record);
            self.output.marks.write(&eq, state, due, &|i| half.value(i, due), record);
        }
        self.output.tell_turns(&eq, state, t, at, record);
        if self.output.marks.watches() {
            let point = |i: usize| [t, state.shifts[i] + y(i), y(self.setting.layout.velocity(i))];
            self.output.marks.pass(state, point);
            self.output.marks.end_step();
        }
        while let Some(due) = self.output.looks.due(t) {
            let memories = self.memories_at(&eq, state, due, |i| half.value(i, due));
            self.output.looks.show(memories.as_deref().ok(), record);
        }
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            let path = chord(&self.setting.plain(state), contact, t, y);
            let duration = t - self.ledger.booked.last[c];
            let friction = state.memories[c]
                .commit(&contact.interface, Timed { path, duration })
                .map_err(|source| self.setting.model.refused(c, t, source))?;
            self.ledger.note(self.setting.model, state, c, path);
            self.ledger.booked.last[c] = t;
            state.friction[c] += contact.count * friction;
        }
        for i in 0..state.y.len() {
            state.y[i] = half.value(i, t);
        }
        state.t = t;
        if self.setting.model.blocks.is_empty() {
            return Ok(());
        }
        self.ledger.commit_blocks((self.setting.model, self.setting.layout), state)
    }

    /// The steps of the drive that are over in a half; the one with which they are constant ends the run.
    fn take_periods(&mut self, state: &State, half: &Way<'_>) {
        while let Some(due) = self.horizon.steps.due(half.to.0) {
            let i = self.horizon.steps.coordinate;
            if self.horizon.steps.take(state.shifts[i], half.value(i, due)) {
                self.end_at(due);
                return;
            }
        }
    }
}

/// The straight way of a contact to a time and components.
fn chord(eq: &Equations<'_>, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Segment {
    Segment::Straight(eq.motion(contact, t, y).apex())
}
