//! Paths of contacts through an accepted step.
//!
//! A slip memory commits a path in the plane of (d, u), not only its end. A straight path is exact, except while a contact grows in full
//! stick (|u̇| ≤ κḋ). During growth the force depends on the path, and a straight path reduces the order of the method. The embedded error
//! estimate does not detect this loss.
//!
//! In full stick the force is therefore a state, Ḟ_x = G\*m(d)u̇. The path is committed in pieces, each with the values of the force and
//! energy states at its end.

use super::Located;
use super::motion::Motion;
use super::watch::Fallen;
use crate::contact::Motion as ContactMotion;
use crate::equations::Equations;
use crate::state::State;
use stickslip_contact::Segment;
use stickslip_stepper::{Attempt, Completion};

/// Largest number of pieces of a growth path, unless the bend of a piece would exceed [`LEAST_BEND`].
const MOST_PIECES: f64 = 256.0;
/// Bend of a piece in u_c down to which [`MOST_PIECES`] are sufficient, or ten times the allowed bend if that is less.
const LEAST_BEND: f64 = 1e-9;
/// Largest number of pieces of a growth path, which bounds the use of memory.
pub(super) const FINEST_PIECES: f64 = 1024.0;

/// Largest bend of a piece of a growth path, in tolerances of u_c.
///
/// The force at both ends of a piece is exact. The bend matters only if a slip edge later stops inside the piece.
const BEND: f64 = 100.0;

/// Number of straight pieces per step that are reported to a record that requests paths.
const BENDS: u32 = 8;

/// Contacts whose slip memories commit at the end of a step.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Moves {
    /// Contacts without a closed-form force.
    Open,
    /// Contacts without a closed-form force, and contacts with an event.
    Fired,
    /// All contacts.
    All,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Collects the paths of contacts to the end of the step: a straight path, or pieces for growth in full stick.
    ///
    /// A contact with a closed-form force slips along one memory piece. One straight path to its own next event is equivalent to many short
    /// ones. The paths are collected in the ledger and not committed here.
    pub(super) fn trace_step(&mut self, state: &State, t: f64, moves: Moves) {
        self.ledger.clear();
        if moves == Moves::Open && self.interval.is_closed() {
            return;
        }
        if moves == Moves::All {
            // A contact that is never pressed has no memory.
            let contacts = self.setting.model.contacts.iter().enumerate();
            let pressed = contacts.filter(|(_, contact)| !contact.is_never_pressed());
            pressed.for_each(|(c, _)| self.trace_contact(c, state, t));
        } else {
            for k in 0..self.interval.others.len() {
                self.trace_contact(self.interval.others[k], state, t);
            }
            for k in 0..self.interval.apart.len() {
                self.trace_contact(self.interval.apart[k], state, t);
            }
        }
        if moves == Moves::Fired {
            for k in 0..self.watch.fired.len() {
                if let Fallen::Contact(c, _) = self.watch.fired[k]
                    && self.interval.closed_form(c).is_some()
                {
                    self.trace_contact(c, state, t);
                }
            }
        }
        if self.ledger.is_told() {
            self.tell_bends(state, t);
        }
    }

    /// Collects the path of contact `c`.
    fn trace_contact(&mut self, c: usize, state: &State, t: f64) {
        let contact = &self.setting.model.contacts[c];
        let span = self.motion.solver.span();
        let motion = self.watch.motion_at_end(&self.interval, c, (span.end_time, span.end));
        let curved = contact.slot.filter(|_| !contact.goes_straight(&state.pieces));
        let Some(slot) = curved.filter(|_| state.modes[c].grows()) else {
            return self.ledger.push(c, Segment::Straight(motion.apex()));
        };
        // Only growth needs the inside of the step, so the dense output is computed here.
        let eq = self.setting.equations(state, &self.interval);
        self.motion.solver.complete(&eq, Completion::Dense);
        let growth = Growth { motion: &self.motion, eq: &eq, state, tolerance: self.setting.tolerance };
        growth.trace((c, slot), (t, &motion), |piece| self.ledger.push(c, piece));
    }

    /// Reports curved paths within a step to a record that requests paths.
    ///
    /// A path is curved where the indentation changes, and friction does work along the curve. The committed path is straight, because
    /// memories and forces depend on its end only.
    #[inline(never)]
    fn tell_bends(&mut self, state: &State, t: f64) {
        let spent = self.motion.solver.evaluations();
        self.motion.solver.complete(&self.setting.equations(state, &self.interval), Completion::Dense);
        self.output.evaluations += self.motion.solver.evaluations() - spent;
        let eq = self.setting.plain(state);
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            if contact.is_never_pressed() || contact.is_constant() || state.modes[c].grows() {
                continue;
            }
            for k in 1..BENDS {
                let at = state.t + (t - state.t) * f64::from(k) / f64::from(BENDS);
                let motion = eq.motion(contact, at, |i| self.motion.solver.value(i, at));
                self.ledger.note(self.setting.model, state, c, Segment::Straight(motion.apex()));
            }
        }
    }

    /// Commits the contacts with closed-form forces between two events.
    ///
    /// Needed only at the end of a run, where the slip memories may be read.
    pub(super) fn settle(&mut self, state: &mut State) {
        self.trace_closed(state);
        // Values that are not finite have been refused before.
        let _ = self.ledger.commit((self.setting.model, self.setting.layout), state.t, state);
    }

    /// Collects the paths of contacts with closed-form forces and an event, up to the current state.
    pub(super) fn trace_fired(&mut self, state: &State) {
        let (ledger, t) = (&mut self.ledger, state.t);
        ledger.clear();
        for fallen in &self.watch.fired {
            if let Fallen::Contact(c, _) = fallen
                && let Some(steady) = self.interval.closed_form(*c)
            {
                ledger.push(*c, Segment::Straight(steady.apex(t, |i| state.y[i])));
            }
        }
    }

    /// Collects the paths of contacts with closed-form forces and of open contacts, up to the current state.
    pub(super) fn trace_closed(&mut self, state: &State) {
        let (ledger, t) = (&mut self.ledger, state.t);
        ledger.clear();
        let x = |i: usize| state.y[i];
        for steady in &self.interval.closed {
            ledger.push(steady.index, Segment::Straight(steady.apex(t, x)));
        }
        for &c in &self.interval.apart {
            let motion = self.setting.plain(state).motion(&self.setting.model.contacts[c], t, x);
            ledger.push(c, Segment::Straight(motion.apex()));
        }
    }
}

/// Returns the number of pieces of a path. `bend` is the distance of its middle from the straight chord, in u_c.
///
/// `allowed` is the largest bend of a piece, in u_c.
fn pieces(bend: f64, allowed: f64) -> f64 {
    let most = (bend / LEAST_BEND.min(10.0 * allowed)).sqrt().clamp(MOST_PIECES, FINEST_PIECES);
    (bend / allowed).sqrt().min(most).ceil().max(1.0)
}

/// Step in which a contact grows in full stick.
pub(super) struct Growth<'r, 'e, A> {
    pub(super) motion: &'r Motion<A>,
    /// Equations of motion with the closed forms of the interval.
    pub(super) eq: &'r Equations<'e>,
    /// State at the start of the step.
    pub(super) state: &'r State,
    pub(super) tolerance: f64,
}

impl<A: for<'q> Attempt<Equations<'q>>> Growth<'_, '_, A> {
    /// Divides the path of a contact growing in full stick into pieces, up to a time and a motion inside the step.
    ///
    /// The path comes from the dense output. The bend of a piece decreases with the square of the number of pieces. A path whose middle is
    /// δ from the chord thus gets √(δ/allowed) pieces, limited by [`pieces`]. The allowed bend is [`BEND`].
    ///
    /// For the first piece, `joins` states whether it continues earlier growth without a corner, so that collinear pieces can be merged.
    pub(super) fn trace(
        &self,
        (c, slot): (usize, usize),
        (end, to): (f64, &ContactMotion),
        mut push: impl FnMut(Segment),
    ) {
        let contact = &self.eq.model.contacts[c];
        let (t0, h) = (self.state.t, end - self.state.t);
        let at = |share: f64| {
            let t = t0 + share * h;
            self.eq.standing(contact, t, |i| self.motion.solver.value(i, t))
        };
        let (from, middle) = (self.state.memories[c].apex(), at(0.5));
        // By d and not by time: the slip memory interpolates over the height.
        let chord = from.u + (to.u - from.u) * (middle.d - from.d) / (to.d - from.d);
        let bend = (middle.u - chord).abs() / contact.natural.displacement;
        // A path at constant d has no slope in d; one piece is sufficient.
        let pieces = if bend.is_finite() { pieces(bend, BEND * self.tolerance) } else { 1.0 };
        let mut joins = self.state.grew[c];
        for k in 1..=pieces as u32 {
            let share = f64::from(k) / pieces;
            // The last piece ends exactly at the given motion.
            let (to, t) = if share >= 1.0 { (*to, end) } else { (at(share), t0 + share * h) };
            let force = self.motion.component(self.eq.layout.force(slot), t);
            let energy = self.motion.component(self.eq.layout.elastic(slot), t);
            push(Segment::Grown { to: to.apex(), force, energy, joins });
            joins = true;
        }
    }
}
