//! From an accepted step to the segments that the contacts commit.

use super::{Run, equations};
use crate::RunError;
use crate::equations::Equations;
use crate::model::Motion;
use crate::state::{Mode, State};
use stickslip_contact::Segment;

/// Most pieces into which a step's path of growth is cut.
pub(super) const MOST_PIECES: f64 = 256.0;

impl Run<'_> {
    /// Motions of all contacts at the end of the step, and the segments that lead there: chords, and for a contact that
    /// grew in full stick its path in as many pieces as its bend asks for.
    pub(super) fn trace_segments(&mut self, state: &State, t: f64) {
        self.motions.clear();
        self.segments.clear();
        let eq = equations(self.model, self.layout, state);
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let end = self.solver.end();
            let motion = eq.motion(contact, t, |i| end[i]);
            self.motions.push(motion);
            match (state.modes[c], contact.slot) {
                (Mode::Grow, Some(slot)) => self.trace_growth(&eq, state, (c, slot), &motion),
                _ => self.segments.push((c, Segment::Straight(motion.apex()))),
            }
        }
    }

    /// The path of a growing contact on the dense output, each piece bent by less than the tolerance allows.
    fn trace_growth(&mut self, eq: &Equations<'_>, state: &State, (c, slot): (usize, usize), end: &Motion) {
        self.solver.dense(eq);
        let contact = &self.model.contacts[c];
        let (t0, h) = (state.t, self.solver.end_time() - state.t);
        let solver = &self.solver;
        let at = |share: f64| eq.motion(contact, t0 + share * h, |i| solver.value(i, t0 + share * h));
        let (from, middle) = (state.memories[c].apex(), at(0.5));
        let chord = from.u + (end.u - from.u) * (middle.d - from.d) / (end.d - from.d);
        let bend = (middle.u - chord).abs() / (self.tolerance * contact.natural.0);
        let pieces = if bend.is_finite() { bend.sqrt().ceil().clamp(1.0, MOST_PIECES) } else { 1.0 };
        let mut joins = state.grew[c];
        for k in 1..=pieces as u32 {
            let share = f64::from(k) / pieces;
            let last = share >= 1.0;
            let (to, t) = (if last { *end } else { at(share) }, t0 + share * h);
            let value = |i: usize| if last { solver.end()[i] } else { solver.value(i, t) };
            let (force, energy) = (value(self.layout.force(slot)), value(self.layout.elastic(slot)));
            self.segments.push((c, Segment::Grown { to: to.apex(), force, energy, joins }));
            joins = true;
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
