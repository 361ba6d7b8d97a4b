//! Places of coordinates without mass, solved for where they are asked for.
//!
//! k q + Σ a F(a q + rest) = P: where one contact alone holds, its branch is inverted in closed form; otherwise Newton's
//! steps between bounds go on to rounding. Every F goes on beyond the event that will end its law, and rises with q, so there
//! is one place for every pull, and guards find events by it as they do by any other motion. Rates follow from the same
//! balance, differentiated: q̇ vanishes where the pull's rate does.
//!
//! Along x the depths of the contacts are known first: normal forces do not depend on x.

mod books;

use super::sum::{Components, View};
use super::{Equations, Sample};
use crate::contact::{Contact, Mode, Motion};
use crate::model::{Balanced, Link, Pull};
use crate::scene::Axis;

/// Newton's steps, and halvings of the bounds, of one place.
const STEPS: u32 = 200;
/// Steps after which bounds are halved: a row of springs has kinks, between which Newton's steps may go to and fro.
const NEWTON: u32 = 40;
/// Farthest that bounds are looked for, in natural lengths: beyond it nothing holds.
// A gap of a metre between contacts pressed by a nanometre is 1e9 of them.
const FARTHEST: f64 = 1e15;

/// Part of what is left to the end of a law over which rates are compared, and least of the time.
const NEAR: f64 = 1e-3;
const NOISE: f64 = 1e-13;

/// A moment, read in one way by all that is asked of a balance.
// A type of its own: asked of whatever view each asks of another, the compiler would never see the end of them.
pub(crate) type Instant<'a> = Components<&'a dyn Fn(usize) -> f64>;

/// What a contact adds to the balance of a coordinate.
#[derive(Clone, Copy)]
struct Share {
    /// Force along the coordinate, N, of all identical contacts.
    force: f64,
    /// Its derivative by the coordinate, N/m.
    stiffness: f64,
    /// Its rate at a resting coordinate, N/s.
    drift: f64,
}

impl Equations<'_> {
    /// The place of balanced coordinate `b`, m, and its derivatives.
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

    /// How far ahead and back its rate is compared for q̈, s: so short that no contact comes much nearer to gross slip, or to
    /// its end, where rates grow without bound.
    fn moment(&self, balanced: &Balanced, (place, rate): (f64, f64), at: &Instant<'_>) -> f64 {
        let left = |(c, a): &(usize, f64)| {
            let along = a * place + self.rest(*c, balanced.axis, at).0;
            match (&self.modes[*c], balanced.axis) {
                (_, Axis::Z) => along,
                (Mode::Slip(branch), _) => {
                    -branch.beyond(self.depth_of(&self.model.contacts[*c], at).0, along)
                }
                _ => f64::INFINITY,
            }
        };
        let left =
            balanced.contacts.iter().map(left).filter(|left| *left > 0.0).fold(f64::INFINITY, f64::min);
        let rounding = NOISE * at.t.abs();
        self.model.moment.min((NEAR * left / rate.abs()).max(rounding))
    }

    /// The balanced coordinate's place, m.
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

    /// Whether the place of a coordinate is a state of the run: while a contact grows in full stick its force is one, and
    /// says nothing of u.
    pub(crate) fn carries(&self, balanced: &Balanced) -> bool {
        let grows = |(c, _): &(usize, f64)| self.grows(*c);
        self.layout.growing > 0 && balanced.contacts.iter().any(grows)
    }

    /// Whether the force of contact `c` is a state now.
    fn grows(&self, c: usize) -> bool {
        self.modes[c] == Mode::Grow && self.model.contacts[c].slot.is_some()
    }

    /// The place at which a single contact holds a pull, in closed form; none where its law has no inverse.
    fn invert(&self, (c, a): (usize, f64), axis: Axis, pull: f64, at: &Instant<'_>) -> Option<f64> {
        let contact = &self.model.contacts[c];
        let force = pull / (a * contact.count);
        let (rest, _) = self.rest(c, axis, at);
        if axis == Axis::Z {
            return Some(a * (contact.depth(&self.modes[c], force) - rest));
        }
        let Mode::Slip(branch) = &self.modes[c] else { return None };
        let (d, _) = self.depth_of(contact, at);
        let law = &contact.interface;
        let u = branch.displacement(law, d, force, law.reduced_force(d))?;
        // Where the edge cuts through a path of growth only the memory knows the force.
        branch.covers(d, u).then_some(a * (u - rest))
    }

    /// The root of the balance between bounds.
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
            // Where all slips and nothing holds any place is as good: it stays where it is.
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

    /// What a place is off balance by, N, and the stiffness there, N/m.
    fn excess(&self, balanced: &Balanced, pull: f64, place: f64, at: &Instant<'_>) -> [f64; 2] {
        let mut sum = [balanced.stiffness * place - pull, balanced.stiffness];
        for contact in &balanced.contacts {
            let Share { force, stiffness, .. } = self.share(*contact, balanced.axis, at, place);
            sum = [sum[0] + force, sum[1] + stiffness];
        }
        sum
    }

    /// q̇ = (Ṗ - Σ drift)/(k + Σ stiffness) at a place.
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

    /// What a contact adds to the balance of a coordinate at a place.
    fn share(&self, (c, a): (usize, f64), axis: Axis, at: &Instant<'_>, place: f64) -> Share {
        let contact = &self.model.contacts[c];
        let (rest, drift) = self.rest(c, axis, at);
        let along = a * place + rest;
        let weight = a * contact.count;
        if axis == Axis::Z {
            let [force, stiffness] = contact.press(&self.modes[c], along);
            let stiffness = contact.count * stiffness;
            return Share { force: weight * force, stiffness, drift: a * stiffness * drift };
        }
        let (d, dd) = self.depth_of(contact, at);
        let motion = Motion { d, u: along, dd, du: 0.0 };
        let grown = || contact.slot.map_or(0.0, |slot| at.component(self.layout.force(slot)));
        let [force, stiffness, coupling] =
            contact.tangents((&self.memories[c], &self.modes[c]), &motion, grown);
        Share {
            force: weight * force,
            stiffness: contact.count * stiffness,
            drift: weight * (stiffness * drift + coupling * dd),
        }
    }

    /// What the u (along x) or d (along z) of a contact is without balanced coordinates of that axis, and its rate.
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

    /// u of a contact without balanced coordinates, m.
    pub(crate) fn rest_along(&self, c: usize, at: &Instant<'_>) -> f64 {
        self.rest(c, Axis::X, at).0
    }

    /// d and ḋ of a contact.
    fn depth_of(&self, contact: &Contact, at: &Instant<'_>) -> (f64, f64) {
        match contact.coupling() {
            Some(measure) => {
                let reading = self.read(measure, at);
                (reading.value, reading.rate)
            }
            None => self.pressed(contact, at.t),
        }
    }

    /// A sum of loads and ends of springs.
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

    /// Force of a link whose balanced ends rest at 0, N.
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
