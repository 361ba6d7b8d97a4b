//! Contacts at both ends of a step, and the zero crossings at its end.
//!
//! Motions and accelerations of all contacts are computed once for each end of a step. Event functions and their rates then cost little.
//! The module [`search`](super::search) evaluates times between the ends.
//!
//! A swap makes the end of a step the start of the next one. After a jump of accelerations, the start is computed again.

use crate::contact::{Contact, Motion};
use crate::equations::{Components, Equations};
use crate::interval::{Closed, Interval};
use crate::model::{Measure, Model};
use arrayvec::ArrayVec;
use stickslip_contact::{Guard, Law, Memory};
use stickslip_stepper::{End, Span, Step};

/// Smallest remaining length of a memory piece at which a step ends, in rounding errors of the positions of its bodies.
const LAST_PLACES: f64 = 2.0;

/// Largest number of free coordinates that are gathered once for all contacts.
const MOST: usize = 8;

/// Contact at one end of a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moving {
    /// d, u and their rates; m, m/s.
    pub(super) motion: Motion,
    /// d̈ and ü, m/s². A waveform that presses the contact directly is not included.
    pub(super) second: (f64, f64),
}

/// Component with a zero crossing, and its event function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fallen {
    /// Index of a contact, and its event function.
    Contact(usize, Guard),
    /// Index of a block, and its event function.
    Block(usize, usize),
}

impl Fallen {
    /// Whether both event functions belong to the same component.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Contact(a, _), Self::Contact(b, _)) | (Self::Block(a, _), Self::Block(b, _)) => a == b,
            _ => false,
        }
    }
}

/// Contacts at both ends of a step, and the zero crossings at its end.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// Contacts at the start of the step.
    pub(super) from: Vec<Moving>,
    /// Contacts at the end of the step.
    pub(super) to: Vec<Moving>,
    /// Indices, in the interval, of contacts with closed-form forces whose event functions may come near zero in the step.
    pub(super) near: Vec<usize>,
    /// Zero crossings at the end of the step.
    pub(super) fired: Vec<Fallen>,
    /// Tolerance of the plan, which scales the near-zero bands of event functions.
    pub(super) tolerance: f64,
    /// Whether only energies are integrated, because no coordinate is free.
    ///
    /// In the first quarter of a step the method has only one weight. The error estimate therefore does not detect the motion of a slip
    /// edge that has just reversed there.
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

    /// Computes the contacts at the start of the next step, after a jump of accelerations.
    pub(super) fn set_out(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let span = solver.span();
        follow(eq, &mut self.from, (span.time, span.begin), |i| solver.slope(i, End::Start));
    }

    /// Computes the contacts at the end of the step.
    pub(super) fn arrive(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let span = solver.span();
        follow(eq, &mut self.to, (span.end_time, span.end), |i| solver.slope(i, End::End));
    }

    /// Computes the contact motions at the end of a cut step.
    ///
    /// Accelerations are unknown there, and no rates are needed. Contacts with closed-form forces far from any event are skipped.
    pub(super) fn arrive_at_cut(&mut self, eq: &Equations<'_>, solver: &impl Step) {
        let (Some(interval), Span { end_time: t, end: y, .. }) = (eq.interval, solver.span()) else { return };
        let n = eq.layout.free;
        for &place in &self.near {
            let steady = &interval.closed[place];
            self.to[steady.index].motion = steady.motion(t, |i| y[i], |i| y[n + i]);
        }
        for c in interval.open_form() {
            self.to[c].motion = interval.motion(eq, c, (t, y));
        }
    }

    /// Makes the end of the step the start of the next one, without evaluation.
    pub(super) fn go_on(&mut self) {
        std::mem::swap(&mut self.from, &mut self.to);
    }

    /// Returns the motion of contact `c` at the end of a step, at time t with components y.
    ///
    /// For a contact with a closed-form force the motion is computed from t and y, because closed-form steps compute no contacts.
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

/// Computes the contacts at time t with components y and with accelerations from `slope`.
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
    if interval.is_closed() {
        return;
    }
    // Most models have few coordinates.
    let mut accelerations = ArrayVec::<f64, MOST>::new();
    if n <= MOST {
        accelerations.extend((0..n).map(|i| slope(n + i)));
    }
    for c in interval.open_form() {
        let motion = interval.motion(eq, c, (t, y));
        let second = match &interval.levers[c] {
            Some(lever) if n <= MOST => lever.second(t, &accelerations),
            _ => second(eq, &eq.model.contacts[c], (t, y), slope),
        };
        contacts[c] = Moving { motion, second };
    }
}

/// Returns d̈ and ü of a contact, m/s², from the accelerations of the coordinates.
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
    /// Returns the time until the first contact is expected to reverse or to leave full stick, s from the start of the step.
    pub(super) fn turn(&self, eq: &Equations<'_>) -> f64 {
        let Some(interval) = eq.interval else { return f64::INFINITY };
        let falls = |value: f64, rate: f64| {
            if value > 0.0 && rate < 0.0 { -value / rate } else { f64::INFINITY }
        };
        let mut soonest = f64::INFINITY;
        for steady in &interval.closed {
            let Moving { motion, second: (_, pull) } = &self.from[steady.index];
            let value = steady.guard(Guard::Drag, motion);
            soonest = soonest.min(falls(value, steady.guard_rate(Guard::Drag, motion, *pull)));
        }
        for &c in &interval.others {
            let (contact, law, Moving { motion, second }) = (&eq.model.contacts[c], eq.law(c), &self.from[c]);
            for guard in law.1.edges() {
                let value = guard.value(contact, law, motion);
                soonest = soonest.min(falls(value, guard.rate(contact, law.1, motion, *second)));
            }
        }
        soonest
    }

    /// Returns the contact with a closed-form force that is expected to reach the end of its memory piece first, and the time.
    ///
    /// The time counts in s from the start of the step, which has the components `begin`. `None` if no slip edge reaches the end of its
    /// memory piece with the current motion.
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
            // Only the earliest contacts are checked for rounding.
            if when < soonest && !is_rounding(left, steady.contact, |i| begin[i]) {
                (first, soonest) = (Some((steady.index, when)), when);
            }
        }
        first
    }

    /// Returns the time until a contact without a closed-form force is expected to reach the end of its memory piece, s.
    ///
    /// For a spring row it is the time until the next spring changes its state.
    ///
    /// The result is ∞ if no slip edge reaches the end of its memory piece with the current motion.
    pub(super) fn expected_of(&self, eq: &Equations<'_>, c: usize, solver: &impl Step) -> f64 {
        let (contact, law) = (&eq.model.contacts[c], &eq.modes[c]);
        let Moving { motion, second } = self.from[c];
        if law.lull().is_some() {
            return lull_end(contact, eq.law(c), &motion, second);
        }
        let Some(branch) = law.branch() else { return f64::INFINITY };
        // Gross slip has no end and must not hide the ends of other contacts.
        if branch.is_gross() {
            return f64::INFINITY;
        }
        let left = branch.margin(motion.d, motion.u);
        // Where a load returns to its maximum, u stops within rounding long before. No step waits for that end.
        let rests = contact.balanced && left < Guard::Piece.bands(contact, self.tolerance, motion.u).1;
        if rests || is_rounding(left, contact, |i| solver.span().begin[i]) {
            return f64::INFINITY;
        }
        let speed = Guard::Drag.value(contact, eq.law(c), &motion);
        // An edge that has just reversed has a speed of zero within rounding. A step must not miss the loss of damping
        // there, and no error estimate shows it.
        let turns =
            (contact.is_damped() || self.integrates_works) && branch.ends_in_gross_slip(&contact.interface);
        let speed = if turns { speed.max(f64::MIN_POSITIVE) } else { speed };
        let pull = Guard::Drag.rate(contact, law, &motion, second);
        reached(left, speed, pull)
    }
}

/// Whether the remaining length of a memory piece (m) is below [`LAST_PLACES`] rounding errors of the positions that determine u.
///
/// `x` returns a free coordinate. No step is shortened for such an end of a piece; a later step finds it.
fn is_rounding(left: f64, contact: &Contact, x: impl Fn(usize) -> f64) -> bool {
    left < LAST_PLACES * f64::EPSILON * contact.u.travel(x)
}

/// Returns when the first spring of a row is expected to touch, separate or slip, s from now.
fn lull_end(contact: &Contact, law: (&Memory, &Law), at: &Motion, (bend, pull): (f64, f64)) -> f64 {
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

/// Returns the time t after which a length `left` (m) has been covered: left = speed t + pull t²/2.
///
/// The speed is in m/s, the acceleration `pull` in m/s².
///
/// The time t is the root 2·left/(speed + √(speed² + 2·pull·left)), a form without cancellation.
#[inline(always)]
fn reached(left: f64, speed: f64, pull: f64) -> f64 {
    // A decelerating edge may stop before.
    let reaches = speed * speed + 2.0 * pull * left;
    if speed > 0.0 && reaches > 0.0 && left > 0.0 {
        2.0 * left / (speed + reaches.sqrt())
    } else {
        f64::INFINITY
    }
}
