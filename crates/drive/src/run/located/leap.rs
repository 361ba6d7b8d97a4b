//! Closed-form steps ("leaps") to the next event, without the integrator, where the motion has a closed form.
//!
//! The motion of a single slider between two events has a closed form if all its contacts have closed-form forces and waveforms are linear.
//! In gross slip the motion is a parabola, otherwise one quadrature gives the time ([`Swing`](crate::interval::Swing)).
//!
//! Rows, snapshots and period ends are computed from the start of the closed-form step, independently of each other.

use super::Located;
use super::watch::Fallen;
use crate::RunError;
use crate::equations::Equations;
use crate::interval::{Closed, PhasePoint, Swing};
use crate::method::Method;
use crate::record::Record;
use crate::run::horizon::Progress;
use crate::run::output::Point;
use crate::run::stretch::Stretch;
use crate::state::{Books, Layout, State, beyond};
use stickslip_contact::Guard;
use stickslip_stepper::Attempt;

/// Largest velocity, relative to the ends of the arc, at which a point counts as a turning point.
const SLOW: f64 = 0.05;
/// Largest number of secant steps to a turning point.
const SECANTS: u32 = 8;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Advances to the next event, corner or goal in one closed-form step.
    ///
    /// Returns `None` and does nothing if the interval has no closed-form solution. A goal before the event interrupts the step, and the
    /// next call continues it. Fails if values are not finite, if a contact cannot follow its path, or if a limit is reached.
    pub(super) fn leap(
        &mut self,
        state: &mut State,
        record: &mut dyn Record,
    ) -> Result<Option<Progress>, RunError> {
        let begins = self.takeoff.is_none();
        if begins && !(self.interval.leaps() && self.take_off(state)) {
            return Ok(None);
        }
        let spent = if begins { 0 } else { self.swing.evaluations };
        let event = self.swing.end();
        let next = self.horizon.next();
        if self.horizon.is_beyond(event.t.min(next)) {
            return Ok(Some(self.stay(begins)));
        }
        let stop = next.min(self.horizon.end);
        let mut to = if event.t < stop { event } else { self.swing.at(stop) };
        // If the end is less than the rounding of t ahead, the integrator takes over.
        if to.t <= state.t {
            self.takeoff = None;
            return Ok(None);
        }
        if self.horizon.steps.due(to.t).is_some() {
            let before = self.horizon.steps;
            to = self.leap_over_steps(state, to);
            if self.horizon.is_beyond(to.t) {
                self.horizon.steps = before;
                return Ok(Some(self.stay(begins)));
            }
        }
        // Counted before the rows, whose evaluations do not belong to the run.
        state.counts.evaluations += self.swing.evaluations - spent;
        if self.output.due(to.t) {
            self.write_on_the_way(state, to, record);
        }
        // Both may be true at the same time: zero crossings and corner are then handled together.
        let (is_event, is_corner) = (to.t == event.t, to.t == self.horizon.corner);
        self.land(state, to, is_event || is_corner)?;
        self.watch.fired.clear();
        if is_event {
            self.collect_reached(state);
        }
        if is_event || is_corner {
            self.remember(state, is_corner)?;
        }
        let turns = is_corner && !state.waits_for_input(self.setting.model);
        if is_event || turns {
            self.pass_event(state, turns, record)?;
        }
        self.bounds.step(state, record).map(|()| Some(Progress::Made))
    }

    /// Cancels the closed-form step, because the step would reach the end of the run.
    fn stay(&mut self, begins: bool) -> Progress {
        if begins {
            // A later call leaps as if this one had not been made.
            (self.takeoff, self.interval.traits.asked) = (None, false);
        }
        Progress::Short
    }

    /// Begins a closed-form step and finds the event at its end.
    ///
    /// Returns false if the model has several free coordinates, if the interval has no closed form, or if the search finds no event. The
    /// interval is then integrated in steps.
    fn take_off(&mut self, state: &State) -> bool {
        // Without a closed form, there is none until the next event.
        self.interval.traits.asked = true;
        if self.setting.model.free.len() != 1 {
            return false;
        }
        let from = PhasePoint { t: state.t, x: state.y[0], v: state.y[1] };
        let leaps = self.swing_from(from);
        if leaps {
            self.takeoff = Some(state.y[self.setting.layout.input()]);
        }
        leaps
    }

    /// Returns the end of the closed-form step: `to`, or an earlier period end at which the step length of the drive has become steady.
    ///
    /// A steady step length ends the run at that period end.
    #[inline(never)]
    fn leap_over_steps(&mut self, state: &State, to: PhasePoint) -> PhasePoint {
        let mut y = std::mem::take(&mut self.output.components);
        let layout = self.setting.layout;
        let mut leap = Leap { swing: &mut self.swing, takeoff: self.takeoff, layout, state, to };
        let end = self.horizon.take_periods(state, &mut leap, (to.t, &mut y));
        self.output.components = y;
        let Some(end) = end else { return to };
        self.end_at(end);
        if end < to.t { self.swing.at(end) } else { to }
    }

    /// Writes the output that is due within the closed-form step.
    #[inline(never)]
    fn write_on_the_way(&mut self, state: &State, to: PhasePoint, record: &mut dyn Record) {
        let eq = self.setting.plain(state);
        let layout = self.setting.layout;
        let mut leap = Leap { swing: &mut self.swing, takeoff: self.takeoff, layout, state, to };
        self.output.take((&eq, state), &mut leap, (to.t, self.setting.tolerance), record);
    }

    /// Returns the input work at a point of the closed-form step, J. It counts from the start of the step, even across interruptions.
    fn input_at(&self, place: &PhasePoint) -> f64 {
        input(&self.swing, self.takeoff, place)
    }

    /// Moves the state to a point of the closed-form step without committing memories. If the interval `ends`, counts one step.
    ///
    /// Fails if position or velocity is not finite.
    fn land(&mut self, state: &mut State, to: PhasePoint, ends: bool) -> Result<(), RunError> {
        if let Some(i) = beyond(&[to.x, to.v]) {
            return Err(self.setting.model.not_finite(to.t, i));
        }
        state.y[self.setting.layout.input()] = self.input_at(&to);
        (state.y[0], state.y[1]) = (to.x, to.v);
        state.t = to.t;
        // The slip memories commit one straight path at the event, whatever interrupted the leap.
        self.ledger.booked.books = Books::Behind;
        if ends {
            self.takeoff = None;
            state.counts.steps += 1;
            state.tally.step(if self.swing.is_free() { Method::Parabola } else { Method::Swing });
        }
        Ok(())
    }

    /// Commits the slip memories of contacts with a zero crossing, at a corner of all contacts.
    ///
    /// For the other contacts, one straight path to their own next event is equivalent to many. Fails if a contact cannot follow its path.
    fn remember(&mut self, state: &mut State, is_corner: bool) -> Result<(), RunError> {
        if is_corner || self.watch.fired.len() == self.interval.closed.len() {
            self.trace_closed(state);
            self.ledger.booked.books = Books::Current;
        } else {
            self.trace_fired(state);
        }
        self.ledger.commit((self.setting.model, self.setting.layout), state.t, state)
    }

    /// Collects the zero crossings that end the closed-form step: all reversals, or the ends of all memory pieces reached there.
    ///
    /// The end of a piece counts as reached if its remaining length exceeds the smallest one by at most the near-zero band.
    fn collect_reached(&mut self, state: &State) {
        let steady = self.interval.closed.iter();
        // With one slider and one follower, all contacts stop sliding together.
        if self.swing.turns {
            self.watch.fired.extend(steady.map(|steady| Fallen::Contact(steady.index, Guard::Drag)));
            return;
        }
        let pieces = steady.filter(|steady| steady.guards.contains(&Guard::Piece));
        let left = |steady: &Closed<'_>| {
            let motion = steady.motion(state.t, |_| state.y[0], |_| state.y[1]);
            steady.guard(Guard::Piece, &motion)
        };
        // Equal contacts close their loops together; rounding must not make two events of them.
        let least = pieces.clone().map(left).fold(f64::INFINITY, f64::min);
        let reached = pieces.filter(|steady| {
            let u = steady.displacement(state.t, |_| state.y[0]);
            let (_, near) = Guard::Piece.bands(steady.contact, self.setting.tolerance, u);
            left(steady) <= least.max(0.0) + near
        });
        self.watch.fired.extend(reached.map(|steady| Fallen::Contact(steady.index, Guard::Piece)));
    }
}

/// Closed-form motion of a single slider from the state to a point.
struct Leap<'r, 'a> {
    swing: &'r mut Swing<'a>,
    /// Input work at the start of the motion, J.
    takeoff: Option<f64>,
    layout: Layout,
    state: &'r State,
    to: PhasePoint,
}

/// Returns the input work at a point of the closed-form motion, J.
fn input(swing: &Swing<'_>, takeoff: Option<f64>, place: &PhasePoint) -> f64 {
    takeoff.unwrap_or(0.0) + swing.work(place)
}

impl Leap<'_, '_> {
    fn at(&mut self, t: f64) -> PhasePoint {
        match t {
            _ if t >= self.to.t => self.to,
            _ if t == self.state.t => PhasePoint { t, x: self.state.y[0], v: self.state.y[1] },
            _ => self.swing.at(t),
        }
    }

    /// Returns a point near the zero of the velocity, by the Illinois variant of the secant method.
    fn turn_between(&mut self, mut a: PhasePoint, mut b: PhasePoint) -> PhasePoint {
        let slow = SLOW * a.v.abs().max(b.v.abs());
        let (mut va, mut vb) = (a.v, b.v);
        for _ in 0..SECANTS {
            let middle = self.swing.at(a.t + va / (va - vb) * (b.t - a.t));
            if middle.v.abs() <= slow || !(middle.t > a.t && middle.t < b.t) {
                return middle;
            }
            if middle.v * va < 0.0 {
                (b, vb, va) = (middle, middle.v, 0.5 * va);
            } else {
                (a, va, vb) = (middle, middle.v, 0.5 * vb);
            }
        }
        a
    }
}

impl Stretch for Leap<'_, '_> {
    /// Only position (m), velocity (m/s) and input work (J) differ from the state.
    fn fill(&mut self, t: f64, y: &mut [f64]) {
        let place = self.at(t);
        y.copy_from_slice(&self.state.y);
        (y[0], y[1]) = (place.x, place.v);
        y[self.layout.input()] = input(self.swing, self.takeoff, &place);
    }

    /// Between velocities of opposite sign there is one turning point. Between velocities of the same sign there are two or none, because
    /// the sliding velocity rises and falls at most once.
    fn extremes(&mut self, [from, to]: [f64; 2], pass: &mut dyn FnMut(Point)) {
        // For a parabola the cubic is exact.
        if self.swing.is_free() || to <= from {
            return;
        }
        let shift = self.state.shifts[0];
        let (from, to) = (self.at(from), self.at(to));
        let mut turns = [None, None];
        if from.v * to.v < 0.0 {
            turns[0] = Some(self.turn_between(from, to));
        } else if self.swing.leads_back(from.v) {
            // In the middle, sliding may be faster than the follower that moves the body back.
            let middle = self.swing.at(0.5 * (from.t + to.t));
            if middle.v * from.v < 0.0 {
                turns = [(from, middle), (middle, to)].map(|(a, b)| Some(self.turn_between(a, b)));
            }
        }
        turns.into_iter().flatten().for_each(|turn| pass([turn.t, shift + turn.x, turn.v]));
    }
}
