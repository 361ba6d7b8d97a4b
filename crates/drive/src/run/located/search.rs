//! Finding the first guard that falls inside a step.
//!
//! An event is the first instant of the half-open interval (t₀, t₁] at which a guard falls through zero by more than its
//! deadband; t₀ never belongs to the step that begins there, so that the event just handled does not fire again. A guard
//! that is down at the end of the step has fallen; one that is up at both ends may have dipped: of a function that its values
//! and rates at both ends tell, the lowest point of the cubic through them is looked at, of any other one three moments
//! inside. The moment itself is a bracketed root on the dense output, which costs no evaluation once that is there.
//!
//! What falls at the same moment, or is as good as down there, is one event: all of it fires before any law is chosen.

mod meeting;
mod reading;
mod side;

use super::watch::{Moving, Watch};
use super::watched::Watched;
use crate::contact::{Guard, Motion, NEARNESS};
use crate::equations::Equations;
use crate::interval::Closed;
use arrayvec::ArrayVec;
use stickslip_stepper::{Attempt, Bracket, Completion, Cubic, Point, root, root_near};

/// A guard that falls inside the step just attempted, and when, s.
#[derive(Clone, Copy)]
pub(super) struct Fall<'e> {
    pub(super) t: f64,
    watched: Watched<'e>,
}

/// What is looked through: the step tried, and the contacts at both its ends.
struct Search<'r, 'e, A> {
    from: &'r [Moving],
    to: &'r [Moving],
    tolerance: f64,
    solver: &'r mut A,
    eq: &'r Equations<'e>,
    /// Whether it ends where it was cut: slopes are not known there.
    is_cut: bool,
    /// What was seen of the contact under way inside the step.
    seen: ArrayVec<Seen, { LOOKS.len() + side::EARLY.len() }>,
}

/// The motion of a contact at a part of the step.
struct Seen {
    contact: usize,
    part: f64,
    motion: Motion,
}

/// Places inside a step at which guards are looked at whose course is no polynomial of low degree.
// Seven looks or one see the same but for a few events of contacts that grow under a sine of load.
const LOOKS: [f64; 3] = [0.25, 0.5, 0.75];
/// A guard that is up at both ends is looked at inside the step where the cubic comes below this part of the lower one.
const DIPS_TO: f64 = 0.1;
/// How often a step is halved in search of a moment at which a guard that rested at its start is armed.
const HALVINGS: u32 = 40;
/// How often an earlier fall is looked for from an end that was found. Two guards of whose values only rounding is left lead each other
/// back by a last place of t at a time, in a scene of extreme numbers thousands of times.
const EARLIER: u32 = 64;

impl Watch {
    /// The earliest fall in the step just attempted, on its dense output.
    #[inline(always)]
    pub(super) fn first_fall<'e, A: for<'q> Attempt<Equations<'q>>>(
        &mut self,
        solver: &mut A,
        eq: &Equations<'e>,
    ) -> Option<Fall<'e>> {
        let Self { from, to, near, tolerance, .. } = self;
        let mut search =
            Search { from, to, tolerance: *tolerance, solver, eq, is_cut: false, seen: ArrayVec::new() };
        search.gather(near);
        search.first_fall(near)
    }

    /// Ends the step where a guard falls, or where one does that is up at both ends of the step but down there, such as that of a
    /// piece of memory that an edge has used up before it turns back: that one came first. Collected are the guard that ends the
    /// step, whatever its last bit says, and all others that are down or as good as down there: simultaneous events are one.
    ///
    /// Where something fades within steps, errors are allowed of it, and the cut is met as exactly as an end.
    pub(super) fn end_at<'e, A: for<'q> Attempt<Equations<'q>>>(
        &mut self,
        (solver, fading): (&mut A, Option<&Vec<f64>>),
        eq: &Equations<'e>,
        mut fall: Fall<'e>,
    ) {
        for round in 0.. {
            let is_cut = fall.t < solver.span().end_time;
            if is_cut {
                match fading {
                    Some(scale) => self.meet((solver, scale), eq, &mut fall),
                    None => solver.cut(fall.t),
                }
                self.arrive_at_cut(eq, solver);
            }
            let Self { from, to, near, tolerance, fired, .. } = self;
            let search =
                Search { from, to, tolerance: *tolerance, solver, eq, is_cut: true, seen: ArrayVec::new() };
            fired.clear();
            fired.push(fall.watched.fallen());
            // Of many contacts hardly ever another one is: then this one look at them is all.
            if !search.has_company(fall, near) {
                return;
            }
            if is_cut
                && round < EARLIER
                && let Some(earlier) = search.before(fall, near)
            {
                fall = earlier;
                continue;
            }
            return Watched::each(eq, near, |watched| {
                let known = || fired.iter().any(|fallen| fallen.is_of(&watched.fallen()));
                if search.falls_too(watched) && !known() {
                    fired.push(watched.fallen());
                }
            });
        }
    }
}

impl<'e, A: for<'q> Attempt<Equations<'q>>> Search<'_, 'e, A> {
    /// Puts down which contacts of closed form have to be looked at: see [`is_far`](Self::is_far).
    #[inline(always)]
    fn gather(&self, near: &mut Vec<usize>) {
        near.clear();
        let Some(interval) = self.eq.interval else { return };
        let third = (self.solver.span().end_time - self.solver.span().time) / 3.0;
        for (place, steady) in interval.closed.iter().enumerate() {
            if !steady.guards.is_empty() && !self.is_far(steady, third) {
                near.push(place);
            }
        }
    }

    /// Whether all guards of a contact of closed form stay up through the step, farther from zero than counts as there: its edge goes on
    /// dragging, as the control points of the speed's cubic show, and its piece of memory outlasts the step. `third` of the step, s.
    // Of many contacts nearly all are, at nearly every step; guard by guard they are asked three times as much.
    #[inline(always)]
    fn is_far(&self, steady: &Closed<'_>, third: f64) -> bool {
        let (from, to) = (&self.from[steady.index], &self.to[steady.index]);
        let sense = steady.sense();
        let speeds = [sense * from.motion.du, sense * to.motion.du];
        let turns = third * sense;
        let between = [speeds[0] + turns * from.second.1, speeds[1] - turns * to.second.1];
        let slowest = speeds.into_iter().chain(between).fold(f64::INFINITY, f64::min);
        let (_, close) = Guard::Piece.bands(steady.contact, self.tolerance, from.motion.u);
        slowest > (DIPS_TO * speeds[0].min(speeds[1])).max(close * steady.contact.natural.frequency)
            && steady.margin(to.motion.u) > close
    }

    /// The earliest fall in the step just attempted, on its dense output.
    #[inline(always)]
    fn first_fall(&mut self, near: &[usize]) -> Option<Fall<'e>> {
        let mut first: Option<Fall<'e>> = None;
        Watched::each(self.eq, near, |watched| {
            let g1 = self.at_end(watched);
            let low = if g1 < 0.0 && self.has_fallen(watched, g1) {
                Some((self.solver.span().end_time, g1))
            } else {
                self.dip(watched, g1)
            };
            let Some(low) = low else { return };
            if first.is_some_and(|first| self.comes_later(watched, low.0, first.t)) {
                return;
            }
            self.solver.complete(self.eq, Completion::Dense);
            let t = self.fall(watched, low);
            if first.is_none_or(|first| t < first.t) {
                first = Some(Fall { t, watched });
            }
        });
        first
    }

    /// Whether a guard that is down at the time `low` is still up at `t`, where another one falls: its own moment is nobody's
    /// business then. Of many contacts most guards go that way.
    fn comes_later(&self, watched: Watched<'e>, low: f64, t: f64) -> bool {
        t < low && self.inside(watched, t) > self.bands(watched).1
    }

    /// Whether a guard with the value `g` later in the step has fallen below its deadband.
    fn has_fallen(&self, watched: Watched<'_>, g: f64) -> bool {
        g < -self.bands(watched).0 && g < self.at_begin(watched)
    }

    /// The earliest fall of any other guard before that which ends the step.
    fn before(&self, last: Fall<'e>, near: &[usize]) -> Option<Fall<'e>> {
        let mut first: Option<Fall<'e>> = None;
        Watched::each(self.eq, near, |watched| {
            let g = self.at_end(watched);
            if g < 0.0 && watched.fallen() != last.watched.fallen() && self.has_fallen(watched, g) {
                let t = self.fall(watched, (last.t, g));
                if t < first.map_or(last.t, |first| first.t) {
                    first = Some(Fall { t, watched });
                }
            }
        });
        first
    }

    /// A guard that falls and returns inside the step: the time and value of its lowest point found.
    #[inline(always)]
    fn dip(&mut self, watched: Watched<'e>, g1: f64) -> Option<(f64, f64)> {
        if let Watched::Contact(index, contact, Guard::Side) = watched {
            let slope = contact.interface.stick_slope();
            let closes = |at: &Motion| at.dd < 0.0 && at.du.abs() < -slope * at.dd;
            let shrinks = closes(&self.from[index].motion) || closes(&self.to[index].motion);
            return if shrinks || watched.is_sampled() { self.side((index, contact)) } else { None };
        }
        if watched.is_sampled() {
            return self.looks(watched);
        }
        match watched {
            // It rises again only after the edge has turned, and then that comes first.
            Watched::Closed(_, Guard::Piece) | Watched::Contact(_, _, Guard::Piece) => return None,
            _ => {}
        }
        let (t0, h) = (self.solver.span().time, self.solver.span().end_time - self.solver.span().time);
        let (g0, rates) = (self.at_begin(watched), self.rates(watched));
        let (cubic, level) =
            (Cubic { y0: g0, dy0: rates[0], y1: g1, dy1: rates[1], h }, DIPS_TO * g0.min(g1).max(0.0));
        if cubic.stays_above(level) {
            return None;
        }
        let lowest = cubic.dip().filter(|lowest| lowest.y <= level)?;
        let low = self.look(watched, t0 + lowest.x * h);
        Some(low).filter(|(_, g)| *g < -self.bands(watched).0)
    }

    /// The first of some moments inside the step at which a guard has fallen, and its value there.
    fn looks(&mut self, watched: Watched<'e>) -> Option<(f64, f64)> {
        let (t0, h) = (self.solver.span().time, self.solver.span().end_time - self.solver.span().time);
        let mut looks = LOOKS.into_iter().map(|share| match watched {
            Watched::Contact(index, contact, guard) => {
                let (t, motion) = self.motion_at(index, contact, share);
                (t, guard.value(contact, self.eq.law(index), &motion))
            }
            _ => self.look(watched, t0 + share * h),
        });
        let (t, g) = looks.find(|(_, g)| *g < 0.0)?;
        self.has_fallen(watched, g).then_some((t, g))
    }

    /// A moment inside the step and the value of a guard there.
    fn look(&mut self, watched: Watched<'e>, t: f64) -> (f64, f64) {
        self.solver.complete(self.eq, Completion::Dense);
        (t, self.inside(watched, t))
    }

    /// The moment at which a guard falls, between the start of the step and a time at which it is below zero.
    ///
    /// By the dense output, which is there.
    #[inline(never)]
    fn fall(&self, watched: Watched<'e>, (low, below): (f64, f64)) -> f64 {
        let (t0, g0) = (self.solver.span().time, self.at_begin(watched));
        let (_, near) = self.bands(watched);
        // What starts as good as down rests until it has left its deadband.
        if g0 < near {
            return self.leave(watched, Point { x: t0, y: g0 }, Point { x: low, y: below });
        }
        // A moment missed by this much leaves its guard far nearer to zero than the laws on both sides can tell.
        let tolerance = (0.1 * NEARNESS * self.tolerance * (low - t0)).max(4.0 * f64::EPSILON * low.abs());
        let guess = self.guess(watched, (g0, low, below));
        let value = |t: f64| {
            let value = self.inside(watched, t);
            // As good as there.
            if value.abs() < near { 0.0 } else { value }
        };
        let bracket = Bracket { from: Point { x: t0, y: g0 }, to: Point { x: low, y: below } };
        root_near(value, bracket, guess, tolerance)
    }

    /// About where a guard falls between the start of the step and a time, as a fraction of the way: by the cubic through
    /// both ends of the step where its rates are known there.
    fn guess(&self, watched: Watched<'_>, (g0, low, below): (f64, f64, f64)) -> f64 {
        if self.is_cut || low < self.solver.span().end_time || watched.is_sampled() {
            return 0.5;
        }
        let rates = self.rates(watched);
        let h = low - self.solver.span().time;
        Cubic { y0: g0, dy0: rates[0], y1: below, dy1: rates[1], h }.root()
    }

    /// The moment of a guard that rests at the start of the step, having just fallen or as good as down: it rises out of its
    /// deadband, is armed there and falls, or it leaves on the other side.
    ///
    /// Either way there lies an excursion larger than rounding between two events of one guard.
    fn leave(&self, watched: Watched<'_>, from: Point, low: Point) -> f64 {
        let (g, dead) = (|t: f64| self.inside(watched, t), self.bands(watched).0);
        let tolerance = 4.0 * f64::EPSILON * low.x.abs();
        let mut t = low.x;
        for _ in 0..HALVINGS {
            t = from.x + 0.5 * (t - from.x);
            let armed = Point { x: t, y: g(t) };
            if armed.y > dead {
                return root(g, Bracket { from: armed, to: low }, tolerance);
            }
        }
        let level = from.y.min(0.0) - dead;
        if low.y >= level {
            return low.x;
        }
        let above = |point: Point| Point { y: point.y - level, ..point };
        root(|t| g(t) - level, Bracket { from: above(from), to: above(low) }, tolerance)
    }

    /// Whether any other guard than that which ends the step has come as near to zero there as to be as good as down.
    fn has_company(&self, last: Fall<'e>, near: &[usize]) -> bool {
        let mut found = false;
        Watched::each(self.eq, near, |watched| {
            found |= self.comes_near(watched) && watched.fallen() != last.watched.fallen();
        });
        found
    }

    /// Whether a guard is down or about as good as down at the end of the step, and lower than at its start.
    // In this order: of many contacts nothing is asked as often, and most stand far from any event.
    #[inline(always)]
    fn comes_near(&self, watched: Watched<'_>) -> bool {
        let end = self.at_end(watched);
        end < self.own_bands(watched).1 && end < self.at_begin(watched)
    }

    /// Whether a guard is down at the end of the step, or as good as down.
    #[inline(always)]
    fn falls_too(&self, watched: Watched<'_>) -> bool {
        if !self.comes_near(watched) {
            return false;
        }
        let (g0, g) = (self.at_begin(watched), self.at_end(watched));
        let (dead, near) = self.bands(watched);
        // What was as good as down all along idles: a contact at rest reverses at nobody else's events.
        let rises =
            || self.rates(watched)[0] * (self.solver.span().end_time - self.solver.span().time) > near;
        g < -dead || g0 >= near || rises()
    }
}
