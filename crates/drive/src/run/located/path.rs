//! The paths of contacts through an accepted step.
//!
//! What a memory commits is a path in the plane of (d, u), not an end point. A chord is exact in every regime
//! but one: while a contact grows in full stick (|u̇| ≤ κḋ) the force depends on the path, and a chord costs
//! the method its order without its embedded estimate noticing. There the force is a state, Ḟ_x = G\*m(d)u̇,
//! and the path goes into the memory in pieces, each with the force and the energy that the state has at its
//! end. Measured on the oblique impact of a sphere: 195 steps with chords are wrong by 2.4e-5, 219 with the
//! state by 9e-10.

use super::Located;
use super::motion::Motion;
use super::watch::Fallen;
use crate::contact::{Mode, Motion as ContactMotion};
use crate::equations::Equations;
use crate::state::State;
use stickslip_contact::Segment;
use stickslip_stepper::{Attempt, Completion};

/// Most pieces into which a step's path of growth is cut where less than [`LEAST_BEND`] is left of its bend by them.
// 25 make a rocking slider at 1e-9 two thirds dearer and its books 27 times worse.
const MOST_PIECES: f64 = 256.0;
/// Bend of a piece, in u_c, below which a path is cut no further, ten times what [`BEND`] allows where that is less; and most pieces, which
/// bound memory.
// With 256 pieces alone books of bodies that bounce miss 1 300 to 9 300 tolerances of 1e-12, so 140 to 700, for as many instructions of
// stages on coupled contacts. A third of it makes these a third dearer, three times as much has books of 190 to 2 200. 1 024 pieces whatever
// is left have books of 80 to 270, and make stages 1.7 times as dear.
const LEAST_BEND: f64 = 1e-9;
pub(super) const FINEST_PIECES: f64 = 1024.0;

/// How far a piece of a path of growth may bend, in units of the tolerance. Forces at both its ends are those of the state:
/// a bend counts only where an edge stops inside the piece, and then for less than a hundredth.
// With 1000 a sine drive at 1e-6 ends four times as far off, and a rocking slider at 1e-9 takes 58 % more evaluations; with 10
// it ends less than half as far off, for three times the pieces.
const BEND: f64 = 100.0;
/// The same times βω where springs that stick are damped: as an edge cuts back through the path damping goes with where it stands, which
/// the piece tells, and not the state; and how far a piece may bend however strong the damping.
// Of a damped cone that is pressed and let go on a moving foot (βω = 1.5) for a period errors are 8 700 tolerances at 1e-8 with BEND, 110
// with this, at two thirds of the evaluations; 77 with 0.2, 163 with 2, and thousands at 1e-10. A walking drive (βω = 0.06) takes 2 %
// more instructions than with BEND at 1e-6 and 27 % more at 1e-9; 5 and 71 % with 0.2.
const DAMPED_BEND: f64 = 1.0;
const LEAST_DAMPED_BEND: f64 = 0.1;

/// Chords by which a step's way is told to a record that follows it.
// Friction of an oblique impact at 1e-8, summed along them: one chord a step is 2e-3 off, eight 4e-5.
const BENDS: u32 = 8;

/// Whose memories move at the end of a step.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Moves {
    /// Those of contacts whose form is not closed.
    Open,
    /// Theirs, and those of contacts whose guards fell.
    Fired,
    /// All.
    All,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// The segments of contacts that lead to the end of the step: chords, and for a contact that
    /// grew in full stick its path in as many pieces as its bend asks for.
    ///
    /// A contact of closed form drags one edge over one piece of its memory: one chord to its own next event is the same as many.
    ///
    /// The ledger is cleared first; nothing is committed here.
    // The memories of 32 unlike contacts on one slider, committed at every step, took 47 % of the run; those of a chain of 32
    // sliders, committed at every event of any of them, 16 %.
    pub(super) fn trace_step(&mut self, state: &State, t: f64, moves: Moves) {
        self.ledger.clear();
        if moves == Moves::Open && self.interval.is_closed() {
            return;
        }
        if moves == Moves::All {
            // What is never pressed has nothing to remember.
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

    /// The segments of contact `c`.
    fn trace_contact(&mut self, c: usize, state: &State, t: f64) {
        let contact = &self.setting.model.contacts[c];
        let span = self.motion.solver.span();
        let motion = self.watch.motion_at_end(&self.interval, c, (span.end_time, span.end));
        let curved = contact.slot.filter(|_| !contact.goes_straight(&state.pieces));
        let (Mode::Grow, Some(slot)) = (state.modes[c], curved) else {
            return self.ledger.push(c, t, Segment::Straight(motion.apex()));
        };
        // Of what is committed only growth reads the inside of a step: the evaluations of the dense output are asked for here and
        // not before.
        let eq = self.setting.equations(state, &self.interval);
        self.motion.solver.complete(&eq, Completion::Dense);
        let growth = Growth { motion: &self.motion, eq: &eq, state, tolerance: self.setting.tolerance };
        growth.trace((c, slot), (t, &motion), |t, piece| self.ledger.push(c, t, piece));
    }

    /// Tells of a step's way what the chords leave out: where the indentation changes it bends, and friction does its work
    /// along the bend. What is committed stays the chord, whose end is all that memories and forces depend on.
    #[inline(never)]
    fn tell_bends(&mut self, state: &State, t: f64) {
        let spent = self.motion.solver.evaluations();
        self.motion.solver.complete(&self.setting.equations(state, &self.interval), Completion::Dense);
        self.output.evaluations += self.motion.solver.evaluations() - spent;
        let eq = self.setting.plain(state);
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            if contact.is_never_pressed() || contact.is_constant() || state.modes[c] == Mode::Grow {
                continue;
            }
            for k in 1..BENDS {
                let at = state.t + (t - state.t) * f64::from(k) / f64::from(BENDS);
                let motion = eq.motion(contact, at, |i| self.motion.solver.value(i, at));
                self.ledger.note(self.setting.model, state, c, Segment::Straight(motion.apex()));
            }
        }
    }

    /// Moves the memories of contacts of closed form to where a run stops short of an event.
    ///
    /// Due at the end of a run only: what reads the memories then finds them where the state is.
    pub(super) fn settle(&mut self, state: &mut State) {
        self.trace_closed(state);
        // What is not finite has been refused before.
        let _ = self.ledger.commit((self.setting.model, self.setting.layout), state.t, state);
    }

    /// The segments of those contacts of closed form whose guards fell that lead to the state.
    pub(super) fn trace_fired(&mut self, state: &State) {
        let (ledger, t) = (&mut self.ledger, state.t);
        ledger.clear();
        for fallen in &self.watch.fired {
            if let Fallen::Contact(c, _) = fallen
                && let Some(steady) = self.interval.closed_form(*c)
            {
                ledger.push(*c, t, Segment::Straight(steady.apex(t, |i| state.y[i])));
            }
        }
    }

    /// The segments of contacts of closed form, and of those that only are there, that lead to the state.
    pub(super) fn trace_closed(&mut self, state: &State) {
        let (ledger, t) = (&mut self.ledger, state.t);
        ledger.clear();
        let x = |i: usize| state.y[i];
        for steady in &self.interval.closed {
            ledger.push(steady.index, t, Segment::Straight(steady.apex(t, x)));
        }
        for &c in &self.interval.apart {
            let motion = self.setting.plain(state).motion(&self.setting.model.contacts[c], t, x);
            ledger.push(c, t, Segment::Straight(motion.apex()));
        }
    }
}

/// Number of pieces of a path whose middle lies so far from the chord, both in u_c as what is allowed of a piece.
fn pieces(bend: f64, allowed: f64) -> f64 {
    let most = (bend / LEAST_BEND.min(10.0 * allowed)).sqrt().clamp(MOST_PIECES, FINEST_PIECES);
    (bend / allowed).sqrt().min(most).ceil().max(1.0)
}

/// The step in which a contact grows.
pub(super) struct Growth<'r, 'e, A> {
    pub(super) motion: &'r Motion<A>,
    /// The equations with what is known of the interval.
    pub(super) eq: &'r Equations<'e>,
    /// The state at its start.
    pub(super) state: &'r State,
    pub(super) tolerance: f64,
}

impl<A: for<'q> Attempt<Equations<'q>>> Growth<'_, '_, A> {
    /// The path of a growing contact on the dense output up to a time and a motion inside the step, each piece bent by
    /// less than [`BEND`] or [`DAMPED_BEND`] allows.
    ///
    /// With δ the distance of its middle from the chord, a path is cut into √(δ/allowed) pieces, at most as [`pieces`] says: the bend of
    /// a piece falls with the square of their number. `joins` of the first says whether the growth before went on without a bend, so
    /// that collinear pieces can be merged.
    pub(super) fn trace(
        &self,
        (c, slot): (usize, usize),
        (end, to): (f64, &ContactMotion),
        mut push: impl FnMut(f64, Segment),
    ) {
        let contact = &self.eq.model.contacts[c];
        let (t0, h) = (self.state.t, end - self.state.t);
        let at = |share: f64| {
            let t = t0 + share * h;
            self.eq.standing(contact, t, |i| self.motion.solver.value(i, t))
        };
        let (from, middle) = (self.state.memories[c].apex(), at(0.5));
        // By d and not by time: what the memory interpolates along is the height.
        let chord = from.u + (to.u - from.u) * (middle.d - from.d) / (to.d - from.d);
        let bend = (middle.u - chord).abs() / contact.natural.displacement;
        // A path that does not deepen has no slope in d; one piece says all of it.
        let allowed = (DAMPED_BEND / contact.fading()).clamp(LEAST_DAMPED_BEND, BEND);
        let pieces = if bend.is_finite() { pieces(bend, allowed * self.tolerance) } else { 1.0 };
        let mut joins = self.state.grew[c];
        for k in 1..=pieces as u32 {
            let share = f64::from(k) / pieces;
            // The end is the motion that all else is told, to the last bit.
            let (to, t) = if share >= 1.0 { (*to, end) } else { (at(share), t0 + share * h) };
            let force = self.motion.component(self.eq.layout.force(slot), t);
            let energy = self.motion.component(self.eq.layout.elastic(slot), t);
            push(t, Segment::Grown { to: to.apex(), force, energy, joins });
            joins = true;
        }
    }
}
