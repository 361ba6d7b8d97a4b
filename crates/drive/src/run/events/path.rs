//! From an accepted step to the segments that the contacts commit.

use super::{Run, equations};
use crate::RunError;
use crate::equations::Equations;
use crate::interval::Steady;
use crate::model::Motion;
use crate::state::{Mode, State};
use stickslip_contact::Segment;
use stickslip_stepper::{Attempt, Completion};

/// Most pieces into which a step's path of growth is cut.
pub(super) const MOST_PIECES: f64 = 256.0;

/// How far a piece of a path of growth may bend, in units of the tolerance. Forces at both its ends are those of the state:
/// a bend counts only where an edge stops inside the piece, and then for less than a hundredth.
const BEND: f64 = 100.0;

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// The segments of all contacts that lead to the end of the step: chords, and for a contact that
    /// grew in full stick its path in as many pieces as its bend asks for.
    ///
    /// A steady contact drags one edge over one piece of its memory: one chord to the next event is the same as many, and
    /// a step that `goes_on` leaves its memory where it is.
    pub(super) fn trace_segments(&mut self, state: &State, t: f64, goes_on: bool) {
        self.segments.clear();
        let interval = self.interval.as_ref();
        if goes_on && interval.is_some_and(|interval| interval.is_steady()) {
            return;
        }
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let is_steady = || self.interval.as_ref().is_some_and(|interval| interval.steady(c).is_some());
            if contact.is_never_pressed() || (goes_on && is_steady()) {
                continue;
            }
            let motion = self.motion_at_end(c);
            if let (Mode::Grow, Some(slot)) = (state.modes[c], contact.slot) {
                let mut segments = std::mem::take(&mut self.segments);
                self.with_equations(state, |run, eq| {
                    run.solver.complete(eq, Completion::Dense);
                    run.trace_growth(eq, state, (c, slot), (t, &motion), |piece| segments.push((c, piece)));
                });
                self.segments = segments;
            } else {
                self.segments.push((c, Segment::Straight(motion.apex())));
            }
        }
    }

    /// The path of a growing contact on the dense output up to a time and a motion inside the step, each piece bent by
    /// less than [`BEND`] allows.
    pub(super) fn trace_growth(
        &self,
        eq: &Equations<'_>,
        state: &State,
        (c, slot): (usize, usize),
        (end, to): (f64, &Motion),
        mut push: impl FnMut(Segment),
    ) {
        let contact = &self.model.contacts[c];
        let (t0, h) = (state.t, end - state.t);
        let at = |share: f64| eq.motion(contact, t0 + share * h, |i| self.solver.value(i, t0 + share * h));
        let (from, middle) = (state.memories[c].apex(), at(0.5));
        let chord = from.u + (to.u - from.u) * (middle.d - from.d) / (to.d - from.d);
        let bend = (middle.u - chord).abs() / (BEND * self.tolerance * contact.natural.displacement);
        let pieces = if bend.is_finite() { bend.sqrt().ceil().clamp(1.0, MOST_PIECES) } else { 1.0 };
        let mut joins = state.grew[c];
        for k in 1..=pieces as u32 {
            let share = f64::from(k) / pieces;
            let (to, t) = if share >= 1.0 { (*to, end) } else { (at(share), t0 + share * h) };
            let force = self.component(self.layout.force(slot), t);
            let energy = self.component(self.layout.elastic(slot), t);
            push(Segment::Grown { to: to.apex(), force, energy, joins });
            joins = true;
        }
    }

    /// Component `i` at a time inside the step; before its end by the dense output.
    #[inline]
    pub(super) fn component(&self, i: usize, t: f64) -> f64 {
        if t == self.solver.span().end_time { self.solver.span().end[i] } else { self.solver.value(i, t) }
    }

    /// The same, with the integrals of the state that this run has no need to integrate.
    pub(super) fn component_at(&self, state: &State, i: usize, t: f64) -> f64 {
        if i < self.solver.span().end.len() { self.solver.value(i, t) } else { state.y[i] }
    }

    /// Moves the memories of steady contacts to where a run stops short of an event.
    pub(super) fn settle(&mut self, state: &mut State) {
        self.trace_steady(state);
        // What is not finite has been refused before.
        let _ = self.commit(state);
    }

    /// The segments of steady contacts, and of those that only are there, that lead to the state.
    pub(super) fn trace_steady(&mut self, state: &State) {
        self.segments.clear();
        if let Some(interval) = &self.interval {
            let x = |i: usize| state.y[i];
            let motion = |steady: &Steady<'_>| steady.motion(state.t, x, x).apex();
            let segment = |steady: &Steady<'_>| (steady.index, Segment::Straight(motion(steady)));
            self.segments.extend(interval.steady.iter().map(segment));
            for &c in &interval.apart {
                let motion =
                    equations(self.model, self.layout, state).motion(&self.model.contacts[c], state.t, x);
                self.segments.push((c, Segment::Straight(motion.apex())));
            }
        }
    }

    /// All contacts move their memory to where the step ended.
    pub(super) fn commit(&self, state: &mut State) -> Result<(), RunError> {
        for &(c, segment) in &self.segments {
            let contact = &self.model.contacts[c];
            let friction = state.memories[c]
                .commit(&contact.law, segment)
                .map_err(|source| RunError::Contact { t: state.t, contact: contact.name.clone(), source })?;
            if contact.slot.is_none() {
                state.friction[c] += contact.count * friction;
            }
            state.grew[c] = matches!(segment, Segment::Grown { .. });
        }
        Ok(())
    }
}
