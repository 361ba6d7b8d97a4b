//! Step doubling on the full force law, where events accumulate.
//!
//! Some motions have no next smooth interval: both slip edges of a contact stop together, or the contact opens and closes within rounding.
//! A motion may also slide along a line on which stick and slip alternate. Steps without event location can integrate such motions.
//!
//! If events of a contact accumulate, all contacts follow the full force law of their slip memories for a part of its natural period. Then
//! events are located again. The state counts these intervals of step doubling. Every interval advances the time, so a run always ends.
//!
//! A step h of the classical Runge–Kutta method is compared with two half steps, between which the slip memories commit. Embedded estimates
//! would detect neither kinks nor growth in full stick. If the step contains a kink, both results have order 2, and a third of the
//! difference is the error of the half steps.

mod blocks;
mod ends;
#[cfg(test)]
mod tests;
mod way;

use super::Located;
use crate::RunError;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::method::Method;
use crate::record::{self, Record};
use crate::run::horizon::Progress;
use crate::state::{Detour, State, Whereabouts};
use blocks::Fall;
use stickslip_contact::{Law, Memory, Segment};
use stickslip_stepper::{Attempt, FixedStep, Rk4, Stepping, System};
use way::Way;

/// Safety factor in the choice of the next step length.
const SAFETY: f64 = 0.8;
/// Error of the half steps, as a fraction of their difference from the full step.
const THIRD: f64 = 1.0 / 3.0;
/// Maximum time step, rad of the fastest oscillation. The two results of a longer step may agree by chance.
const LONGEST: f64 = 0.1;
/// Step length that is allowed in spite of [`LONGEST`], as a fraction of the interval of step doubling.
///
/// The value matters if another oscillation is far faster than the contact. The error of the step then detects that oscillation.
const PART: f64 = 0.125;
/// Shortest step, as a fraction of the interval of step doubling; a shorter step ends the run.
const SHORTEST: f64 = 1e-10;
/// Step length below which any error is accepted where a contact breaks loose, as a fraction of the interval of step doubling.
///
/// With two friction coefficients the force jumps there, and shorter steps do not reduce the difference of the two results.
const BREAKING: f64 = 1e-4;

/// Rounding error of the energy balance, relative to the size of its terms.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Storage for the steps of step doubling.
pub(super) struct Halves {
    stepper: Rk4,
    /// Components at the end of the full step (`one`), in the middle (`half`) and at the end (`two`) of the half steps.
    one: Vec<f64>,
    half: Vec<f64>,
    two: Vec<f64>,
    /// Slip memories in the middle of the step.
    memories: Vec<Memory>,
    /// Components at the start of the step (`start`), and time derivatives at both ends of a half step (`slopes`).
    start: Vec<f64>,
    slopes: [Vec<f64>; 2],
    /// Time derivatives at both ends of the second half step.
    later: [Vec<f64>; 2],
    /// Scratch for the memory of a block.
    kept: Vec<f64>,
    /// Scratch for the channels in the energy balance.
    row: Vec<f64>,
}

/// Start, middle and end of a step, s.
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

    /// Whether the middle of the step differs from both ends in spite of rounding.
    fn moves_on(self) -> bool {
        self.from < self.middle && self.middle < self.to
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Sets all contacts to the full force law. The data of the integrator become outdated, because half steps do not use it.
    pub(super) fn take_whole(&mut self, state: &mut State) {
        self.motion.whereabouts = Whereabouts::Behind;
        for contact in self.setting.model.contacts.iter().filter(|contact| contact.normal_damping > 0.0) {
            if state.modes[contact.place].is_open() {
                self.lose_overlap(state, contact.place, false);
            }
        }
        state.modes.fill(Law::whole(0.0));
        state.grew.fill(false);
        self.takeoff = None;
    }

    /// Attempts a step with the full force law and processes it if the error of its half steps is allowed.
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
        let breaks = self.jumps && h <= BREAKING * detour.length;
        let (error, times, fall) = self.try_up_to_fall(&mut halves, state, (times, breaks))?;
        let outcome = if error <= 1.0 || breaks && error.is_finite() {
            state.counts.missed += u64::from(error > 1.0);
            // A step that a block has cut leaves the next step length unchanged.
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

    /// Advances the time to a corner or end that is only one or two rounding errors away. Positions do not change.
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

    /// Handles waveform corners and block events at the end of a step.
    fn turn_in_detour(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        let corner = state.t == self.horizon.corner && !state.waits_for_input(self.setting.model);
        if corner {
            self.turn_corners(state, record)?;
            self.take_whole(state);
            self.grow_limits(state, false);
            self.turned(state);
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

    /// Returns the times of the next step: at most the planned length, and not beyond the end of the interval, a corner or the goal.
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

    /// Attempts a step and its half steps. Returns the error of the half steps in units of the allowed error.
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
                let work = memory.commit(&contact.interface, path);
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
        // The energy balance shows errors of the friction work on a curved path, which positions do not show.
        let books = record::balance(&eq, state, to, &|i| two[i], row).0 - friction - before;
        state.counts.evaluations += stepper.evaluations() - spent;
        let scale = &self.motion.allowance.allowed.scale;
        let off = |i: usize| THIRD * (one[i] - two[i]).abs() / scale[i];
        let books = books.abs() / (scale[self.setting.layout.input()] + ROUNDING * size);
        let components = (0..one.len()).filter(|i| scale[*i] > 0.0);
        // The maximum must keep a NaN.
        let most = components
            .map(off)
            .chain([books])
            .fold(0.0, |most: f64, off| if off <= most || most.is_nan() { most } else { off });
        Ok(most)
    }

    /// Shortens the next step. Fails if the step would be too short, or if even the shortest step has no finite result.
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

    /// Accepts a step: writes its output, takes both half steps, and handles waveforms and blocks at its end.
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
                let mut half = Way { from, to, slopes, free: self.setting.layout.free };
                self.take_half(state, &mut half, record)?;
            }
        }
        state.counts.steps += 1;
        state.tally.step(Method::Whole);
        // The run may have ended earlier.
        if state.t < to {
            self.watch.fired.clear();
        }
        self.turn_in_detour(state, record)
    }

    /// Whether output or a period end lies inside the half step that ends at time t.
    fn is_read_inside(&self, t: f64) -> bool {
        let watches = self.output.turns.watches();
        watches || self.output.reads(t) || t > self.horizon.end || self.horizon.steps.due(t).is_some()
    }

    /// Computes the time derivatives at both ends of a half step with the slip memories at its start.
    fn fill_slopes(&self, state: &State, ends: [(f64, &[f64]); 2], slopes: &mut [Vec<f64>; 2]) {
        let eq = self.setting.plain(state);
        for ((t, y), slopes) in ends.into_iter().zip(slopes) {
            eq.slopes(t, &y[..self.setting.layout.dimension()], slopes);
        }
    }

    /// Takes a half step: writes its output, commits all contacts and moves the state.
    fn take_half(
        &mut self,
        state: &mut State,
        half: &mut Way<'_>,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        if let Some(end) = self.horizon.take_periods(state, half, (half.to.0, &mut self.output.components)) {
            self.end_at(end);
        }
        let t = half.to.0.min(self.horizon.end);
        let eq = self.setting.plain(state);
        self.output.take((&eq, state), half, (t, self.setting.tolerance), record);
        let y = |i: usize| half.value(i, t);
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            let path = chord(&self.setting.plain(state), contact, t, y);
            let friction = state.memories[c]
                .commit(&contact.interface, path)
                .map_err(|source| self.setting.model.refused(c, t, source))?;
            self.ledger.note(self.setting.model, state, c, path);
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
}

/// Returns the straight path of a contact to time t with components y.
fn chord(eq: &Equations<'_>, contact: &Contact, t: f64, y: impl Fn(usize) -> f64) -> Segment {
    Segment::Straight(eq.motion(contact, t, y).apex())
}
