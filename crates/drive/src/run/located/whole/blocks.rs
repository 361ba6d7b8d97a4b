//! Blocks on a detour: their states go along with all else, and a step ends where the first of their guards falls.
//!
//! A law of a block is smooth up to its own event only, and no error of a step tells of an event that it has passed. So guards
//! are looked at in the middle and at the end of each half; where one has fallen the moment is found on what the halves are
//! read by, and the step is tried again up to there. What the block does then is what it does between located events.

use super::way::Way;
use super::{Halves, Times};
use crate::RunError;
use crate::contact::{NEARNESS, bands};
use crate::equations::Equations;
use crate::record::Record;
use crate::run::located::Located;
use crate::run::located::watch::Fallen;
use crate::state::State;
use stickslip_stepper::{Attempt, Bracket, Point, root};

/// Moments of a step at which guards are looked at: its start, and the middle and the end of each half.
const LOOKS: usize = 5;

/// When the first guard of a block falls inside a step, s, and whose it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fall {
    pub(super) t: f64,
    k: usize,
    guard: usize,
}

/// What a guard is at the moments looked at, and how near to zero it is as good as there: its deadband first.
struct Looked {
    points: [Point; LOOKS],
    bands: (f64, f64),
}

impl Looked {
    /// The first look at which the guard has fallen below its deadband.
    fn low(&self) -> Option<usize> {
        let start = self.points[0].y;
        (1..LOOKS).find(|i| self.points[*i].y < -self.bands.0 && self.points[*i].y < start)
    }

    /// Between which moments it falls, and through what level: zero, or where it rests at the start of the step and has not risen
    /// since, what lies a deadband below.
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
    /// Tries a step and, where a guard of a block falls inside it, one that ends there. Gives the error of the one tried last, its
    /// times, and the fall. `slides` says that it is taken whatever its error.
    pub(super) fn try_up_to_fall(
        &mut self,
        halves: &mut Halves,
        state: &mut State,
        (times, slides): (Times, bool),
    ) -> Result<(f64, Times, Option<Fall>), RunError> {
        let error = self.try_halves(halves, state, times)?;
        // Of a step that is refused no guard tells when it will fall.
        let refused = error.is_nan() || error > if slides { f64::MAX } else { 1.0 };
        if self.setting.model.blocks.is_empty() || refused {
            return Ok((error, times, None));
        }
        let Some(fall) = self.first_fall_of_blocks(halves, state, times) else {
            return Ok((error, times, None));
        };
        let times = Times::halved(times.from, fall.t);
        // One that falls in the last place of t falls now.
        if !times.moves_on() {
            return Ok((0.0, times, Some(fall)));
        }
        Ok((self.try_halves(halves, state, times)?, times, Some(fall)))
    }

    /// The first guard of a block that falls inside the step just tried.
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

    /// Writes down the guards that have fallen at the end of a step: the one that ends it, whatever its last bit says, and one of every
    /// other block that is down or as good as down there.
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

    /// The laws of blocks at the end of a step, or where a detour begins in the midst of an event: of those whose guards have fallen,
    /// from the `first` in the list on, and, since rates have jumped there or at a corner, of all others.
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

/// The moment at which a guard falls through a level inside a bracket, s.
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
    // As between located events: what is missed by this much tells of no law.
    let within = (0.1 * NEARNESS * tolerance * (to.x - from.x)).max(4.0 * f64::EPSILON * to.x.abs());
    let beyond = |t: f64| {
        let left = value(t) - level;
        if level == 0.0 && left.abs() < near { 0.0 } else { left }
    };
    root(beyond, Bracket { from: above(from), to: above(to) }, within)
}
