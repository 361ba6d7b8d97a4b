//! Location of the first event in a step.
//!
//! An event is the first time in the half-open interval (t₀, t₁] at which an event function falls below zero by more than its deadband. The
//! start t₀ belongs to the previous step, so an event at t₀ does not occur again.
//!
//! An event function that is negative at the end of the step has crossed zero. A function that is positive at both ends may be negative in
//! between. If values and rates at both ends describe the function, the minimum of the cubic Hermite interpolant is evaluated. Other
//! functions are evaluated at three times inside the step.
//!
//! The event time is a bracketed root on the dense output, without force evaluations. Event functions that are negative or near zero at
//! that time belong to the same event. All of these are collected before any law is chosen.

mod meeting;
mod reading;
mod side;

use super::watch::{Moving, Watch};
use super::watched::Watched;
use crate::contact::Motion;
use crate::equations::Equations;
use crate::interval::Closed;
use arrayvec::ArrayVec;
use stickslip_contact::{Guard, NEARNESS};
use stickslip_stepper::{Attempt, Bracket, Completion, Cubic, Point, root, root_near};

/// Event function that crosses zero in the attempted step, and the time of the crossing, s.
#[derive(Clone, Copy)]
pub(super) struct Fall<'e> {
    pub(super) t: f64,
    watched: Watched<'e>,
}

/// Attempted step that is searched for events, with the contacts at both ends.
struct Search<'r, 'e, A> {
    from: &'r [Moving],
    to: &'r [Moving],
    tolerance: f64,
    solver: &'r mut A,
    eq: &'r Equations<'e>,
    /// Whether the step has been cut. The slopes at its end are then unknown.
    is_cut: bool,
    /// Motions of the current contact inside the step that have already been computed.
    seen: ArrayVec<Seen, { side::SHARES.len() }>,
}

/// Motion of a contact at a fraction of the step.
struct Seen {
    contact: usize,
    part: f64,
    motion: Motion,
}

/// Fractions of a step at which event functions that no polynomial of low degree describes are evaluated.
const LOOKS: [f64; 3] = [0.25, 0.5, 0.75];
/// Largest minimum of the cubic interpolant that is checked on the dense output, as a fraction of the smaller end value.
const DIPS_TO: f64 = 0.1;
/// Largest number of bisections to find a time at which an event function near zero exceeds its deadband.
const HALVINGS: u32 = 40;
/// Largest number of searches for an earlier event.
///
/// The limit ends an endless loop between two event functions whose values are only rounding errors.
const EARLIER: u32 = 64;

impl Watch {
    /// Returns the earliest event in the attempted step, from the dense output.
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

    /// Ends the step at an event and collects all event functions that belong to it.
    ///
    /// An event function that is already negative at the event, but positive at both ends of the attempted step, gives an earlier event. An
    /// example is a memory piece that ends before a reversal. The collected functions are the one that ends the step and all others that
    /// are negative or near zero there.
    ///
    /// If motions may decay within a step, `fading` has the allowed errors. The cut is then as accurate as the end of a step.
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
            // With many contacts there is hardly ever a second event function, and this check is the only cost.
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
    /// Collects the contacts with closed-form forces that must be checked, see [`is_far`](Self::is_far).
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

    /// Whether all event functions of a contact with a closed-form force stay positive and away from zero in the step.
    ///
    /// The control points of the velocity cubic show that the slip edge does not stop. The memory piece must not end within the step.
    /// `third` is a third of the step, s.
    #[inline(always)]
    fn is_far(&self, steady: &Closed<'_>, third: f64) -> bool {
        let (from, to) = (&self.from[steady.index], &self.to[steady.index]);
        let sense = steady.sense();
        let (first, last) = (sense * from.motion.du, sense * to.motion.du);
        let turns = third * sense;
        let between = (first + turns * from.second.1).min(last - turns * to.second.1);
        let slowest = first.min(last).min(between);
        let (_, close) = Guard::Piece.bands(steady.contact, self.tolerance, from.motion.u);
        slowest > (DIPS_TO * first.min(last)).max(close * steady.contact.natural.frequency)
            && steady.margin(to.motion.u) > close
    }

    /// Returns the earliest event in the attempted step, from the dense output.
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

    /// Whether an event function that is negative at time `low` is still positive at `t`, where another event occurs.
    ///
    /// The zero crossing of this function is then not needed.
    fn comes_later(&self, watched: Watched<'e>, low: f64, t: f64) -> bool {
        t < low && self.inside(watched, t) > self.bands(watched).1
    }

    /// Whether an event function with the value `g` has fallen below its deadband in the step.
    fn has_fallen(&self, watched: Watched<'_>, g: f64) -> bool {
        g < -self.bands(watched).0 && g < self.at_begin(watched)
    }

    /// Returns the earliest zero crossing of another event function before the event that ends the step.
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

    /// Returns time and value of the minimum of an event function that is positive at both ends, if the minimum is negative.
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
            // The remaining length increases only after a reversal, which is then the earlier event.
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

    /// Returns the first sampled time inside the step at which an event function has crossed zero, and the value there.
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

    /// Returns the given time inside the step and the value of an event function there.
    fn look(&mut self, watched: Watched<'e>, t: f64) -> (f64, f64) {
        self.solver.complete(self.eq, Completion::Dense);
        (t, self.inside(watched, t))
    }

    /// Returns the time at which an event function crosses zero, between the start of the step and a time with a negative value.
    ///
    /// Requires the dense output of the step.
    #[inline(never)]
    fn fall(&self, watched: Watched<'e>, (low, below): (f64, f64)) -> f64 {
        let (t0, g0) = (self.solver.span().time, self.at_begin(watched));
        let (_, near) = self.bands(watched);
        // An event function near zero at the start must first leave its deadband.
        if g0 < near {
            return self.leave(watched, Point { x: t0, y: g0 }, Point { x: low, y: below });
        }
        // With this error in time, the event function is far closer to zero than its nearness.
        let tolerance = (0.1 * NEARNESS * self.tolerance * (low - t0)).max(4.0 * f64::EPSILON * low.abs());
        let guess = self.guess(watched, (g0, low, below));
        let value = |t: f64| {
            let value = self.inside(watched, t);
            // Values near zero count as zero.
            if value.abs() < near { 0.0 } else { value }
        };
        let bracket = Bracket { from: Point { x: t0, y: g0 }, to: Point { x: low, y: below } };
        root_near(value, bracket, guess, tolerance)
    }

    /// Returns an estimate of the zero crossing, as a fraction of the time to the negative value.
    ///
    /// Where rates are known at both ends of the step, the estimate is the root of the cubic Hermite interpolant.
    fn guess(&self, watched: Watched<'_>, (g0, low, below): (f64, f64, f64)) -> f64 {
        if self.is_cut || low < self.solver.span().end_time || watched.is_sampled() {
            return 0.5;
        }
        let rates = self.rates(watched);
        let h = low - self.solver.span().time;
        Cubic { y0: g0, dy0: rates[0], y1: below, dy1: rates[1], h }.root()
    }

    /// Returns the event time of an event function that is near zero at the start of the step.
    ///
    /// The function either rises above its deadband and then crosses zero, or it leaves the deadband downwards. Two events of one function
    /// are therefore always separated by an excursion larger than rounding.
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

    /// Whether another event function is near zero at the event that ends the step.
    fn has_company(&self, last: Fall<'e>, near: &[usize]) -> bool {
        let mut found = false;
        Watched::each(self.eq, near, |watched| {
            found |= self.comes_near(watched) && watched.fallen() != last.watched.fallen();
        });
        found
    }

    /// Whether an event function is negative or near zero at the end of the step, and lower than at the start.
    #[inline(always)]
    fn comes_near(&self, watched: Watched<'_>) -> bool {
        let end = self.at_end(watched);
        end < self.own_bands(watched).1 && end < self.at_begin(watched)
    }

    /// Whether an event function crosses zero together with the event at the end of the step.
    #[inline(always)]
    fn falls_too(&self, watched: Watched<'_>) -> bool {
        if !self.comes_near(watched) {
            return false;
        }
        let (g0, g) = (self.at_begin(watched), self.at_end(watched));
        let (dead, near) = self.bands(watched);
        // A function that is near zero all the time belongs to a contact at rest, for which events of others mean nothing.
        let rises =
            || self.rates(watched)[0] * (self.solver.span().end_time - self.solver.span().time) > near;
        g < -dead || g0 >= near || rises()
    }
}
