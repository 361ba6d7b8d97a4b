//! Intervals that are taken in one go, without the stepper.
//!
//! Between two events of a single slider whose contacts all have closed forms, and which straight waveforms
//! drag, the motion is known: parabolas in gross slip, else one quadrature of time
//! ([`Swing`](crate::interval::Swing)). Rows, looks and the ends of periods on the way are read off it each
//! for itself, from the start of the leap: they are the same whatever others are asked for. On the benchmark
//! drive an error of 1e-9 costs less than half of what steps cost.

use super::Located;
use super::watch::Fallen;
use crate::RunError;
use crate::contact::Guard;
use crate::equations::Equations;
use crate::interval::{Closed, PhasePoint};
use crate::method::Method;
use crate::record::Record;
use crate::run::horizon::Progress;
use crate::state::{Books, State, beyond};
use stickslip_stepper::Attempt;

/// Velocity, relative to those around, below which the turn is so near that a cubic has it.
// With 1e-6 P1 takes half as much again, for the same digits of its back-step.
const SLOW: f64 = 0.05;
/// Most secants to a turn.
const SECANTS: u32 = 8;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Moves to the next event, corner or end in one go; none, with nothing done, where the interval has no closed form.
    ///
    /// Ends at the first of the event of the motion, the next corner, and where the run is to go; cut there, the swing stays
    /// under way. Fails as a step does: values not finite, contacts out of range, limits.
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
        // Less than a last place of t ahead there is no leap: the stepper takes over.
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
        // Before the rows: what output asks of the swing is no part of the run.
        state.counts.evaluations += self.swing.evaluations - spent;
        if self.output.due(to.t) {
            self.write_on_the_way(state, to, record);
        }
        // Both may be true, to the last bit: then the event's guards fall and the corner turns in one.
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

    /// The leap is not made: it would reach the end of the run.
    fn stay(&mut self, begins: bool) -> Progress {
        if begins {
            // Whoever goes on from here leaps as if nobody had asked.
            (self.takeoff, self.interval.traits.asked) = (None, false);
        }
        Progress::Short
    }

    /// Takes up the interval and finds its event.
    ///
    /// False where the scene has more than one free coordinate, the interval no closed form, or the search no
    /// result; steps take the interval then.
    fn take_off(&mut self, state: &State) -> bool {
        // What has no closed form now has none until the next event.
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

    /// Where the leap ends: at the end of a period with which the steps of the drive are constant, or else where it was to.
    ///
    /// Ends horizon and output there.
    #[inline(never)]
    fn leap_over_steps(&mut self, state: &State, to: PhasePoint) -> PhasePoint {
        while let Some(due) = self.horizon.steps.due(to.t) {
            let place = if due < to.t { self.swing.at(due) } else { to };
            if self.horizon.steps.take(state.shifts[self.horizon.steps.coordinate], place.x) {
                self.end_at(due);
                return place;
            }
        }
        to
    }

    /// Rows and looks that are due on the way.
    ///
    /// The state is only read. Scratch is borrowed from the output and given back, so that nothing is
    /// allocated.
    #[inline(never)]
    fn write_on_the_way(&mut self, state: &State, to: PhasePoint, record: &mut dyn Record) {
        let eq = self.setting.plain(state);
        let mut y = std::mem::take(&mut self.output.components);
        while let Some(due) = self.output.grid.due(to.t) {
            self.fill(state, due, to, &mut y);
            self.output.grid.write(&eq, state, due, &|i| y[i], record);
        }
        if self.output.marks.watches() {
            self.pass_leap(&eq, state, to, (&mut y, record));
        }
        while let Some(due) = self.output.marks.due(to.t) {
            self.fill(state, due, to, &mut y);
            self.output.marks.write(&eq, state, due, &|i| y[i], record);
        }
        while let Some(due) = self.output.looks.due(to.t) {
            self.fill(state, due, to, &mut y);
            let memories = self.memories_at(&eq, state, due, |i| y[i]);
            self.output.looks.show(memories.as_deref().ok(), record);
        }
        self.output.components = y;
    }

    /// The way of the watched body, and the marks on it.
    fn pass_leap(
        &mut self,
        eq: &Equations<'_>,
        state: &State,
        to: PhasePoint,
        (y, record): (&mut [f64], &mut dyn Record),
    ) {
        let mut from = PhasePoint { t: state.t, x: state.y[0], v: state.y[1] };
        while let Some(due) = self.output.marks.due(to.t) {
            let place = if due < to.t { self.swing.at(due) } else { to };
            self.pass_arc(state, from, place);
            self.fill(state, due, to, y);
            self.output.marks.write(eq, state, due, &|i| y[i], record);
            from = place;
        }
        self.pass_arc(state, from, to);
        self.output.marks.end_step();
    }

    /// A part of an arc: it turns once between velocities of two signs, and twice or never between those of one, for the slide
    /// rises and falls once at most.
    fn pass_arc(&mut self, state: &State, from: PhasePoint, to: PhasePoint) {
        let shift = state.shifts[0];
        let point = |place: PhasePoint| [place.t, shift + place.x, place.v];
        // A parabola is its own cubic.
        if !self.swing.is_free() && to.t > from.t {
            let mut turns = [None, None];
            if from.v * to.v < 0.0 {
                turns[0] = Some(self.turn_between(from, to));
            } else if self.swing.leads_back(from.v) {
                // In the middle the slide may be faster than what carries the body back.
                let middle = self.swing.at(0.5 * (from.t + to.t));
                if middle.v * from.v < 0.0 {
                    turns = [(from, middle), (middle, to)].map(|(a, b)| Some(self.turn_between(a, b)));
                }
            }
            turns.into_iter().flatten().for_each(|turn| self.output.marks.pass(state, |_| point(turn)));
        }
        self.output.marks.pass(state, |_| point(to));
    }

    /// Where the velocity changes its sign, by secants that keep it between (Illinois).
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

    /// Components at a time on the way.
    ///
    /// Position (m), velocity (m/s) and the work put in (J); all other components are those of the state,
    /// which nothing in such an interval changes.
    fn fill(&mut self, state: &State, due: f64, to: PhasePoint, y: &mut [f64]) {
        let place = if due < to.t { self.swing.at(due) } else { to };
        y.copy_from_slice(&state.y);
        (y[0], y[1]) = (place.x, place.v);
        y[self.setting.layout.input()] = self.input_at(&place);
    }

    /// Work put in until a place on the way, J: counted from where the leap began, however often it was cut.
    fn input_at(&self, place: &PhasePoint) -> f64 {
        self.takeoff.unwrap_or(0.0) + self.swing.work(place)
    }

    /// Moves the state to a place; memories stay behind. Counts one step where an interval `ends`.
    ///
    /// Fails where place or velocity is not finite.
    fn land(&mut self, state: &mut State, to: PhasePoint, ends: bool) -> Result<(), RunError> {
        if let Some(i) = beyond(&[to.x, to.v]) {
            return Err(self.setting.model.not_finite(to.t, i));
        }
        state.y[self.setting.layout.input()] = self.input_at(&to);
        (state.y[0], state.y[1]) = (to.x, to.v);
        state.t = to.t;
        // One chord to the event, as if nobody had looked on the way.
        self.ledger.booked.books = Books::Behind;
        if ends {
            self.takeoff = None;
            state.counts.steps += 1;
            state.tally.step(if self.swing.is_free() { Method::Parabola } else { Method::Swing });
        }
        Ok(())
    }

    /// Moves the memories of those contacts whose guards fell to where the state is, at a corner those of all. The others go on
    /// along their pieces: one chord to their own next event is the same as many.
    ///
    /// Fails where a contact refuses its path.
    fn remember(&mut self, state: &mut State, is_corner: bool) -> Result<(), RunError> {
        if is_corner || self.watch.fired.len() == self.interval.closed.len() {
            self.trace_closed(state);
            self.ledger.booked.books = Books::Current;
        } else {
            self.trace_fired(state);
        }
        self.ledger.commit((self.setting.model, self.setting.layout), state.t, state)
    }

    /// The guards that end the motion: all edges turn at once; of pieces those that are used up, or as good as.
    ///
    /// As good as used up is a piece whose rest is within the nearness of its guard of the least one.
    fn collect_reached(&mut self, state: &State) {
        let steady = self.interval.closed.iter();
        // One slider, one follower: all contacts stop sliding at the same moment.
        if self.swing.turns {
            self.watch.fired.extend(steady.map(|steady| Fallen::Contact(steady.index, Guard::Drag)));
            return;
        }
        let pieces = steady.filter(|steady| steady.guards.contains(&Guard::Piece));
        let left = |steady: &Closed<'_>| {
            let motion = steady.motion(state.t, |_| state.y[0], |_| state.y[1]);
            steady.guard(Guard::Piece, &motion)
        };
        // Twins close their loops at once; rounding must not make two events of them.
        let least = pieces.clone().map(left).fold(f64::INFINITY, f64::min);
        let reached = pieces.filter(|steady| {
            let u = steady.displacement(state.t, |_| state.y[0]);
            let (_, near) = Guard::Piece.bands(steady.contact, self.setting.tolerance, u);
            left(steady) <= least.max(0.0) + near
        });
        self.watch.fired.extend(reached.map(|steady| Fallen::Contact(steady.index, Guard::Piece)));
    }
}
