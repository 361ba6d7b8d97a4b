//! What happens at an event: contacts get their next law. Blocks: [`block_laws`](super::block_laws).
//!
//! Laws change here and, for a jump, in [`turning`](super::turning); nowhere else. Of a guard that fell the
//! law after it follows from the guard and the motion; after a corner, where velocities jump, every contact
//! that the corner moves is decided afresh from velocities and, where these vanish, accelerations, also where its
//! guard fell at that very moment. Without contact damping
//! forces are continuous at every change of law: accelerations do not depend on it, and each contact is
//! decided for itself.

use super::Located;
use super::watch::Fallen;
use crate::RunError;
use crate::contact::{Contact, Guard, Mode, Motion};
use crate::equations::{Components, Equations};
use crate::event::{Event, EventKind, Source};
use crate::model::Measure;
use crate::record::Record;
use crate::state::State;
use stickslip_contact::Course;
use stickslip_stepper::{Attempt, System};

/// How far ahead ḋ is looked at for its rate, as a part of the waveform's period and of the contact's.
const BEND_AHEAD: f64 = 1e-5;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Sets the next law of every contact whose guard fell; after a corner, of all contacts it moves.
    ///
    /// Components are handled in the order in which their guards were found. Fails where events accumulate or
    /// their limit is reached.
    pub(super) fn handle_fallen(
        &mut self,
        state: &mut State,
        corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let mut turns = corner;
        for i in 0..self.watch.fired.len() {
            match self.watch.fired[i] {
                Fallen::Contact(c, guard) if corner && self.is_up_to_corner(c, guard) => {}
                Fallen::Contact(c, guard) => {
                    if let Err(reason) = self.handle_contact(state, (c, guard), record) {
                        // A detour that follows looks at contacts afresh, and at no event of a block that has been.
                        if matches!(reason, RunError::Zeno { .. }) {
                            self.pass_blocks(state, (i + 1, corner), record)?;
                        }
                        return Err(reason);
                    }
                }
                Fallen::Block(k, guard) => {
                    self.handle_block(state, (k, guard), record)?;
                    // Its signal may be what a body follows: velocities jump as at a corner.
                    turns = true;
                }
            }
        }
        // What a block makes turns a corner with its law.
        if turns && !corner {
            self.turning.before.clone_from(&state.modes);
        }
        // Before the contacts: their velocities are what blocks make.
        if turns && !self.setting.model.blocks.is_empty() {
            self.turn_blocks(state, corner, record)?;
        }
        if turns {
            for c in 0..self.setting.model.contacts.len() {
                // The law of a row that fell has the slack of its guard, which a second choice would lose. A branch that goes on in its
                // sense keeps it.
                let is_kept = |fallen: &Fallen| matches!(fallen, Fallen::Contact(own, guard) if *own == c && !guard.is_edge());
                if matches!(state.modes[c], Mode::Slip(_)) || !self.watch.fired.iter().any(is_kept) {
                    self.turn(state, c, record)?;
                }
            }
        }
        Ok(())
    }

    /// Whether what follows a guard that fell at the moment of a corner hangs on the velocities after it: an edge that turned just then
    /// goes where the corner sends it.
    fn is_up_to_corner(&self, c: usize, guard: Guard) -> bool {
        let contact = &self.setting.model.contacts[c];
        guard.is_edge() && !contact.is_never_pressed() && moved_by_waveform(contact)
    }

    /// The law of a contact after one of its guards fell.
    ///
    /// A piece that ends in the centre is the start of gross slip: it is written down as such and not as a
    /// loop that closed.
    fn handle_contact(
        &mut self,
        state: &mut State,
        (c, guard): (usize, Guard),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        let motion = self.watch.motion_at_end(&self.interval, c, (state.t, &state.y));
        // Where rounding, of time or of a displacement that has travelled far, stops short of where the guard falls, that counts
        // as reached.
        let left = |state: &State| guard.value(contact, state.law(c), &motion).max(0.0);
        if let Some(change) = guard.change() {
            let at = (&motion, change, left(state));
            state.modes[c] = state.modes[c].lull(contact, &state.memories[c], at, self.setting.tolerance);
            return Ok(());
        }
        let (mut kind, course) = self.after(state, (c, guard), &motion);
        let slack = if guard == Guard::Piece {
            guard.bands(contact, self.setting.tolerance, motion.u).1 + left(state)
        } else {
            0.0
        };
        // The law first: whether the slip is gross is known of the branch that it gives.
        self.set_law(state, c, (course, &motion), slack);
        if kind == EventKind::LoopClosed && state.modes[c].is_gross() {
            kind = EventKind::GrossSlip;
        }
        self.note(state, Source::Contact(c), kind, record);
        self.bounds.event(self.setting.model, state, (Source::Contact(c), kind))
    }

    /// What it means that a guard fell, and the course after it.
    ///
    /// Where d turns while u̇ = 0 the guards of both edges vanish together: then accelerations decide, and not the order in
    /// which rounding has let them fall.
    fn after(&mut self, state: &State, (c, guard): (usize, Guard), motion: &Motion) -> (EventKind, Course) {
        let (contact, old) = (&self.setting.model.contacts[c], &state.modes[c]);
        let fired = guard.fired(contact, old, motion);
        if !guard.is_edge() || contact.is_constant() || !matches!(old, Mode::Slip(_) | Mode::Grow) {
            return fired;
        }
        if !self.stands(contact, motion) {
            return fired;
        }
        let (dd, du) = self.push(state, c, motion);
        let course = state.memories[c].course(&contact.interface, motion.d, dd, du);
        let kind = match (old, course) {
            (_, Course::Open) => EventKind::LiftOff,
            (Mode::Grow, Course::Grow) => return fired,
            (Mode::Grow, _) => EventKind::SlipBegins,
            (_, Course::Grow) => EventKind::FullStick,
            _ if course.sense() == old.sense() => return fired,
            _ if old.is_gross() => EventKind::GrossSlipEnds,
            _ => EventKind::Reversal,
        };
        (kind, course)
    }

    /// Whether neither edge of a contact moves, but for rounding: |u̇| and κ|ḋ| are both within the band of [`Guard::Drag`]
    /// for the distance it has travelled.
    fn stands(&self, contact: &Contact, motion: &Motion) -> bool {
        let (_, near) = Guard::Drag.bands(contact, self.setting.tolerance, motion.u);
        motion.du.abs() <= near && contact.interface.stick_slope() * motion.dd.abs() <= near
    }

    /// Decides afresh what a contact does after a corner, where velocities jump.
    ///
    /// Notes an event only where the kind of law or the sense of sliding changes: a corner that leaves a
    /// contact sliding on is no event of that contact.
    fn turn(&mut self, state: &mut State, c: usize, record: &mut dyn Record) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        if contact.is_never_pressed() || !moved_by_waveform(contact) {
            return Ok(());
        }
        // As it was before a jump, which sets laws for itself.
        let old = self.turning.before[c];
        // The path bends at a corner: growth after it is a piece of its own and joins nothing.
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
        self.bounds.event(self.setting.model, state, (Source::Contact(c), kind))
    }

    /// Decides from velocities what a contact does, and from accelerations where it is at rest.
    pub(super) fn decide(&mut self, state: &mut State, c: usize) {
        let contact = &self.setting.model.contacts[c];
        let eq = self.setting.plain(state);
        let mut motion = eq.motion(contact, state.t, |i| state.y[i]);
        // Within the band velocities have no sign to go by: the accelerations just after the moment decide.
        if self.stands(contact, &motion) {
            (motion.dd, motion.du) = self.push(state, c, &motion);
        }
        let course = state.memories[c].course(&contact.interface, motion.d, motion.dd, motion.du);
        let same = course.sense() != 0.0 && course.sense() == state.modes[c].sense();
        // A branch that goes on in its sense is still anchored where it was.
        if !same || !matches!(state.modes[c], Mode::Slip(_)) {
            self.set_law(state, c, (course, &motion), 0.0);
        }
    }

    /// Where a contact at rest sets out to, as a direction in (d, u): along its acceleration; within round-off of
    /// equilibrium along its remaining velocity, and on in its present sense if there is none.
    ///
    /// d̈ and ü count as rounding below 1e-12 of u_cω².
    fn push(&mut self, state: &State, c: usize, motion: &Motion) -> (f64, f64) {
        let contact = &self.setting.model.contacts[c];
        let eq = self.setting.plain(state);
        // By the general equations: what is known of the interval is of the laws before.
        let slopes = &mut self.output.components;
        eq.slopes(state.t, &state.y, slopes);
        let of = |measure: &Measure| {
            let at = Components { t: state.t, y: |i: usize| state.y[i] };
            eq.acceleration(measure, &at, |i| slopes[self.setting.layout.velocity(i)])
        };
        let (bend, pull) = (contact.coupling().map(of), of(&contact.u));
        let bend = bend.unwrap_or_else(|| self.bend(state, contact));
        // Rounding of the forces, as an acceleration in the contact's own scale.
        let noise = 1e-12 * contact.natural_velocity() * contact.natural.frequency;
        let pull = if pull.abs() > noise { pull } else { 0.0 };
        if pull.abs().max(contact.interface.stick_slope() * bend.abs()) > noise {
            (bend, pull)
        } else if motion.du != 0.0 {
            (motion.dd, motion.du)
        } else {
            // Nothing decides: the mode it had stays.
            (motion.dd, state.modes[c].sense())
        }
    }

    /// d̈ of a contact that a waveform presses, m/s²: the difference of ḋ over a short time on the waveform's piece.
    fn bend(&self, state: &State, contact: &Contact) -> f64 {
        let Some(w) = contact.press.waveform() else { return 0.0 };
        let eq = self.setting.plain(state);
        let extent = self.setting.model.waveforms[w].extent();
        let ahead = BEND_AHEAD * extent.min(contact.natural.frequency.recip());
        let rate = |t: f64| eq.motion(contact, t, |i| state.y[i]).dd;
        (rate(state.t + ahead) - rate(state.t)) / ahead
    }

    /// Sets the law of a contact, and the force and energy it starts to grow with.
    ///
    /// `slack` (m) is how much of a piece of memory may be left and still count as used up. The step in use
    /// is kept from the start of gross slip to its end: steps grow in between to lengths that the law after
    /// it refuses.
    pub(super) fn set_law(&self, state: &mut State, c: usize, (course, at): (Course, &Motion), slack: f64) {
        let contact = &self.setting.model.contacts[c];
        // A contact pressed by a constant load cannot open: without any motion it sets out forward.
        let course = if course == Course::Open && contact.is_constant() && state.memories[c].apex().d > 0.0 {
            Course::Forward
        } else {
            course
        };
        // Read before the law changes: only the passage from one to the other says something of the step.
        let was_gross = state.modes[c].is_gross();
        state.modes[c] = Mode::of(contact, &state.memories[c], (course, at), slack, self.setting.tolerance);
        state.grew[c] = false;
        match (was_gross, state.modes[c].is_gross()) {
            (false, true) if state.step > 0.0 => state.stuck_step = state.step,
            (true, false) => state.step = state.step.min(state.stuck_step),
            _ => {}
        }
        if contact.balanced {
            self.carry(state, c);
        }
        if let (Mode::Grow, Some(slot)) = (state.modes[c], contact.slot) {
            // Force and energy start as what the memory has at its apex: the slopes add to them.
            let now = state.memories[c].preview(&contact.interface, state.memories[c].apex());
            state.y[self.setting.layout.force(slot)] = now.force;
            state.y[self.setting.layout.elastic(slot)] = now.elastic;
        }
    }

    /// Writes an event down.
    ///
    /// Counted whether or not somebody watches: counts are of the state, and output does not change it.
    #[inline(always)]
    pub(super) fn note(
        &mut self,
        state: &mut State,
        source: Source,
        kind: EventKind,
        record: &mut dyn Record,
    ) {
        state.counts.events += 1;
        if record.wants_events() {
            self.tell(state, (source, kind), record);
        }
    }

    /// Tells which rows of springs have come to slip as a whole in the last step, or to stick again. Such events are the record's: nobody
    /// counts them.
    // Apart from the loop, which hardly ever has any.
    #[inline(never)]
    pub(super) fn tell_rows(&mut self, state: &State, record: &mut dyn Record) {
        for k in 0..self.output.rows.count() {
            if let Some(news) = self.output.rows.news(k, self.setting.model, state) {
                self.tell(state, news, record);
            }
        }
    }

    #[inline(never)]
    fn tell(&mut self, state: &State, (source, kind): (Source, EventKind), record: &mut dyn Record) {
        let event = Event { t: state.t, source, kind: self.output.rows.told(source, kind) };
        if record.wants_event_rows() {
            self.output.event(&self.setting.plain(state), state, &event, record);
        } else {
            record.event(&event, &[]);
        }
    }
}

/// Whether a corner of any waveform changes the velocities of this contact directly.
fn moved_by_waveform(contact: &Contact) -> bool {
    let normal = contact.coupling().is_some_and(|measure| !measure.driven.is_empty());
    contact.press.waveform().is_some() || normal || !contact.u.driven.is_empty()
}
