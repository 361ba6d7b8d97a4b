//! How contacts that grow, and that shrink back on what they grew by, are led along.

use super::Variation;
use super::anchors::Held;
use super::parameter::Moment;
use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::record::Stride;
use crate::state::State;

/// A height, as a part of the depth, that is as good as none.
const NOTHING: f64 = 1e-6;

/// Knots of a path of growth that are looked at in a step: those between lie on cubics.
const MOST_KNOTS: usize = 32;

impl Variation<'_> {
    /// Whether an edge lies between what a contact remembers of before the interval and its apex: not where it grows, nor where a
    /// shrinking contact has come back to the curve on which it grew.
    pub(super) fn has_edge(&self, contact: &Contact, from: &State, to: &State) -> bool {
        let branch = match &from.modes[contact.place] {
            Mode::Slip(branch) => branch,
            mode => return *mode != Mode::Grow,
        };
        let eq = Equations { pieces: &from.pieces, ..Equations::on(self.model, to, self.layout, false) };
        let motion = eq.motion(contact, to.t, |i| to.y[i]);
        let closes = motion.du.abs() < -contact.interface.stick_slope() * motion.dd;
        let front = contact.front(&from.memories[contact.place], branch, &motion);
        !closes || branch.is_gross() || front < (1.0 - NOTHING) * motion.d
    }

    /// Paths of growth begin, or go on beyond an event of others. What a contact carries as a state while it grows begins with what
    /// its memory holds.
    pub(super) fn begin_growth(&mut self, left: Option<&State>, state: &State) {
        let dimension = self.layout.dimension();
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let (Mode::Grow, Some(slot)) = (&state.modes[c], contact.slot) else { continue };
            let at = |i: usize| state.y[i];
            let motion = Equations::on(self.model, state, self.layout, false).motion(contact, state.t, at);
            let (slope, memory) = (motion.du / motion.dd, &state.memories[c]);
            let moved = self.moved(contact, self.moment(state));
            self.anchors[c].begin_growth(memory.apex().d.max(0.0), slope, &moved);
            if left.is_some_and(|left| left.modes[c] == Mode::Grow) {
                continue;
            }
            let touches = left.is_some_and(|left| left.modes[c] == Mode::Open);
            if self.works.are_led() {
                for (j, moved) in moved.iter().enumerate() {
                    let stored = self.held_energy(contact, state, *moved, j);
                    self.works.store(slot, j, stored);
                }
            }
            let (modulus, profile) = (contact.interface.tangential_modulus(), contact.interface.profile());
            let held = Held::of(&self.anchors[c], contact, memory);
            for (j, (du, dd)) in moved.into_iter().enumerate() {
                // All springs of a flat end touch at once: where it has got to by then.
                let reduced = if touches {
                    profile.reduced_stiffness(f64::MIN_POSITIVE) * slope * dd
                } else {
                    profile.reduced_stiffness(motion.d) * du - held.below(profile, motion.d, j)
                };
                self.columns[j * dimension + self.layout.force(slot)] = modulus * reduced;
            }
            let force = memory.preview(&contact.interface, memory.apex()).force;
            let first = self.count() - self.parameters.len();
            for (j, parameter) in (first..).zip(self.parameters) {
                let pull = parameter.pull(contact, memory, force, [motion.d, motion.d, 0.0]);
                self.columns[j * dimension + self.layout.force(slot)] += pull;
            }
        }
    }

    /// Notes how far growing contacts have led knots of their paths in the step just tried, between two parts of a stride.
    pub(super) fn grow(&mut self, from: &State, stride: &mut dyn Stride, (begin, end): (f64, f64)) {
        if stride.knots().is_empty() {
            return;
        }
        let (components, mut columns) = (self.components(from), Vec::new());
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let own = |knot: &&(usize, f64)| knot.0 == c && knot.1 > begin && knot.1 <= end;
            let parts: Vec<f64> = stride.knots().iter().filter(own).map(|knot| knot.1).collect();
            let every = parts.len().div_ceil(MOST_KNOTS).max(1);
            // The last one is among them.
            for part in parts.into_iter().rev().step_by(every).rev() {
                let share = (part - begin) / (end - begin);
                self.method.positions(share, components, &self.columns, &mut columns);
                let [t, _] = stride.at(part, &mut self.y);
                let eq = Equations::on(self.model, from, self.layout, false);
                let motion = eq.motion(contact, t, |i| self.y[i]);
                let moved = self.moved_by(contact, &columns, Moment { t, y: &self.y, ..self.moment(from) });
                self.anchors[c].grow(motion.d, motion.du / motion.dd, &moved);
            }
        }
    }
}
