//! Positions of quasi-static (massless, "balanced") coordinates, from the balance of forces.
//!
//! The balance is k q + Σ a F(a q + rest) = P. For a single contact it is solved in closed form; otherwise bracketed Newton iterations
//! reach rounding. Every contact force F continues beyond the event that ends its law and increases with q, so the solution is unique.
//! Rates follow from the differentiated balance.
//!
//! Along x the indentations of the contacts are known, because normal forces do not depend on x.

mod books;

use super::sum::{Components, View};
use super::{Equations, Sample};
use crate::contact::{Contact, Motion};
use crate::model::{Balanced, Link, Pull};
use crate::scene::Axis;

/// Largest number of iterations for one position.
const STEPS: u32 = 200;
/// Number of iterations after which bisection replaces Newton's method, which may cycle between the kinks of a row of springs.
const NEWTON: u32 = 40;
/// Largest search distance, in natural lengths; if there is no balance up to there, no force holds the body.
const FARTHEST: f64 = 1e15;

/// Time step of numerical differentiation as a fraction of the time to the end of a law, and its relative minimum.
const NEAR: f64 = 1e-3;
const NOISE: f64 = 1e-13;

/// Time and state components with type-erased access.
// A fixed type limits the recursion of generic instances.
pub(crate) type Instant<'a> = Components<&'a dyn Fn(usize) -> f64>;

/// Contribution of a contact to the balance of forces on a quasi-static coordinate.
#[derive(Clone, Copy)]
struct Share {
    /// Force of all identical contacts along the coordinate, N.
    force: f64,
    /// Derivative of the force with respect to the coordinate, N/m.
    stiffness: f64,
    /// Time derivative of the force at constant coordinate, N/s.
    drift: f64,
}

impl Equations<'_> {
    /// Returns the position of quasi-static coordinate `b`, m, with its time derivatives.
    #[inline(never)]
    pub(super) fn balanced(&self, b: usize, at: &impl View) -> Sample {
        let read = |i: usize| at.component(i);
        self.place_and_rates(b, &Components { t: at.time(), y: &read })
    }

    fn place_and_rates(&self, b: usize, at: &Instant<'_>) -> Sample {
        let balanced = &self.model.balanced[b];
        if balanced.contacts.is_empty() {
            let mut sum = self.pull(&balanced.pull, at);
            for &(other, a) in &balanced.led {
                let led = self.place_and_rates(other, at);
                sum.value += a * led.value;
                sum.rate += a * led.rate;
                sum.acceleration += a * led.acceleration;
            }
            return sum;
        }
        let value = self.place_of(b, at);
        let rate = self.rate_of(b, at, value);
        let step = self.moment(balanced, (value, rate), at);
        let near = |dt: f64| self.rate_of(b, &Components { t: at.t + dt, y: at.y }, value + rate * dt);
        let acceleration = (near(step) - near(-step)) / (2.0 * step);
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        Sample { value, rate: finite(rate), acceleration: finite(acceleration) }
    }

    /// Returns the time step for the numerical derivative q̈, s. The step is small compared with the time to gross slip or lift-off, where
    /// rates diverge.
    fn moment(&self, balanced: &Balanced, (place, rate): (f64, f64), at: &Instant<'_>) -> f64 {
        let left = |(c, a): &(usize, f64)| {
            let along = a * place + self.rest(*c, balanced.axis, at).0;
            match (self.modes[*c].branch(), balanced.axis) {
                (_, Axis::Z) => along,
                (Some(branch), _) => {
                    let contact = &self.model.contacts[*c];
                    -branch.beyond(&contact.interface, self.depth_of(contact, at).0, along)
                }
                _ => f64::INFINITY,
            }
        };
        let left =
            balanced.contacts.iter().map(left).filter(|left| *left > 0.0).fold(f64::INFINITY, f64::min);
        let rounding = NOISE * at.t.abs();
        self.model.moment.min((NEAR * left / rate.abs()).max(rounding))
    }

    /// Returns the position of quasi-static coordinate `b`, m.
    pub(crate) fn place_of(&self, b: usize, at: &Instant<'_>) -> f64 {
        let balanced = &self.model.balanced[b];
        if let Some(slot) = balanced.slot.filter(|_| self.carries(balanced)) {
            return at.component(self.layout.balanced(slot));
        }
        let pull = self.pull(&balanced.pull, at).value;
        if let ([(c, a)], true) = (&balanced.contacts[..], balanced.stiffness == 0.0)
            && let Some(place) = self.invert((*c, *a), balanced.axis, pull, at)
        {
            return place;
        }
        self.solve(balanced, pull, at)
    }

    /// Returns whether the position of a coordinate is integrated as a state. This is necessary while a contact grows in full stick,
    /// because its force is then a state and does not depend on u.
    pub(crate) fn carries(&self, balanced: &Balanced) -> bool {
        let grows = |(c, _): &(usize, f64)| self.grows(*c);
        self.layout.growing > 0 && balanced.contacts.iter().any(grows)
    }

    /// Returns whether the tangential force of contact `c` is a state at present.
    fn grows(&self, c: usize) -> bool {
        self.modes[c].grows() && self.model.contacts[c].slot.is_some()
    }

    /// Returns the position at which a single contact balances a load, in closed form; `None` if the contact's law has no inverse.
    fn invert(&self, (c, a): (usize, f64), axis: Axis, pull: f64, at: &Instant<'_>) -> Option<f64> {
        let contact = &self.model.contacts[c];
        let force = pull / (a * contact.count);
        let (rest, _) = self.rest(c, axis, at);
        if axis == Axis::Z {
            return Some(a * (self.modes[c].depth(contact, force) - rest));
        }
        let branch = self.modes[c].branch()?;
        let (d, _) = self.depth_of(contact, at);
        let law = &contact.interface;
        let u = branch.displacement(law, d, force, law.reduced_force(d))?;
        // Where slip crosses memory that formed during growth, only the slip memory has the force.
        branch.covers(d, u).then_some(a * (u - rest))
    }

    /// Returns the position at which the forces balance, m, by bracketed Newton iterations.
    fn solve(&self, balanced: &Balanced, pull: f64, at: &Instant<'_>) -> f64 {
        let (c, a) = balanced.contacts[0];
        let contact = &self.model.contacts[c];
        let (along, scale) = match balanced.axis {
            Axis::Z => (contact.natural.depth, contact.natural.depth),
            _ => (self.memories[c].apex().u, contact.natural.displacement),
        };
        let start = a * (along - self.rest(c, balanced.axis, at).0);
        let mut place = start;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut reach = scale;
        for step in 0..STEPS {
            let [excess, stiffness] = self.excess(balanced, pull, place, at);
            // Without any stiffness every position is equivalent: keep it.
            if excess == 0.0 || step == 0 && stiffness == 0.0 {
                break;
            }
            if excess > 0.0 {
                high = place;
            } else {
                low = place;
            }
            let newton = place - excess / stiffness;
            let inside = newton > low && newton < high;
            let next = if inside && (step < NEWTON || !(high - low).is_finite()) && newton.is_finite() {
                newton
            } else if (high - low).is_finite() {
                0.5 * (low + high)
            } else {
                reach *= 2.0;
                if reach > FARTHEST * scale {
                    return start;
                }
                place - reach.copysign(excess)
            };
            let moved = (next - place).abs();
            place = next;
            if moved <= 2.0 * f64::EPSILON * place.abs().max(f64::EPSILON * scale) {
                break;
            }
        }
        place
    }

    /// Returns the imbalance of forces at a position, N, and the stiffness there, N/m.
    fn excess(&self, balanced: &Balanced, pull: f64, place: f64, at: &Instant<'_>) -> [f64; 2] {
        let mut sum = [balanced.stiffness * place - pull, balanced.stiffness];
        for contact in &balanced.contacts {
            let Share { force, stiffness, .. } = self.share(*contact, balanced.axis, at, place);
            sum = [sum[0] + force, sum[1] + stiffness];
        }
        sum
    }

    /// Returns the rate q̇ = (Ṗ - Σ drift)/(k + Σ stiffness) of a coordinate at a position, m/s.
    fn rate_of(&self, b: usize, at: &Instant<'_>, place: f64) -> f64 {
        let balanced = &self.model.balanced[b];
        let mut pull = self.pull(&balanced.pull, at).rate;
        let mut stiffness = balanced.stiffness;
        for contact in &balanced.contacts {
            let share = self.share(*contact, balanced.axis, at, place);
            pull -= share.drift;
            stiffness += share.stiffness;
        }
        pull / stiffness
    }

    /// Returns the contribution of a contact to the balance of forces on a coordinate at a position.
    fn share(&self, (c, a): (usize, f64), axis: Axis, at: &Instant<'_>, place: f64) -> Share {
        let contact = &self.model.contacts[c];
        let (rest, drift) = self.rest(c, axis, at);
        let along = a * place + rest;
        let weight = a * contact.count;
        if axis == Axis::Z {
            let [force, stiffness] = self.modes[c].press(contact, along);
            let stiffness = contact.count * stiffness;
            return Share { force: weight * force, stiffness, drift: a * stiffness * drift };
        }
        let (d, dd) = self.depth_of(contact, at);
        let motion = Motion { d, u: along, dd, du: 0.0 };
        let grown = || contact.slot.map_or(0.0, |slot| at.component(self.layout.force(slot)));
        let [force, stiffness, coupling] =
            self.modes[c].tangents((contact, &self.memories[c]), &motion, grown);
        Share {
            force: weight * force,
            stiffness: contact.count * stiffness,
            drift: weight * (stiffness * drift + coupling * dd),
        }
    }

    /// Returns the part of u (axis x) or d (axis z) of a contact that does not depend on quasi-static coordinates, and its rate.
    fn rest(&self, c: usize, axis: Axis, at: &Instant<'_>) -> (f64, f64) {
        let contact = &self.model.contacts[c];
        let measure = match (axis, contact.coupling()) {
            (Axis::Z, Some(measure)) => measure,
            _ => &contact.u,
        };
        let first = self.pieces.len() + self.blocks.len();
        let (mut value, mut rate) = (0.0, 0.0);
        for &(signal, a) in measure.driven.iter().filter(|(signal, _)| *signal < first) {
            let sample = self.signal(signal, at);
            value += a * sample.value;
            rate += a * sample.rate;
        }
        (measure.constant + value, rate)
    }

    /// Returns the part of a contact's u that does not depend on quasi-static coordinates, m.
    pub(crate) fn rest_along(&self, c: usize, at: &Instant<'_>) -> f64 {
        self.rest(c, Axis::X, at).0
    }

    /// Returns indentation d (m) and rate ḋ (m/s) of a contact.
    fn depth_of(&self, contact: &Contact, at: &Instant<'_>) -> (f64, f64) {
        match contact.coupling() {
            Some(measure) => {
                let reading = self.read(measure, at);
                (reading.value, reading.rate)
            }
            None => self.pressed(contact, at.t),
        }
    }

    /// Returns the sum of loads and spring forces on a quasi-static coordinate, N.
    fn pull(&self, pull: &Pull, at: &Instant<'_>) -> Sample {
        let mut sum = Sample { value: pull.force, rate: 0.0, acceleration: 0.0 };
        let mut add = |sample: Sample, a: f64| {
            sum.value += a * sample.value;
            sum.rate += a * sample.rate;
            sum.acceleration += a * sample.acceleration;
        };
        pull.loads.iter().for_each(|(w, a)| add(self.sample(*w, at.t), *a));
        for (link, a) in &pull.links {
            add(self.end_of(link, at), *a);
        }
        sum
    }

    /// Returns the force of a spring or actuator whose quasi-static ends are at position 0, N.
    fn end_of(&self, link: &Link, at: &Instant<'_>) -> Sample {
        let mut force = self.stroke(link, at);
        force.value -= link.elongation.constant;
        for &(signal, a) in &link.elongation.driven {
            let sample = self.signal(signal, at);
            force.value -= a * sample.value;
            force.rate -= a * sample.rate;
            force.acceleration -= a * sample.acceleration;
        }
        Sample {
            value: link.stiffness * force.value + link.preload,
            rate: link.stiffness * force.rate,
            acceleration: link.stiffness * force.acceleration,
        }
    }
}
