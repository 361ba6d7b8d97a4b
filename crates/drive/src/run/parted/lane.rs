//! One part of a run of parts.

use super::UNLIMITED;
use super::calendar::Scout;
use super::sheet::Sheet;
use crate::model::Part;
use crate::record::Record;
use crate::run::horizon::Goal;
use crate::run::located::LocatedRun;
use crate::run::output::Opening;
use crate::run::steady::AGREEING;
use crate::state::{State, Stepped, Underway};
use crate::{Limits, Model, Plan, RunError, UntilSteady};
use stickslip_contact::Memory;

/// Springs that take as long as a step without any.
const SPRINGS_PER_STEP: f64 = 1000.0;
/// Contacts that do.
const CONTACTS_PER_STEP: f64 = 10.0;

/// A part, its own run, and what it writes.
pub(super) struct Lane<'m> {
    whole: &'m Model,
    /// Its place among the parts.
    pub(super) place: usize,
    pub(super) part: &'m Part,
    plan: Plan,
    tolerance: f64,
    run: LocatedRun<'m>,
    pub(super) state: State,
    /// Where it stood before a step that is only glanced at.
    saved: State,
    pub(super) sheet: Sheet,
    course: Course,
    /// How the run begins, until something of it is written.
    opening: Opening,
    /// Whether it is where it was to go.
    pub(super) arrived: bool,
    /// What ended it.
    pub(super) fault: Option<RunError>,
    /// Work of an attempt.
    pub(super) weight: f64,
    /// Attempts when it set out last.
    before: u64,
    /// Attempts that were given up.
    given_up: u64,
}

/// What the workspace knows of the state.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Course {
    /// It left the state as it is.
    Live,
    /// Nothing: it has to take the state up.
    Stale,
    /// It takes a step that is only glanced at.
    Glances,
}

impl<'m> Lane<'m> {
    pub(super) fn new(whole: &'m Model, place: usize, plan: &Plan) -> Self {
        let part = &whole.parts[place];
        let steady = |asked: UntilSteady| {
            let (owner, body) = whole.part_of(asked.body).filter(|(owner, _)| *owner == place)?;
            Some(UntilSteady { waveform: whole.waveform_in(owner, asked.waveform)?, body, ..asked })
        };
        let plan = Plan { until_steady: plan.until_steady.and_then(steady), limits: UNLIMITED, ..*plan };
        let tolerance = part.model.tolerance(plan.stepper);
        let contacts = &part.model.contacts;
        let springs: usize = contacts.iter().map(|contact| contact.engine.springs()).sum();
        let state = part.model.rest();
        let mut saved = state.clone();
        saved.memories.iter_mut().for_each(Memory::make_room);
        Self {
            whole,
            place,
            part,
            plan,
            tolerance,
            run: LocatedRun::new(&part.model, &plan, tolerance),
            state,
            saved,
            sheet: Sheet::new(part, &()),
            course: Course::Stale,
            opening: Opening::Resumed,
            arrived: false,
            fault: None,
            weight: 1.0 + contacts.len() as f64 / CONTACTS_PER_STEP + springs as f64 / SPRINGS_PER_STEP,
            before: 0,
            given_up: 0,
        }
    }

    /// Begins with its share of the whole.
    pub(super) fn begin(&mut self, whole: &State, opening: Opening, record: &dyn Record) {
        self.sheet = Sheet::new(self.part, record);
        // The row with which a run begins is asked for as others are.
        self.opening = if opening == Opening::Resumed { opening } else { Opening::Grid };
        self.sheet.go_on_from(whole.t);
        self.take(whole);
    }

    /// Takes its share of the whole.
    pub(super) fn take(&mut self, whole: &State) {
        whole.hand_out(self.whole, self.place, &mut self.state);
        self.state.memories.iter_mut().for_each(Memory::make_room);
        self.course = Course::Stale;
    }

    /// One that runs ahead of it.
    pub(super) fn scout(&self) -> Scout<'m> {
        Scout::new((self.place, self.part), &self.plan, self.tolerance, &self.state)
    }

    /// Sets out into a stretch, within limits on what it may do there.
    pub(super) fn set_out(&mut self, steps: u64, events: u64) {
        let counts = self.state.counts;
        self.before = self.attempts();
        self.run.limit(Limits {
            steps: self.before.saturating_add(steps),
            events: counts.events.saturating_add(events),
            wall: None,
        });
        if self.course == Course::Stale || self.sheet.begins_anew() {
            self.sheet.begin();
            self.run.set_out(&mut self.state, self.opening, &mut self.sheet);
            self.course = Course::Live;
        }
    }

    /// Goes on; false where it paused on the way.
    pub(super) fn go(&mut self, goal: Goal) -> bool {
        if self.fault.is_some() {
            return true;
        }
        self.sheet.refill();
        match self.run.go(&mut self.state, goal, &mut self.sheet) {
            Err(RunError::Interrupted { .. }) => return false,
            // The whole is told when it counts the attempts of all.
            Ok(()) | Err(RunError::TooManySteps { .. }) => {}
            Err(fault) => {
                // That was no glance: it stands there.
                (self.fault, self.course, self.sheet.glances) = (Some(fault), Course::Live, false);
            }
        }
        true
    }

    /// Goes there without a pause.
    pub(super) fn come(&mut self, goal: Goal) {
        while !self.go(goal) {}
    }

    /// Gets ready for the step that leads beyond a time, s, at which it will be read only.
    pub(super) fn prepare_to_glance(&mut self, t: f64) {
        if self.fault.is_none() && self.state.t < t {
            self.saved.copy(&self.state);
            self.run.limit(UNLIMITED);
            (self.course, self.sheet.glances) = (Course::Glances, true);
        }
    }

    /// Whether it takes such a step.
    pub(super) fn glances(&self) -> bool {
        self.course == Course::Glances
    }

    /// Back to before a step that was only glanced at; a stretch is written.
    pub(super) fn turn_back(&mut self) {
        if self.glances() {
            self.hand_over();
            std::mem::swap(&mut self.state, &mut self.saved);
            (self.course, self.sheet.glances) = (Course::Stale, false);
        }
        self.opening = Opening::Resumed;
    }

    /// Forgets a stretch, and goes back to where the whole stands.
    pub(super) fn give_up(&mut self, whole: &State) {
        self.given_up += self.attempts().saturating_sub(self.before);
        self.sheet.give_up();
        self.fault = None;
        self.take(whole);
    }

    /// When its steps have become constant, s, where that is before the end of a stretch.
    pub(super) fn ends(&mut self, stop: Goal) -> Option<f64> {
        let before = self.stepped();
        self.saved.copy(&self.state);
        self.run.limit(UNLIMITED);
        self.run.set_out(&mut self.saved, Opening::Resumed, &mut ());
        // A fault is come to again.
        let outcome = self.run.go(&mut self.saved, Goal::Glance(stop.moment()), &mut ());
        self.course = Course::Stale;
        std::mem::swap(&mut self.state, &mut self.saved);
        let (after, t) = (self.stepped(), self.state.t);
        std::mem::swap(&mut self.state, &mut self.saved);
        let goes_on = before.map_or(f64::NEG_INFINITY, |before| before.next);
        after.filter(|after| outcome.is_ok() && after.agreed >= AGREEING && after.next > goes_on).map(|_| t)
    }

    fn stepped(&self) -> Option<Stepped> {
        match &self.state.underway {
            Some(Underway::Located(way)) => way.steps,
            _ => None,
        }
    }

    /// Attempts so far, without those given up.
    pub(super) fn attempts(&self) -> u64 {
        self.state.counts.steps.saturating_add(self.state.counts.rejected)
    }

    /// Attempts of this stretch.
    pub(super) fn tried(&self) -> u64 {
        self.attempts().saturating_sub(self.before)
    }

    /// All that it has done.
    pub(super) fn work(&self) -> f64 {
        self.weight * self.attempts().saturating_add(self.given_up) as f64
    }

    /// Turning points made or given up.
    pub(super) fn touched(&self) -> u64 {
        self.run.touched()
    }

    /// Tells its sheet how far its body went.
    pub(super) fn hand_over(&mut self) {
        if self.sheet.watches() && self.course != Course::Stale {
            self.run.hand_over(&mut self.sheet);
        }
    }

    /// Writes the row of where it stands.
    pub(super) fn write_now(&mut self) {
        self.sheet.take_any();
        self.run.write_now(&self.state, &mut self.sheet);
    }

    /// Brings memories that wait for an event to where the state is.
    pub(super) fn settle_books(&mut self) {
        self.set_out(u64::MAX, u64::MAX);
        self.run.settle_books(&mut self.state);
    }
}
