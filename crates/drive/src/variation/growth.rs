//! How contacts that grow, and that shrink back on what they grew by, are led along.

use super::Variation;
use super::anchors::Held;
use super::singular::NOTHING;
use super::tangent::{Tangent, Varied};
use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::state::State;
use stickslip_contact::Memory;
use stickslip_stepper::{Attempt, Bracket, Completion, Point, Step, root};

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
            let moved = Tangent::moved(contact, &self.columns, self.layout);
            self.anchors[c].begin_growth(memory.apex().d.max(0.0), slope, &moved);
            if left.is_some_and(|left| left.modes[c] == Mode::Grow) {
                continue;
            }
            let touches = left.is_some_and(|left| left.modes[c] == Mode::Open);
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
        }
    }

    /// Notes how far growing contacts have led the knots that the run's memory has in the step just tried.
    pub(super) fn grow(&mut self, (from, to): (&State, &State), varied: &Varied<'_>) {
        for (c, contact) in self.model.contacts.iter().enumerate() {
            if from.modes[c] != Mode::Grow {
                continue;
            }
            self.solver.complete(varied, Completion::Dense);
            let span = self.solver.span();
            let (t0, t1) = (span.time, span.end_time);
            let at = |t: f64| varied.eq.motion(contact, t, |i| self.solver.value(i, t));
            let Memory::Curve(curve) = &to.memories[c] else { continue };
            let reached = at(t1).d;
            while let Some(height) = self.anchors[c].next_knot(curve).filter(|height| *height <= reached) {
                let point = |t: f64| Point { x: t, y: at(t).d - height };
                let bracket = Bracket { from: point(t0), to: point(t1) };
                let t = root(|t| at(t).d - height, bracket, f64::EPSILON * t1.abs());
                let motion = at(t);
                let dimension = self.layout.dimension();
                let column = |k: usize| self.solver.value(dimension + k, t);
                let columns: Vec<f64> = (0..self.columns.len()).map(column).collect();
                let moved = Tangent::moved(contact, &columns, self.layout);
                self.anchors[c].grow(height, motion.du / motion.dd, &moved);
            }
        }
    }

    /// The last knot of a path of growth that rounding has stopped short of.
    pub(super) fn reach_end(
        &mut self,
        contact: &Contact,
        (from, to): (&State, &State),
        moved: &[(f64, f64)],
    ) {
        let c = contact.place;
        if let (Mode::Grow, Memory::Curve(curve)) = (&from.modes[c], &to.memories[c])
            && let Some(height) = self.anchors[c].next_knot(curve)
        {
            let eq = Equations { pieces: &from.pieces, ..Equations::on(self.model, to, self.layout, false) };
            let motion = eq.motion(contact, to.t, |i| to.y[i]);
            self.anchors[c].grow(height, motion.du / motion.dd, moved);
        }
    }
}
