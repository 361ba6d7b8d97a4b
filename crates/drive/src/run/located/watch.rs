//! The contacts at both ends of a step, and the guards that fell at its end.
//!
//! Motion and accelerations of all contacts at both ends of a step are read once, so that guards have values and rates there
//! however often they are asked. [`search`](super::search) looks between the ends. A
//! step's end becomes the next one's start by an exchange of both; whatever makes slopes jump sets the start
//! anew.

use crate::contact::{Contact, Guard, Mode, Motion};
use crate::equations::{Components, Equations};
use crate::interval::{Closed, Interval};
use crate::model::{Measure, Model};
use stickslip_contact::Memory;
use stickslip_stepper::{End, Span, Step};

/// What is left of a piece of memory in last places of the places of its bodies, below which no step waits for its end.
// Without it a stage that rides on its foot, 4 μm from its start, took steps of 17 ps, which moved no place by a last bit, for
// the rest of its period; any of 0.5 to 8 ends that. 4 moves an event of a climber at a tolerance of 1e-12.
const LAST_PLACES: f64 = 2.0;

/// A contact at one end of a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moving {
    /// d, u and their rates; m, m/s.
    pub(super) motion: Motion,
    /// d̈ and ü, m/s²; what a waveform does to the indentation otherwise than by moving a body is left out.
    pub(super) second: (f64, f64),
}

/// A component and its guard that fell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fallen {
    /// The contact at this place, and its guard.
    Contact(usize, Guard),
    /// The block at this place, and its guard.
    Block(usize, usize),
}

impl Fallen {
    /// Whether both are of one component.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Contact(a, _), Self::Contact(b, _)) | (Self::Block(a, _), Self::Block(b, _)) => a == b,
            _ => false,
        }
    }
}

/// The contacts at both ends of a step, and the guards that fell at its end.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// At its start.
    pub(super) from: Vec<Moving>,
    /// At its end.
    pub(super) to: Vec<Moving>,
    /// Places of those contacts of closed form any guard of which may fall in the step, or come near to that.
    pub(super) near: Vec<usize>,
    /// Guards that fell at the end of the step.
    pub(super) fired: Vec<Fallen>,
    /// Of the plan; guards count as fallen or near in units of it.
    pub(super) tolerance: f64,
    /// Whether nothing but works is integrated. No weight of the method but the first lies in the first quarter of a step: what an edge
    /// does there that has only just turned, at a crest where the power is 0, no estimate tells.
    integrates_works: bool,
}

impl Watch {
    pub(super) fn renewed(mut self, model: &Model, tolerance: f64) -> Self {
        let count = model.contacts.len();
        for ends in [&mut self.from, &mut self.to] {
            ends.clear();
            ends.resize(count, Moving::default());
        }
        self.near.clear();
        self.near.reserve(count);
        self.fired.clear();
        self.fired.reserve(count + model.blocks.len());
        Self { tolerance, integrates_works: model.free.is_empty(), ..self }
    }

    /// The contacts at the start of the next step, after anything that makes slopes jump.
    pub(super) fn set_out(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let span = solver.span();
        follow(eq, &mut self.from, (span.time, span.begin), |i| solver.slope(i, End::Start));
    }

    /// The contacts at the end of the step.
    pub(super) fn arrive(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let span = solver.span();
        follow(eq, &mut self.to, (span.end_time, span.end), |i| solver.slope(i, End::End));
    }

    /// The same where the step was cut: slopes are not known there, and no guard's rate is asked for. Of contacts of closed form that are
    /// far from any event nothing is asked at all.
    pub(super) fn arrive_at_cut(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let (Some(interval), Span { end_time: t, end: y, .. }) = (eq.interval, solver.span()) else { return };
        let n = eq.layout.free;
        for &place in &self.near {
            let steady = &interval.closed[place];
            self.to[steady.index].motion = steady.motion(t, |i| y[i], |i| y[n + i]);
        }
        for c in interval.open_form() {
            self.to[c].motion = eq.motion(&eq.model.contacts[c], t, |i| y[i]);
        }
    }

    /// The end of a step is the start of the next one.
    /// Nothing is evaluated again: both ends are one moment of one law.
    pub(super) fn go_on(&mut self) {
        std::mem::swap(&mut self.from, &mut self.to);
    }

    /// Motion of contact `c` at the end of the step or leap, at time t and components y. A leap watches no contact: of one of
    /// closed form it is read off these.
    pub(super) fn motion_at_end(&self, interval: &Interval<'_>, c: usize, (t, y): (f64, &[f64])) -> Motion {
        match interval.closed_form(c) {
            Some(steady) => {
                let n = interval.scene.free;
                steady.motion(t, |i| y[i], |i| y[n + i])
            }
            None => self.to[c].motion,
        }
    }
}

/// The contacts at time t and components y, with the slopes of its velocities.
#[inline(always)]
fn follow(
    eq: &Equations<'_>,
    contacts: &mut [Moving],
    (t, y): (f64, &[f64]),
    slope: impl Fn(usize) -> f64 + Copy,
) {
    let Some(interval) = eq.interval else { return };
    let n = eq.layout.free;
    for steady in &interval.closed {
        let (motion, pull) = steady.course(t, |i| y[i], |i| y[n + i], |i| slope(n + i));
        contacts[steady.index] = Moving { motion, second: (0.0, pull) };
    }
    for c in interval.open_form() {
        let contact = &eq.model.contacts[c];
        let motion = eq.motion(contact, t, |i| y[i]);
        contacts[c] = Moving { motion, second: second(eq, contact, (t, y), slope) };
    }
}

/// d̈ and ü of a contact from the slopes of the velocities.
///
/// From the slopes that the solver has at the ends of its step anyway.
fn second(
    eq: &Equations<'_>,
    contact: &Contact,
    (t, y): (f64, &[f64]),
    slope: impl Fn(usize) -> f64,
) -> (f64, f64) {
    let at = Components { t, y: |i: usize| y[i] };
    let of = |measure: &Measure| eq.acceleration(measure, &at, |i| slope(eq.layout.velocity(i)));
    (contact.coupling().map_or(0.0, of), of(&contact.u))
}

impl Watch {
    /// When the first contact will turn or leave full stick as it moves now, s from the start of the step.
    pub(super) fn turn(&self, eq: &Equations<'_>) -> f64 {
        let Some(interval) = eq.interval else { return f64::INFINITY };
        let falls = |value: f64, rate: f64| {
            if value > 0.0 && rate < 0.0 { -value / rate } else { f64::INFINITY }
        };
        let closed = interval.closed.iter().map(|steady| {
            let Moving { motion, second: (_, pull) } = &self.from[steady.index];
            falls(steady.guard(Guard::Drag, motion), steady.guard_rate(Guard::Drag, motion, *pull))
        });
        let open = interval.others.iter().flat_map(|&c| {
            let (contact, law, Moving { motion, second }) = (&eq.model.contacts[c], eq.law(c), &self.from[c]);
            let guards: &[Guard] = match law.1 {
                Mode::Slip(_) => &[Guard::Drag],
                Mode::Grow => &[Guard::Lower, Guard::Upper],
                _ => &[],
            };
            guards.iter().map(move |guard| {
                falls(guard.value(contact, law, motion), guard.rate(contact, law.1, motion, *second))
            })
        });
        closed.chain(open).fold(f64::INFINITY, f64::min)
    }

    /// When the first contact of closed form will have used up its piece of memory, and its place among the contacts, s from the
    /// start of the step, which stands at components `begin`.
    ///
    /// None where no edge will reach the end of its piece as it moves now.
    #[inline(always)]
    pub(super) fn expected_of_closed(&self, closed: &[Closed<'_>], begin: &[f64]) -> Option<(usize, f64)> {
        let mut first = None;
        let mut soonest = f64::INFINITY;
        for steady in closed {
            // In gross slip there is no piece.
            if !steady.guards.contains(&Guard::Piece) {
                continue;
            }
            let Moving { motion, second: (_, pull) } = &self.from[steady.index];
            let guard = |guard| steady.guard(guard, motion);
            let (left, pull) = (guard(Guard::Piece), steady.guard_rate(Guard::Drag, motion, *pull));
            let speed = guard(Guard::Drag);
            let speed = if self.integrates_works { speed.max(f64::MIN_POSITIVE) } else { speed };
            let when = reached(left, speed, pull);
            // Of many contacts only those are looked at twice that come first.
            if when < soonest && !is_rounding(left, steady.contact, |i| begin[i]) {
                (first, soonest) = (Some((steady.index, when)), when);
            }
        }
        first
    }

    /// The same of any other contact.
    ///
    /// ∞ where it drags no edge, or its edge will not get there as it moves now.
    pub(super) fn expected_of(&self, eq: &Equations<'_>, c: usize, solver: &impl Step) -> f64 {
        let (contact, mode) = (&eq.model.contacts[c], &eq.modes[c]);
        let Moving { motion, second } = self.from[c];
        if let Mode::Lull { .. } = mode {
            return lull_end(contact, eq.law(c), &motion, second);
        }
        let Mode::Slip(branch) = mode else { return f64::INFINITY };
        // Gross slip has no end, and does not hide those of others.
        if branch.is_gross() {
            return f64::INFINITY;
        }
        let left = branch.margin(motion.d, motion.u);
        // Where a load comes back to its crest the last bits of u stand still long before it: no step should wait for them.
        let rests = contact.balanced && left < Guard::Piece.bands(contact, self.tolerance, motion.u).1;
        if rests || is_rounding(left, contact, |i| solver.span().begin[i]) {
            return f64::INFINITY;
        }
        let speed = Guard::Drag.value(contact, eq.law(c), &motion);
        // An edge that has only just turned drags at nothing but rounding: where the damping of a contact gives way no step may leap
        // over that moment, and no estimate tells that it did.
        let turns = (contact.is_damped() || self.integrates_works) && branch.ends_in_the_centre();
        let speed = if turns { speed.max(f64::MIN_POSITIVE) } else { speed };
        let pull = Guard::Drag.rate(contact, mode, &motion, second);
        reached(left, speed, pull)
    }
}

/// Whether what is left of a piece of memory (m) is less than the places show whose difference u is: [`LAST_PLACES`] of them. `x`
/// reads places of free coordinates. No step waits for such an end; it is found inside whatever step comes.
fn is_rounding(left: f64, contact: &Contact, x: impl Fn(usize) -> f64) -> bool {
    left < LAST_PLACES * f64::EPSILON * contact.u.travel(x)
}

/// When the first spring of a row will touch, part or slip, s from now.
fn lull_end(contact: &Contact, law: (&Memory, &Mode), at: &Motion, (bend, pull): (f64, f64)) -> f64 {
    let slope = contact.interface.stick_slope();
    let of = |guard: Guard, pull: f64| {
        reached(guard.value(contact, law, at), -guard.rate(contact, law.1, at, (bend, pull)), pull)
    };
    let ends = [
        of(Guard::Forward, pull - slope * bend),
        of(Guard::Backward, -pull - slope * bend),
        of(Guard::Rise, bend),
        of(Guard::Sink, -bend),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// When what is left (m) will be used up at a speed (m/s) and its rate (m/s²): left = speed t + pull t²/2.
///
/// The root 2·left/(speed + √(speed² + 2·pull·left)), which loses no digits where the pull is small or slows
/// it down.
#[inline(always)]
fn reached(left: f64, speed: f64, pull: f64) -> f64 {
    // A slowing edge may never get there.
    let reaches = speed * speed + 2.0 * pull * left;
    if speed > 0.0 && reaches > 0.0 && left > 0.0 {
        2.0 * left / (speed + reaches.sqrt())
    } else {
        f64::INFINITY
    }
}
