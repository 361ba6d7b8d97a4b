//! Next laws of contacts at an event. For blocks see [`block_laws`](super::block_laws).
//!
//! Contact laws change here and, at jumps, in [`turning`](super::turning). After a zero crossing, the next law follows from the event
//! function that has crossed zero and from the motion.
//!
//! At a corner velocities jump. Every contact that the corner moves then gets its law from the new velocities, or from accelerations where
//! velocities vanish. Contacts with a zero crossing at the corner are included.
//!
//! Without contact damping, forces are continuous at every change of law. Accelerations then do not depend on the next laws, and the law of
//! each contact is chosen separately.

use super::Located;
use super::watch::Fallen;
use crate::RunError;
use crate::contact::{Contact, Motion, fired};
use crate::equations::{Components, Equations};
use crate::event::{Event, EventKind, Source};
use crate::model::Measure;
use crate::record::{Entry, EventDetail, Record, wants_events};
use crate::state::State;
use stickslip_contact::{Change, Course, Guard, Interface, Law, Memory, Segment};
use stickslip_stepper::{Attempt, System};

/// Time step of the finite difference of ḋ, as a fraction of the waveform's duration or of the contact's 1/ω.
const BEND_AHEAD: f64 = 1e-5;
/// Time after which a contact at rest has a velocity along its acceleration, s; 2⁻¹⁰⁰, so that no digit is lost.
const INSTANT: f64 = 1.0 / (1_u128 << 100) as f64;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Sets the next law of every component with a zero crossing; after a corner, also of all contacts that the corner moves.
    ///
    /// Components are handled in the order in which their zero crossings were found. Fails if events accumulate or exceed their limit.
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
                        // Step doubling follows: it chooses contact laws again, but does not repeat events of blocks.
                        if matches!(reason, RunError::Zeno { .. }) {
                            self.pass_blocks(state, (i + 1, corner), record)?;
                        }
                        return Err(reason);
                    }
                }
                Fallen::Block(k, guard) => {
                    self.handle_block(state, (k, guard), record)?;
                    // A body may follow the signal of the block, so that velocities jump as at a corner.
                    turns = true;
                }
            }
        }
        // A change of a block's law acts like a corner.
        if turns && !corner {
            self.turning.before.clone_from(&state.modes);
        }
        // Blocks first, because they determine velocities of the contacts.
        if turns && !self.setting.model.blocks.is_empty() {
            self.turn_blocks(state, corner, record)?;
        }
        if turns {
            for c in 0..self.setting.model.contacts.len() {
                // The law that a zero crossing has set uses the slack of its event function. A second choice would lose
                // it, except for a branch that continues in its sense.
                let is_kept = |fallen: &Fallen| matches!(fallen, Fallen::Contact(own, guard) if *own == c && !guard.is_edge());
                if state.modes[c].branch().is_some() || !self.watch.fired.iter().any(is_kept) {
                    self.turn(state, c, record)?;
                }
            }
        } else if self.presses {
            self.turn_damped(state, record)?;
        }
        Ok(())
    }

    /// Whether the next law of a contact with a zero crossing at a corner depends on the velocities after the corner.
    fn is_up_to_corner(&self, c: usize, guard: Guard) -> bool {
        let contact = &self.setting.model.contacts[c];
        guard.is_edge() && !contact.is_never_pressed() && moved_by_waveform(contact)
    }

    /// Sets the law of a contact after a zero crossing of one of its event functions.
    ///
    /// A memory piece that ends in the centre of the contact is reported as the start of gross slip, not as a closed loop.
    fn handle_contact(
        &mut self,
        state: &mut State,
        (c, guard): (usize, Guard),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        if guard == Guard::Gap && contact.normal_damping > 0.0 {
            return self.touch(state, c, record);
        }
        let motion = self.watch.motion_at_end(&self.interval, c, (state.t, &state.y));
        // Rounding of time or of a large displacement may stop before the zero. The remaining length then counts as used up.
        let left = |state: &State| guard.value(contact, state.law(c), &motion).max(0.0);
        if guard.is_lead() {
            // Another event function of the contact chooses the law anew.
            let other = |fallen: &Fallen| matches!(fallen, Fallen::Contact(own, guard) if *own == c && !guard.is_lead());
            if self.watch.fired.iter().any(other) {
                return Ok(());
            }
            let (memory, at) = (&state.memories[c], (&motion, Some((guard, left(state)))));
            state.modes[c].aim_lead(contact, memory, at, self.setting.tolerance);
            return Ok(());
        }
        if let Some(change) = guard.change() {
            let held = state.modes[c].gross();
            let at = (&motion, change, left(state));
            state.modes[c] =
                state.modes[c].relinearised(contact, &state.memories[c], at, self.setting.tolerance);
            return self.pass_limits(state, (c, guard, held), &motion, record);
        }
        let (mut kind, course) = self.after(state, (c, guard), &motion);
        let slack = if guard == Guard::Piece {
            guard.bands(contact, self.setting.tolerance, motion.u).1 + left(state)
        } else {
            0.0
        };
        // The law is set first, because its branch shows whether slip is gross.
        let broke = self.set_law(state, c, (course, &motion), slack);
        if kind == EventKind::LoopClosed && (broke || state.modes[c].is_gross()) {
            kind = contact.gross_slip()[0];
        }
        // A static coefficient that grows leaves the old limit line behind, whose crossing moves nothing.
        if kind != EventKind::LoopClosed || contact.interface.growth().is_none() {
            self.note(state, Source::Contact(c), kind, record);
        }
        self.bounds.event(self.setting.model, state, (Source::Contact(c), kind))?;
        self.note_break(state, (c, broke, kind), record)
    }

    /// Closes a contact with damping along the normal, whose indentation jumps to d + βḋ at constant u.
    fn touch(&mut self, state: &mut State, c: usize, record: &mut dyn Record) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        self.lose_overlap(state, c, false);
        let eq = self.setting.plain(state);
        let mut motion = eq.motion(contact, state.t, |i| state.y[i]);
        // Rounding may end the step before d = 0, where the full force law is still open.
        let [d, rate] = eq.distance(contact, state.t, |i| state.y[i]);
        motion.d = d + contact.normal_damping * rate;
        state.modes[c] = Law::whole(0.0);
        let broke = if motion.d > 0.0 {
            self.press(state, c, motion)?;
            self.decide(state, c)
        } else {
            // The contact closes again where d + βḋ = 0, without a jump.
            let (_, course) = fired(contact, Guard::Gap, &Law::OPEN, &motion);
            self.set_law(state, c, (course, &motion), 0.0)
        };
        self.note(state, Source::Contact(c), EventKind::Touch, record);
        self.bounds.event(self.setting.model, state, (Source::Contact(c), EventKind::Touch))?;
        self.note_break(state, (c, broke, EventKind::Touch), record)
    }

    /// Books the elastic energy of the bodies' overlap as lost when a contact with damping along the normal opens, or as regained when it
    /// closes again.
    ///
    /// An open contact has no elastic energy. The elastic energy of a prescribed indentation is also part of the input, which an open
    /// contact does not take back.
    pub(super) fn lose_overlap(&self, state: &mut State, c: usize, opens: bool) {
        let contact = &self.setting.model.contacts[c];
        let closed = Law::whole(0.0);
        let law = std::mem::replace(&mut state.modes[c], closed);
        let energy =
            contact.count * self.setting.plain(state).normal_energy(contact, state.t, |i| state.y[i]);
        state.modes[c] = law;
        let energy = if opens { energy } else { -energy };
        state.lost += energy;
        if contact.coupling().is_none() {
            state.jumps += energy;
        }
    }

    /// Moves the slip memory of a contact to a motion on a straight path in zero time.
    fn press(&mut self, state: &mut State, c: usize, to: Motion) -> Result<(), RunError> {
        let (contact, path) = (&self.setting.model.contacts[c], Segment::Jump(to.apex()));
        let work = state.memories[c].commit(&contact.interface, path);
        let work = contact.count * work.map_err(|source| self.setting.model.refused(c, state.t, source))?;
        self.ledger.note(self.setting.model, state, c, path);
        state.friction[c] += work;
        Ok(())
    }

    /// Presses contacts with damping along the normal by d + βḋ at the start of a run.
    pub(super) fn press_damped(&mut self, state: &mut State) {
        let contacts = self.setting.model.contacts.iter().filter(|contact| contact.normal_damping > 0.0);
        for contact in contacts {
            let motion = self.setting.plain(state).motion(contact, state.t, |i| state.y[i]);
            if motion.apex() != state.memories[contact.place].apex() {
                // A motion that the memory refuses ends the run at its first step.
                let _ = self.press(state, contact.place, motion);
            }
        }
    }

    /// Chooses the laws of contacts with damping along the normal anew after an event of another contact.
    ///
    /// The rate of d + βḋ depends on accelerations, which jump where another contact touches or breaks loose.
    pub(super) fn turn_damped(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        self.turning.before.clone_from(&state.modes);
        for c in 0..self.setting.model.contacts.len() {
            let own = |fallen: &Fallen| matches!(fallen, Fallen::Contact(own, _) if *own == c);
            let damped = self.setting.model.contacts[c].normal_damping > 0.0;
            if damped && !state.modes[c].is_open() && !self.watch.fired.iter().any(own) {
                self.turn(state, c, record)?;
            }
        }
        Ok(())
    }

    /// Lets static friction coefficients grow up to the present time, and begins the rest of contacts that have stuck again.
    ///
    /// A contact whose coefficient has changed gets its law anew; all slip memories must be committed then. With `laws` false, all
    /// contacts obey the full force law.
    pub(super) fn grow_limits(&mut self, state: &mut State, laws: bool) {
        if !self.jumps {
            return;
        }
        for c in 0..self.setting.model.contacts.len() {
            let law = &self.setting.model.contacts[c].interface;
            if state.memories[c].grow(law, state.t) && laws {
                let (course, motion) = self.next_course(state, c);
                self.set_law(state, c, (course, &motion), 0.0);
            }
        }
        self.horizon.corner = self.next_corner(state);
    }

    /// Returns the next time of a corner of a waveform, or of a growth of a static friction coefficient, s.
    pub(super) fn next_corner(&self, state: &State) -> f64 {
        let grows = |(contact, memory): (&Contact, &Memory)| memory.next_growth(&contact.interface);
        let growth =
            self.setting.model.contacts.iter().zip(&state.memories).filter(|_| self.jumps).map(grows);
        growth.fold(state.next_corner(), f64::min)
    }

    /// Reports that a contact has broken loose in the instant of an event of another kind, or has stuck again in the same instant.
    fn note_break(
        &mut self,
        state: &mut State,
        (c, broke, kind): (usize, bool, EventKind),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        // With a falling load a contact may stick again in the instant in which it breaks loose.
        let kinds =
            [(EventKind::BreaksLoose, true), (EventKind::SticksAgain, state.memories[c].slides() == 0.0)];
        for (other, happens) in kinds {
            if broke && happens && kind != other {
                self.note(state, Source::Contact(c), other, record);
                self.bounds.event(self.setting.model, state, (Source::Contact(c), other))?;
            }
        }
        Ok(())
    }

    /// Lets a row with two friction coefficients break loose or stick again after a change of its springs.
    ///
    /// `held` is the direction of gross slip before the change, or 0.
    fn pass_limits(
        &mut self,
        state: &mut State,
        (c, guard, held): (usize, Guard, f64),
        motion: &Motion,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        let Some(kinetic) = contact.interface.kinetic() else { return Ok(()) };
        let (slides, gross, tolerance) =
            (state.memories[c].slides(), state.modes[c].gross(), self.setting.tolerance);
        let again = |state: &mut State, change: Change| {
            let at = (motion, change, 0.0);
            state.modes[c] = state.modes[c].relinearised(contact, &state.memories[c], at, tolerance);
        };
        let kinds: &[EventKind] = if slides != 0.0 && held == 0.0 || slides == 0.0 && gross != 0.0 {
            // The commit may have passed the limit by rounding.
            if slides == 0.0 {
                state.friction[c] += contact.count * state.memories[c].break_loose(kinetic, gross);
            }
            let sense = state.memories[c].slides();
            if sense * motion.du > kinetic.stick_slope() * motion.dd {
                again(state, Change::Slips(sense));
                &[EventKind::BreaksLoose]
            } else {
                state.memories[c].hold();
                again(state, Change::Any);
                &[EventKind::BreaksLoose, EventKind::SticksAgain]
            }
        } else if slides != 0.0 && guard == Guard::Edge {
            state.memories[c].hold();
            again(state, Change::Any);
            &[EventKind::SticksAgain]
        } else {
            &[]
        };
        for &kind in kinds {
            self.note(state, Source::Contact(c), kind, record);
            self.bounds.event(self.setting.model, state, (Source::Contact(c), kind))?;
        }
        Ok(())
    }

    /// Returns the event and the next course after a zero crossing.
    ///
    /// If d has an extremum while u̇ = 0, the event functions of both slip edges vanish together. Accelerations then
    /// decide, because the order of the zero crossings is due to rounding.
    fn after(&mut self, state: &State, (c, guard): (usize, Guard), motion: &Motion) -> (EventKind, Course) {
        let (contact, old) = (&self.setting.model.contacts[c], &state.modes[c]);
        let fired = fired(contact, guard, old, motion);
        if !guard.is_edge() || contact.is_constant() || !(old.grows() || old.branch().is_some()) {
            return fired;
        }
        if !self.stands(contact, motion) {
            return fired;
        }
        let (dd, du) = self.push(state, c, motion);
        let course = state.memories[c].course(&contact.interface, motion.d, dd, du);
        let kind = match course {
            Course::Open => EventKind::LiftOff,
            Course::Grow if old.grows() => return fired,
            Course::Grow if contact.is_loose(old) => EventKind::SticksAgain,
            Course::Grow => EventKind::FullStick,
            _ if old.grows() => EventKind::SlipBegins,
            _ if course.sense() == old.sense() => return fired,
            _ if old.is_gross() => contact.gross_slip()[1],
            _ => EventKind::Reversal,
        };
        (kind, course)
    }

    /// Whether both slip edges of a contact are at rest: |u̇| and κ|ḋ| are within the near-zero band of [`Guard::Drag`].
    fn stands(&self, contact: &Contact, motion: &Motion) -> bool {
        let (_, near) = Guard::Drag.bands(contact, self.setting.tolerance, motion.u);
        motion.du.abs() <= near && contact.interface.stick_slope() * motion.dd.abs() <= near
    }

    /// Chooses the law of a contact anew after a corner, where velocities jump.
    ///
    /// Reports an event only if the kind of law or the sliding direction changes.
    fn turn(&mut self, state: &mut State, c: usize, record: &mut dyn Record) -> Result<(), RunError> {
        let contact = &self.setting.model.contacts[c];
        if contact.is_never_pressed() || !(moved_by_waveform(contact) || contact.normal_damping > 0.0) {
            return Ok(());
        }
        // The law before a jump, because the jump has set other laws.
        let old = self.turning.before[c];
        // The path bends at a corner, so that later growth is a separate piece.
        state.grew[c] = false;
        let broke = self.decide(state, c);
        let new = state.modes[c];
        let kind = match () {
            () if broke && !old.is_open() => EventKind::BreaksLoose,
            () if old.is_open() && new.is_open() || old.grows() && new.grows() => return Ok(()),
            () if old.is_open() => EventKind::Touch,
            () if new.is_open() => EventKind::LiftOff,
            () if new.grows() && contact.is_loose(&old) => EventKind::SticksAgain,
            () if new.grows() => EventKind::FullStick,
            () if old.grows() => EventKind::SlipBegins,
            () if old.sense() == new.sense() => return Ok(()),
            () if old.is_gross() => contact.gross_slip()[1],
            () => EventKind::Reversal,
        };
        self.note(state, Source::Contact(c), kind, record);
        self.bounds.event(self.setting.model, state, (Source::Contact(c), kind))?;
        self.note_break(state, (c, broke, kind), record)
    }

    /// Sets the law of a contact from its velocities. For a contact at rest, accelerations determine the law.
    ///
    /// Returns whether a contact with two friction coefficients has broken loose.
    pub(super) fn decide(&mut self, state: &mut State, c: usize) -> bool {
        let (course, motion) = self.next_course(state, c);
        let same = course.sense() != 0.0 && course.sense() == state.modes[c].sense();
        if !same || state.modes[c].branch().is_none() {
            return self.set_law(state, c, (course, &motion), 0.0);
        }
        // A branch that continues in its sense keeps its starting point, but the lead jumps with the velocity.
        let contact = &self.setting.model.contacts[c];
        if contact.interface.damping() > 0.0 {
            state.modes[c].aim_lead(contact, &state.memories[c], (&motion, None), self.setting.tolerance);
        }
        false
    }

    /// Returns the course of a contact, with its motion. For a contact at rest it is the motion an instant later.
    fn next_course(&mut self, state: &State, c: usize) -> (Course, Motion) {
        let contact = &self.setting.model.contacts[c];
        let eq = self.setting.plain(state);
        let mut motion = eq.motion(contact, state.t, |i| state.y[i]);
        // Near zero the signs of velocities mean nothing, and the following accelerations decide.
        if self.stands(contact, &motion) {
            let (dd, du) = self.push(state, c, &motion);
            (motion.dd, motion.du) = (dd * INSTANT, du * INSTANT);
        }
        (state.memories[c].course(&contact.interface, motion.d, motion.dd, motion.du), motion)
    }

    /// Returns the direction in (d, u) in which a contact at rest begins to move.
    ///
    /// The result is the direction of the acceleration. If the acceleration is only rounding, the remaining velocity gives the direction,
    /// or else the present sense of slip. Accelerations below 1e-12 of u_cω² count as rounding.
    fn push(&mut self, state: &State, c: usize, motion: &Motion) -> (f64, f64) {
        let contact = &self.setting.model.contacts[c];
        let eq = self.setting.plain(state);
        // Without closed forms, which belong to the previous laws.
        let slopes = &mut self.output.components;
        eq.slopes(state.t, &state.y, slopes);
        let of = |measure: &Measure| {
            let at = Components { t: state.t, y: |i: usize| state.y[i] };
            eq.acceleration(measure, &at, |i| slopes[self.setting.layout.velocity(i)])
        };
        let (bend, pull) = (contact.coupling().map(of), of(&contact.u));
        let bend = bend.unwrap_or_else(|| self.bend(state, contact));
        // Rounding error of the forces, as an acceleration in the contact's natural scale.
        let noise = 1e-12 * contact.natural_velocity() * contact.natural.frequency;
        let pull = if pull.abs() > noise { pull } else { 0.0 };
        if pull.abs().max(contact.interface.stick_slope() * bend.abs()) > noise {
            (bend, pull)
        } else if motion.du != 0.0 {
            (motion.dd, motion.du)
        } else {
            // Nothing decides, so the sense stays.
            (motion.dd, state.modes[c].sense())
        }
    }

    /// Returns d̈ of a contact that a waveform presses, m/s²: the finite difference of ḋ on the waveform's piece.
    fn bend(&self, state: &State, contact: &Contact) -> f64 {
        let Some(w) = contact.press.waveform() else { return 0.0 };
        let eq = self.setting.plain(state);
        let extent = self.setting.model.waveforms[w].extent();
        let ahead = BEND_AHEAD * extent.min(contact.natural.frequency.recip());
        let rate = |t: f64| eq.motion(contact, t, |i| state.y[i]).dd;
        (rate(state.t + ahead) - rate(state.t)) / ahead
    }

    /// Sets the law of a contact. For growth in full stick, also sets the initial force and energy.
    ///
    /// `slack` (m) is the remaining length of a memory piece that counts as used up. The step length before gross slip
    /// is stored and used again afterwards, because steps in gross slip become too long for the next law.
    ///
    /// Returns whether a contact with two friction coefficients has broken loose.
    pub(super) fn set_law(
        &self,
        state: &mut State,
        c: usize,
        (course, at): (Course, &Motion),
        slack: f64,
    ) -> bool {
        let contact = &self.setting.model.contacts[c];
        // A constant load keeps the contact closed; without motion it begins forward.
        let course = if course == Course::Open && contact.is_constant() && state.memories[c].apex().d > 0.0 {
            Course::Forward
        } else {
            course
        };
        // Read before the law changes.
        let (was_gross, was_open) = (state.modes[c].is_gross(), state.modes[c].is_open());
        let kinetic = contact.interface.kinetic();
        // The commit may have passed the limit by rounding.
        let mut broke = state.memories[c].slides() != 0.0 && state.modes[c].gross() == 0.0;
        if kinetic.is_some_and(|kinetic| stops(contact, kinetic, &state.memories[c], (course, at))) {
            state.memories[c].hold();
        }
        let law =
            |memory: &Memory, course| Law::of(contact, memory, (course, at), slack, self.setting.tolerance);
        state.modes[c] = law(&state.memories[c], course);
        if let Some(kinetic) = kinetic
            && state.memories[c].slides() == 0.0
            && state.modes[c].gross() != 0.0
        {
            let memory = &mut state.memories[c];
            state.friction[c] += contact.count * memory.break_loose(kinetic, state.modes[c].gross());
            broke = true;
            let course = memory.course(&contact.interface, at.d, at.dd, at.du);
            if stops(contact, kinetic, memory, (course, at)) {
                memory.hold();
            }
            state.modes[c] = law(memory, course);
        }
        state.grew[c] = false;
        if contact.normal_damping > 0.0 && was_open != state.modes[c].is_open() {
            self.lose_overlap(state, c, !was_open);
        }
        match (was_gross, state.modes[c].is_gross()) {
            (false, true) if state.step > 0.0 => state.stuck_step = state.step,
            (true, false) => state.step = state.step.min(state.stuck_step),
            _ => {}
        }
        if contact.balanced {
            self.carry(state, c);
        }
        if let Some(slot) = contact.slot.filter(|_| state.modes[c].grows()) {
            // Force and energy begin at those of the slip memory; the slopes add to them.
            let now = state.memories[c].preview(&contact.interface, state.memories[c].apex());
            state.y[self.setting.layout.force(slot)] = now.force;
            state.y[self.setting.layout.elastic(slot)] = now.elastic;
        }
        broke
    }

    /// Counts an event and reports it to the record.
    ///
    /// Events are counted without a record, too, because output does not change the state.
    #[inline(always)]
    pub(super) fn note(
        &mut self,
        state: &mut State,
        source: Source,
        kind: EventKind,
        record: &mut dyn Record,
    ) {
        state.counts.events += 1;
        if wants_events(record) {
            self.tell(state, (source, kind), record);
        }
    }

    /// Reports the spring rows that have begun or ended gross slip in the last step. These events are not counted.
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
        if record.wants().events == EventDetail::Rows {
            self.output.event(&self.setting.plain(state), state, &event, record);
        } else {
            record.take(Entry::Event(&event, &[]));
        }
    }
}

/// Returns whether a contact that slides at its kinetic limit sticks again with a motion.
fn stops(contact: &Contact, kinetic: &Interface, memory: &Memory, (course, at): (Course, &Motion)) -> bool {
    let slides = memory.slides();
    // The course of a row is the direction of u alone.
    let goes = match contact.engine.branches() {
        true => course.sense() == slides,
        false => slides * at.du > kinetic.stick_slope() * at.dd,
    };
    slides != 0.0 && !goes
}

/// Whether a corner of any waveform directly changes the velocities of a contact.
fn moved_by_waveform(contact: &Contact) -> bool {
    let normal = contact.coupling().is_some_and(|measure| !measure.driven.is_empty());
    contact.press.waveform().is_some() || normal || !contact.u.driven.is_empty()
}
