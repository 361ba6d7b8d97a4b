//! A run of parts that feel nothing of each other: each by its own method and its own steps.
//!
//! The parts go on side by side in stretches of time. Between two stretches every part stands between two whole steps, at most
//! one step before where the whole stands, and all up to there is written. The step that leads a part beyond a stretch is only
//! glanced at, for what is to be read up to there, and taken again in the next: so where stretches end changes no bit, and a
//! run that is put down there goes on as if it had never been. Where events are written the scouts of a [`Calendar`] run ahead of the parts,
//! since the row of an event has the channels of all of them.

mod calendar;
mod cores;
mod lane;
mod merged;
mod rows;
mod sheet;
#[cfg(test)]
mod tests;

use super::horizon::Goal;
use super::output::Opening;
use crate::Wall;
use crate::record::Record;
use crate::state::State;
use crate::{Limits, Model, Plan, RunError};
use calendar::Calendar;
use cores::side_by_side;
use lane::Lane;
use merged::Merged;
use std::num::NonZero;
use std::thread::available_parallelism;
use stickslip_contact::Memory;

/// A first stretch, in periods of the fastest swing: so many, or over the square of the number of parts so many. In it each part has
/// its events, and each of these a row of all.
const FIRST: [f64; 2] = [64.0, 4096.0];
/// By how much stretches lengthen while they are little work.
const GROWTH: f64 = 8.0;
/// Attempts of a stretch, each with its contacts and springs, with which it is long enough: tens of milliseconds.
const WORK: f64 = 8192.0;
/// Attempts of a stretch from which on parts go on several cores: a millisecond of work, in which threads begin many times.
const SHARED: f64 = 1024.0;
/// Numbers of rows that are as much work as an attempt. They are kept until all parts have theirs.
const NUMBERS: f64 = 512.0;
/// Most rows of a stretch: they are kept until all parts have theirs.
const ROWS: f64 = 4096.0;
/// How often a stretch that is beyond the limit of steps is tried again shorter.
const TRIES: u32 = 6;
/// No limit: of what is taken again, or brings parts to one time.
const UNLIMITED: Limits = Limits { steps: u64::MAX, events: u64::MAX, wall: None };

/// Workspace of a run of parts.
pub(super) struct Parted<'m> {
    model: &'m Model,
    limits: Limits,
    /// Interval of the rows, s.
    every: Option<f64>,
    lanes: Vec<Lane<'m>>,
    calendar: Calendar<'m>,
    /// The part whose steps may end the run.
    leader: Option<usize>,
    merged: Merged,
    begun: Wall,
    /// Length of the next stretch, s.
    span: f64,
    /// Work of rows so far.
    written: f64,
    /// Work with which the record was asked last whether to go on.
    asked: f64,
    /// Whether the last stretch was enough work to share among cores, and among how many: all there are, if nobody said.
    is_busy: bool,
    threads: Option<usize>,
}

impl<'m> Parted<'m> {
    pub(super) fn new(model: &'m Model, plan: &Plan) -> Self {
        let leader = plan.until_steady.and_then(|steady| Some(model.part_of(steady.body)?.0));
        let lanes = (0..model.parts.len()).map(|k| Lane::new(model, k, plan)).collect();
        let fastest = model.parts.iter().map(|part| part.model.fastest).fold(0.0, f64::max);
        let quickest = model.waveforms.iter().map(crate::Waveform::quickest).fold(f64::INFINITY, f64::min);
        let natural = if fastest > 0.0 { std::f64::consts::TAU / fastest } else { quickest };
        Self {
            model,
            limits: plan.limits,
            every: plan.every,
            lanes,
            calendar: Calendar::new(),
            leader,
            merged: Merged::new(model),
            begun: Wall::begin(plan.limits.wall.is_some()),
            // Where nothing swings and no waveform is quick time itself tells.
            span: (FIRST[0].min(FIRST[1] / (model.parts.len() as f64).powi(2)) * natural).min(plan.duration),
            written: 0.0,
            is_busy: false,
            threads: None,
            asked: 0.0,
        }
    }

    /// How many turning points a contact remembers.
    pub(super) fn remembers(&self) -> usize {
        Memory::DEFAULT_CAPACITY
    }

    /// Threads that the next stretch is worth. The machine is asked only then: that takes as long as four events do.
    fn threads(&self) -> usize {
        let all = || available_parallelism().map_or(1, NonZero::get);
        if self.is_busy { self.threads.unwrap_or_else(all) } else { 1 }
    }

    /// Takes up a state: begins a run there, or goes on with one.
    pub(super) fn set_out(&mut self, whole: &mut State, opening: Opening, record: &mut dyn Record) {
        whole.carry_over(self.model, self.model.layout());
        whole.divide(self.model);
        self.merged.set_out((self.every, whole.t), opening, record);
        self.lanes.iter_mut().for_each(|lane| lane.begin(whole, opening, record));
        self.send_scouts(record);
        // What earlier runs have done is no work of this one.
        self.asked = self.work();
    }

    /// Every call may bring another record.
    fn send_scouts(&mut self, record: &dyn Record) {
        let wants_events = record.wants_events();
        self.lanes.iter_mut().for_each(|lane| lane.sheet.wants_events = wants_events);
        self.calendar.send(&self.lanes, wants_events);
    }

    /// Goes as far as a goal says, and puts down in the state what its future depends on.
    ///
    /// A part that fails at a time ends the run there: the others come to that time. Halted, the whole stands where its last
    /// stretch ended.
    pub(super) fn go(
        &mut self,
        whole: &mut State,
        mut goal: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let (mut tries, mut is_known) = (0, self.leader.is_none());
        self.send_scouts(record);
        self.merged.end_at(goal.last_row());
        if self.merged.opens_at(whole.t) {
            self.stretch(whole, Goal::Glance(whole.t), record)?;
        }
        while whole.t < goal.moment() {
            if whole.counts.steps + whole.counts.rejected >= self.limits.steps {
                return Err(RunError::TooManySteps { t: whole.t, limit: self.limits.steps });
            }
            let mut stop = self.stop(whole.t, goal);
            if let Some(end) = self.leader.filter(|_| !is_known).and_then(|k| self.lanes[k].ends(stop)) {
                goal = if let Goal::End(_) = goal { Goal::End(end) } else { Goal::BeforeEnd(end) };
                (stop, is_known) = (goal, true);
                self.merged.end_at(goal.last_row());
            }
            let (from, before) = (whole.t, self.work());
            if before - self.asked > SHARED {
                self.asked = before;
                halted(self.begun, self.limits, whole.t, record)?;
            }
            match self.stretch(whole, stop, record) {
                // As near to the limit as a few stretches come.
                Err(RunError::TooManySteps { .. }) if tries < TRIES => {
                    self.span = (stop.moment() - from) / GROWTH;
                    tries += 1;
                    continue;
                }
                outcome => outcome?,
            }
            let work = self.work() - before;
            self.is_busy = work > SHARED;
            self.span =
                if GROWTH * work < WORK { GROWTH * self.span } else { self.span * (WORK / work).min(GROWTH) };
            if stop == goal {
                break;
            }
        }
        Ok(())
    }

    /// The end of the next stretch: the goal, or a moment that is not beyond what the record wants to see.
    fn stop(&self, t: f64, goal: Goal) -> Goal {
        let longest = self.every.map_or(f64::INFINITY, |every| ROWS * every);
        let end = (t + self.span.min(longest)).min(self.merged.wanted());
        // Time must be able to tell both ends apart.
        if end > t && end < goal.moment() { Goal::Glance(end) } else { goal }
    }

    /// Attempts so far, each with what it has to go through, and rows.
    fn work(&self) -> f64 {
        self.lanes.iter().map(Lane::work).sum::<f64>() + self.calendar.work(&self.lanes) + self.written
    }

    /// One stretch of all parts: ahead for their events, on, and written up to its end.
    fn stretch(&mut self, whole: &mut State, stop: Goal, record: &mut dyn Record) -> Result<(), RunError> {
        let outcome = self.move_on(whole, stop, record);
        if let Err(halt) = outcome {
            // As if the stretch had not been tried.
            self.lanes.iter_mut().for_each(|lane| lane.give_up(whole));
            return Err(halt);
        }
        let (t, fault) = match self.fault(whole) {
            Some((t, fault)) => (t.max(whole.t), Some(fault)),
            None => (outcome?, None),
        };
        self.written += self.lanes.iter().map(|lane| lane.sheet.numbers()).sum::<usize>() as f64 / NUMBERS;
        self.merged.write(&mut self.lanes, t, record);
        self.put_down(whole, t);
        if let Goal::Moment(_) = stop {
            // The last steps were cut, and what follows has other bits than the scouts foresee.
            self.calendar.call_back(&self.lanes);
        }
        self.calendar.forget(t);
        fault.map_or(Ok(()), Err)
    }

    /// Moves all parts on; gives the time up to which all of them can be read. Fails where the run is halted.
    fn move_on(&mut self, whole: &State, stop: Goal, record: &mut dyn Record) -> Result<f64, RunError> {
        // Before an end the parts stop where they like: none knows up to when the others need its events.
        self.calendar.choose(&self.lanes, matches!(stop, Goal::BeforeEnd(_)));
        self.look_ahead(whole, stop.moment(), record)?;
        let first = self.calendar.first;
        if let Some(k) = first {
            self.part_goes(|part| part == k, whole, stop, record)?;
            self.calendar.note_events(&self.lanes[k], stop.moment());
        }
        self.part_goes(|part| Some(part) != first, whole, stop, record)?;
        let tried = whole.counts.steps + whole.counts.rejected;
        if self.lanes.iter().map(Lane::tried).fold(0, u64::saturating_add)
            >= self.limits.steps.saturating_sub(tried)
        {
            return Err(RunError::TooManySteps { t: whole.t, limit: self.limits.steps });
        }
        Ok(self.reached(whole, stop))
    }

    /// The time up to which all parts that have set out can be read.
    fn reached(&self, whole: &State, stop: Goal) -> f64 {
        match stop {
            Goal::BeforeEnd(_) => self.lanes.iter().map(|lane| lane.state.t).fold(whole.t, f64::max),
            _ => stop.moment(),
        }
    }

    /// Moves some of the parts on.
    fn part_goes(
        &mut self,
        goes: impl Fn(usize) -> bool + Sync,
        whole: &State,
        stop: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let tried = whole.counts.steps + whole.counts.rejected;
        let steps = self.limits.steps.saturating_sub(tried);
        let events = self.limits.events.saturating_sub(whole.counts.events);
        for (k, lane) in self.lanes.iter_mut().enumerate().filter(|(k, _)| goes(*k)) {
            self.merged.ask(lane, self.calendar.moments_of(k), (whole.t, stop.moment()));
            lane.set_out(steps, events);
        }
        let first = if let Goal::Glance(t) = stop { Goal::Before(t) } else { stop };
        self.drive(|k, _| goes(k).then_some(first), whole.t, record)?;
        if matches!(stop, Goal::BeforeEnd(_) | Goal::Glance(_)) {
            let t = self.reached(whole, stop);
            let going = self.lanes.iter_mut().enumerate().filter(|(k, _)| goes(*k));
            going.for_each(|(_, lane)| lane.prepare_to_glance(t));
            self.drive(|k, lane| (goes(k) && lane.glances()).then_some(Goal::Glance(t)), whole.t, record)?;
        }
        Ok(())
    }

    /// Lets scouts find out when the events of a stretch are.
    fn look_ahead(&mut self, whole: &State, until: f64, record: &mut dyn Record) -> Result<(), RunError> {
        let threads = self.threads();
        while !self.calendar.pass(threads, until) {
            halted(self.begun, self.limits, whole.t, record)?;
        }
        self.calendar.note((whole.t, until));
        Ok(())
    }

    /// Lets every part go where it is to go; each pauses now and then, so that whoever watches the run is asked in time.
    fn drive(
        &mut self,
        goal: impl Fn(usize, &Lane<'_>) -> Option<Goal> + Sync,
        t: f64,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let threads = self.threads();
        self.lanes.iter_mut().for_each(|lane| lane.arrived = false);
        loop {
            side_by_side(threads, &mut self.lanes, |lane| {
                lane.arrived = lane.arrived || goal(lane.place, lane).is_none_or(|goal| lane.go(goal));
            });
            if self.lanes.iter().all(|lane| lane.arrived) {
                return Ok(());
            }
            halted(self.begun, self.limits, t, record)?;
        }
    }

    /// The first fault of a part and its time, to which all others have come.
    fn fault(&mut self, whole: &State) -> Option<(f64, RunError)> {
        let mut known = f64::INFINITY;
        loop {
            let failed = self.lanes.iter().enumerate().filter(|(_, lane)| lane.fault.is_some());
            let (first, t) = failed.map(|(k, lane)| (k, lane.state.t)).min_by(|a, b| a.1.total_cmp(&b.1))?;
            if t >= known {
                let fault = self.lanes[first].fault.take()?;
                let fault = match fault {
                    RunError::TooManyEvents { t, .. } => {
                        RunError::TooManyEvents { t, limit: self.limits.events }
                    }
                    fault => fault,
                };
                self.lanes.iter_mut().for_each(|lane| lane.fault = None);
                return Some((t, fault));
            }
            known = t;
            for (_, lane) in self.lanes.iter_mut().enumerate().filter(|(k, _)| *k != first) {
                lane.give_up(whole);
                lane.set_out(u64::MAX, u64::MAX);
                lane.come(Goal::End(t));
            }
        }
    }

    /// Puts all parts down in the state of the whole, which stands at time t.
    fn put_down(&mut self, whole: &mut State, t: f64) {
        for (k, lane) in self.lanes.iter_mut().enumerate() {
            lane.turn_back();
            whole.take_in(self.model, k, &lane.state);
        }
        whole.sum_up(self.model, t);
    }

    /// Brings all parts to where the whole stands, which ends the run there.
    pub(super) fn level(&mut self, whole: &mut State) {
        let t = whole.t;
        for lane in self.lanes.iter_mut().filter(|lane| lane.state.t < t) {
            lane.set_out(u64::MAX, u64::MAX);
            // Where it cannot come further it stands as near as it came.
            lane.come(Goal::End(t));
            lane.fault = None;
        }
        self.put_down(whole, t);
    }

    /// Writes the row of where the run stopped.
    pub(super) fn write_now(&mut self, whole: &mut State, record: &mut dyn Record) {
        self.level(whole);
        self.lanes.iter_mut().for_each(Lane::write_now);
        self.merged.write_now(&mut self.lanes, whole.t, record);
    }

    /// Tells the range of a watched body so far.
    pub(super) fn hand_over(&mut self, record: &mut dyn Record) {
        self.merged.tell_range(&mut self.lanes, record);
    }

    /// Turning points of contacts made or given up.
    pub(super) fn touched(&self) -> u64 {
        self.lanes.iter().map(Lane::touched).sum()
    }

    /// Brings memories that wait for an event to where the state is.
    pub(super) fn settle_books(&mut self, whole: &mut State) {
        self.lanes.iter_mut().for_each(Lane::settle_books);
        let t = whole.t;
        self.put_down(whole, t);
    }
}

/// Whether time on the wall is over, or the record wants no more.
fn halted(begun: Wall, limits: Limits, t: f64, record: &mut dyn Record) -> Result<(), RunError> {
    if let Some(limit) = limits.wall.filter(|limit| begun.elapsed() > *limit) {
        return Err(RunError::OutOfTime { t, limit });
    }
    if record.goes_on(t) { Ok(()) } else { Err(RunError::Interrupted { t }) }
}
