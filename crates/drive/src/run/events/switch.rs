//! What happens at an event: corners are turned, contacts get their next law.

use super::{Run, equations};
use crate::RunError;
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::guard::Guard;
use crate::model::{Contact, Measure, Motion};
use crate::record::{self, Record};
use crate::state::{Mode, State};
use stickslip_contact::{Course, Memory, Segment};
use stickslip_stepper::{Attempt, System};

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// Moves every waveform whose piece ends now to its next piece, and books jumps. Events are noted when all of it
    /// has happened: the state after them is whole.
    pub(super) fn turn_corners(&mut self, state: &mut State, record: &mut dyn Record) {
        let before = if self.jumpy { self.stored(state) } else { 0.0 };
        self.old.clone_from(&state.modes);
        let mut turned = std::mem::take(&mut self.turned);
        turned.clear();
        for (w, waveform) in self.model.waveforms.iter().enumerate() {
            while state.pieces[w].end <= state.t {
                let jump = waveform.jump_after(&state.pieces[w]) != 0.0;
                state.pieces[w] = waveform.after(&state.pieces[w]);
                turned.push((w, if jump { EventKind::Jump } else { EventKind::Corner }));
            }
        }
        if turned.iter().any(|(_, kind)| *kind == EventKind::Jump) {
            self.jump(state, before);
        }
        for (w, kind) in &turned {
            self.note(state, Source::Waveform(*w), *kind, record);
        }
        self.turned = turned;
    }

    /// Bodies that follow a waveform jump: a straight path of every contact in no time. The work of the jump is what
    /// the elastic energy, `before` until now, gains and friction takes.
    fn jump(&mut self, state: &mut State, before: f64) {
        let mut friction = 0.0;
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let to =
                equations(self.model, self.layout, state).motion(contact, state.t, |i| state.y[i]).apex();
            // A jump is as finite as its waveform.
            let from = state.memories[c].apex();
            let work =
                contact.count * state.memories[c].commit(&contact.law, Segment::Jump(to)).unwrap_or(0.0);
            state.friction[c] += work;
            friction += work;
            if let (Some(branching), true) = (state.memories[c].branching(), to != from) {
                let course = branching.course(&contact.law, to.d - from.d, to.u - from.u);
                self.decree(state, c, course, 0.0);
            }
        }
        state.jumps += self.stored(state) - before + friction;
    }

    /// Energy of contacts and links, J, at the committed state; without that of a prescribed normal load.
    fn stored(&self, state: &State) -> f64 {
        let eq = equations(self.model, self.layout, state);
        let contacts = self.model.contacts.iter().zip(&state.memories);
        let energy = |(contact, memory): (&Contact, &Memory)| {
            let apex = memory.apex();
            let normal = contact.coupling().map_or(0.0, |_| contact.law.normal_energy(apex.d));
            contact.count * (normal + memory.preview(&contact.law, apex).elastic)
        };
        let contacts = contacts.map(energy);
        let links = self.model.links.iter().map(|l| record::link_energy(&eq, l, state.t, &|i| state.y[i]));
        contacts.sum::<f64>() + links.sum::<f64>()
    }

    /// Decrees the next law of every contact whose guard fell; after a corner, of all contacts it moves.
    pub(super) fn handle_fallen(
        &mut self,
        state: &mut State,
        corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        for i in 0..self.fired.len() {
            let (c, guard) = self.fired[i];
            let contact = &self.model.contacts[c];
            let motion = self.motion_now(state, c);
            let (mut kind, course) = guard.fired(contact, &state.modes[c], &motion);
            // Where rounding, of time or of a displacement that has travelled far, stops short of the end of the piece, the
            // end is reached by decree.
            let slack = if guard == Guard::Piece {
                let left = guard.value(contact, state.law(c), &motion);
                guard.bands(contact, self.tolerance, motion.u).1 + left.max(0.0)
            } else {
                0.0
            };
            self.decree(state, c, course, slack);
            if kind == EventKind::LoopClosed && state.modes[c].is_gross() {
                kind = EventKind::GrossSlip;
            }
            self.note(state, Source::Contact(c), kind, record);
            self.watch.event(self.model, state, (c, kind))?;
        }
        if corner {
            for c in 0..self.model.contacts.len() {
                if !self.fired.iter().any(|(fired, _)| *fired == c) {
                    self.turn(state, c, record)?;
                }
            }
        }
        Ok(())
    }

    /// Decides afresh what a contact does after a corner, where velocities jump.
    fn turn(&mut self, state: &mut State, c: usize, record: &mut dyn Record) -> Result<(), RunError> {
        let contact = &self.model.contacts[c];
        if contact.is_never_pressed() || !moved_by_waveform(contact) {
            return Ok(());
        }
        // As it was before a jump, which decrees for itself.
        let old = self.old[c];
        state.grew[c] = false;
        self.decide(state, c);
        let kind = match (old, state.modes[c]) {
            (Mode::Open, Mode::Open) | (Mode::Grow, Mode::Grow) => return Ok(()),
            (Mode::Open, _) => EventKind::Touch,
            (_, Mode::Open) => EventKind::LiftOff,
            (_, Mode::Grow) => EventKind::FullStick,
            (Mode::Grow, _) => EventKind::SlipBegins,
            (old, new) if old.sense() == new.sense() => return Ok(()),
            (old, _) if old.is_gross() => EventKind::GrossSlipEnds,
            _ => EventKind::Reversal,
        };
        self.note(state, Source::Contact(c), kind, record);
        self.watch.event(self.model, state, (c, kind))
    }

    /// Decides from velocities what a contact does, and from accelerations where it is at rest.
    pub(super) fn decide(&mut self, state: &mut State, c: usize) {
        let contact = &self.model.contacts[c];
        let eq = equations(self.model, self.layout, state);
        let mut motion = eq.motion(contact, state.t, |i| state.y[i]);
        let (_, near) = Guard::Drag.bands(contact, self.tolerance, motion.u);
        if motion.du.abs() <= near && contact.law.stick_slope() * motion.dd.abs() <= near {
            (motion.dd, motion.du) = self.push(state, c, &motion);
        }
        let course = state.memories[c].course(&contact.law, motion.d, motion.dd, motion.du);
        let same = course.sense() != 0.0 && course.sense() == state.modes[c].sense();
        // A branch that goes on in its sense is still anchored where it was.
        if !same || !matches!(state.modes[c], Mode::Slip(_)) {
            self.decree(state, c, course, 0.0);
        }
    }

    /// Where a contact at rest sets out to, as a direction in (d, u): along its acceleration; within round-off of
    /// equilibrium along its remaining velocity, and on in its present sense if there is none.
    fn push(&mut self, state: &State, c: usize, motion: &Motion) -> (f64, f64) {
        let contact = &self.model.contacts[c];
        let eq = equations(self.model, self.layout, state);
        let slopes = &mut self.slopes;
        eq.slopes(state.t, &state.y, slopes);
        let of = |measure: &Measure| eq.acceleration(measure, state.t, |i| slopes[self.layout.velocity(i)]);
        let (bend, pull) = (contact.coupling().map_or(0.0, of), of(&contact.u));
        let noise = 1e-12 * contact.natural_velocity() * contact.natural.frequency;
        if pull.abs().max(contact.law.stick_slope() * bend.abs()) > noise {
            (bend, pull)
        } else if motion.du != 0.0 {
            (motion.dd, motion.du)
        } else {
            (motion.dd, state.modes[c].sense())
        }
    }

    /// Sets the law of a contact, and the force and energy it starts to grow with.
    fn decree(&self, state: &mut State, c: usize, course: Course, slack: f64) {
        let contact = &self.model.contacts[c];
        let course = if course == Course::Open && contact.is_constant() && state.memories[c].apex().d > 0.0 {
            Course::Forward
        } else {
            course
        };
        let was_gross = state.modes[c].is_gross();
        state.modes[c] = Mode::of(contact, &state.memories[c], course, slack);
        state.grew[c] = false;
        match (was_gross, state.modes[c].is_gross()) {
            (false, true) if state.step > 0.0 => state.stuck_step = state.step,
            (true, false) => state.step = state.step.min(state.stuck_step),
            _ => {}
        }
        if let (Mode::Grow, Some(slot)) = (state.modes[c], contact.slot) {
            let now = state.memories[c].preview(&contact.law, state.memories[c].apex());
            state.y[self.layout.force(slot)] = now.force;
            state.y[self.layout.elastic(slot)] = now.elastic;
        }
    }

    /// Writes an event down.
    fn note(&mut self, state: &mut State, source: Source, kind: EventKind, record: &mut dyn Record) {
        state.counts.events += 1;
        if record.wants_events() {
            let event = Event { t: state.t, source, kind };
            let mut row = std::mem::take(&mut self.row);
            let eq = equations(self.model, self.layout, state);
            record::fill(&eq, state, state.t, &|i| state.y[i], &mut row);
            record.event(&event, &row);
            self.row = row;
        }
    }
}

/// Whether a corner of any waveform changes the velocities of this contact directly.
fn moved_by_waveform(contact: &Contact) -> bool {
    let normal = contact.coupling().is_some_and(|measure| !measure.driven.is_empty());
    contact.press.waveform().is_some() || normal || !contact.u.driven.is_empty()
}
