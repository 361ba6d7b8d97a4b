//! Events of blocks during step doubling.
//!
//! The law of a block is smooth only up to its own event, and the error of a step does not detect a missed event. Event functions of blocks
//! are therefore evaluated at the middle and the end of each half step. After a zero crossing, the event is located on the interpolants of
//! the half steps, and the step is repeated up to the event. The block then chooses its next law as in runs with located events.

use super::way::Way;
use super::{Halves, Times};
use crate::RunError;
use crate::equations::Equations;
use crate::record::Record;
use crate::run::located::Located;
use crate::run::located::watch::Fallen;
use crate::state::State;
use stickslip_contact::{NEARNESS, bands};
use stickslip_stepper::{Attempt, Bracket, Point, root};

/// Number of evaluations of an event function in a step: at the start of the step, and at the middle and end of each half step.
const LOOKS: usize = 5;

/// First zero crossing of a block's event function in a step: time (s), index of the block, and event function.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fall {
    pub(super) t: f64,
    k: usize,
    guard: usize,
}

/// Values of an event function in a step, with its deadband and its near-zero band.
struct Looked {
    points: [Point; LOOKS],
    bands: (f64, f64),
}

impl Looked {
    /// Returns the index of the first value below the deadband.
    fn low(&self) -> Option<usize> {
        let start = self.points[0].y;
        (1..LOOKS).find(|i| self.points[*i].y < -self.bands.0 && self.points[*i].y < start)
    }

    /// Returns the bracket of the zero crossing, and the level that the function crosses in this bracket.
    ///
    /// The level is zero. If the function is near zero at the start and has not risen since, the level is one deadband lower.
    fn bracket(&self, low: usize) -> (Bracket, f64) {
        let (dead, near) = self.bands;
        let (start, to) = (self.points[0].y, self.points[low]);
        let armed =
            self.points[..low].iter().rev().find(|point| point.y > if start < near { dead } else { 0.0 });
        match armed {
            Some(from) => (Bracket { from: *from, to }, 0.0),
            None => (Bracket { from: self.points[low - 1], to }, start.min(0.0) - dead),
        }
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Attempts a step. If a block has an event inside the step, attempts a second step that ends at this event.
    ///
    /// Returns the error and the times of the last attempt, and the event. With `breaks`, any finite error of the step is accepted.
    pub(super) fn try_up_to_fall(
        &mut self,
        halves: &mut Halves,
        state: &mut State,
        (times, breaks): (Times, bool),
    ) -> Result<(f64, Times, Option<Fall>), RunError> {
        let error = self.try_halves(halves, state, times)?;
        // A rejected step gives no event time.
        let refused = error.is_nan() || error > if breaks { f64::MAX } else { 1.0 };
        if self.setting.model.blocks.is_empty() || refused {
            return Ok((error, times, None));
        }
        let Some(fall) = self.first_fall_of_blocks(halves, state, times) else {
            return Ok((error, times, None));
        };
        let times = Times::halved(times.from, fall.t);
        // An event within the rounding of t occurs now.
        if !times.moves_on() {
            return Ok((0.0, times, Some(fall)));
        }
        Ok((self.try_halves(halves, state, times)?, times, Some(fall)))
    }

    /// Returns the first event of a block in the attempted step.
    fn first_fall_of_blocks(&self, halves: &mut Halves, state: &State, times: Times) -> Option<Fall> {
        let Halves { half, two, slopes, later, .. } = halves;
        let (from, middle, to) = ((times.from, &*state.y), (times.middle, &**half), (times.to, &**two));
        self.fill_slopes(state, [from, middle], slopes);
        self.fill_slopes(state, [middle, to], later);
        let free = self.setting.layout.free;
        let ways = [Way { from, to: middle, slopes, free }, Way { from: middle, to, slopes: later, free }];
        let eq = self.setting.plain(state);
        let mut first: Option<Fall> = None;
        for (k, wired) in self.setting.model.blocks.iter().enumerate() {
            for &guard in wired.block().guards(&state.blocks[k].law) {
                let value = |t: f64| {
                    let way = &ways[usize::from(t > times.middle)];
                    eq.block_guard(k, guard, t, |i| way.value(i, t))
                };
                let at = |part: f64| times.from + part * (times.to - times.from);
                let moments = [times.from, at(0.25), times.middle, at(0.75), times.to];
                let bands = bands(wired.block().guard_scale(guard), self.setting.tolerance);
                let looked = Looked { points: moments.map(|t| Point { x: t, y: value(t) }), bands };
                let Some(low) = looked.low() else { continue };
                let t = moment(value, looked.bracket(low), (self.setting.tolerance, bands.1));
                if first.is_none_or(|first| t < first.t) {
                    first = Some(Fall { t, k, guard });
                }
            }
        }
        first
    }

    /// Collects the events of blocks at the end of a step.
    ///
    /// These are the event that ends the step, and for every other block one event function that is negative or near zero.
    pub(super) fn note_falls(&mut self, state: &State, halves: &Halves, (times, fall): (Times, Fall)) {
        let fired = &mut self.watch.fired;
        fired.clear();
        fired.push(Fallen::Block(fall.k, fall.guard));
        if !times.moves_on() {
            return;
        }
        let eq = self.setting.plain(state);
        for (k, wired) in self.setting.model.blocks.iter().enumerate().filter(|(k, _)| *k != fall.k) {
            let (block, y) = (wired.block(), &halves.two);
            let falls = |guard: &&usize| {
                let (dead, near) = bands(block.guard_scale(**guard), self.setting.tolerance);
                let before = eq.block_guard(k, **guard, times.from, |i| state.y[i]);
                let now = eq.block_guard(k, **guard, times.to, |i| y[i]);
                now < before.min(near) && (now < -dead || before >= near)
            };
            if let Some(guard) = block.guards(&state.blocks[k].law).iter().find(falls) {
                fired.push(Fallen::Block(k, *guard));
            }
        }
    }

    /// Changes the laws of blocks at the end of a step, or at the start of step doubling during the handling of an event.
    ///
    /// Handles the zero crossings from index `first` on. After a block event or at a corner, rates have jumped, and all other blocks choose
    /// their laws again.
    pub(in crate::run::located) fn pass_blocks(
        &mut self,
        state: &mut State,
        (first, corner): (usize, bool),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        for i in first..self.watch.fired.len() {
            if let Fallen::Block(k, guard) = self.watch.fired[i] {
                self.handle_block(state, (k, guard), record)?;
            }
        }
        let turns = corner || self.watch.fired.iter().any(|fallen| matches!(fallen, Fallen::Block(..)));
        if turns { self.turn_blocks(state, corner, record) } else { Ok(()) }
    }
}

/// Returns the time at which an event function crosses a level inside a bracket, s.
fn moment(
    value: impl Fn(f64) -> f64,
    (bracket, level): (Bracket, f64),
    (tolerance, near): (f64, f64),
) -> f64 {
    let Bracket { from, to } = bracket;
    let above = |point: Point| Point { y: point.y - level, ..point };
    if to.y >= level || from.y <= level {
        return to.x;
    }
    // The accuracy is that of located events.
    let within = (0.1 * NEARNESS * tolerance * (to.x - from.x)).max(4.0 * f64::EPSILON * to.x.abs());
    let beyond = |t: f64| {
        let left = value(t) - level;
        if level == 0.0 && left.abs() < near { 0.0 } else { left }
    };
    root(beyond, Bracket { from: above(from), to: above(to) }, within)
}
