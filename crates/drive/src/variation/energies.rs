//! How energies change.
//!
//! What is stored follows from places, velocities and anchors,
//!
//! δE = G\*[∫₀ʰ (u - p)(δu - δp)dm + κ²δd ∫ₕᵈ (d - h')dm] + F_N δd + …,
//!
//! h the height of the slip front; what is put in and what dampers take are led along ([`Works`](super::works::Works)). What friction takes is what is left:
//! led by itself, the variation of its power would grow as h^-½ where the last springs of a ball begin to slip.

use super::Variation;
use super::parameter::{Moment, Parameter, edge, lines};
use crate::contact::{Contact, Mode, Motion};
use crate::equations::{Components, Equations};
use crate::model::Binding;
use crate::scene::Axis;
use crate::state::State;
use stickslip_contact::{Memory, Profile};

/// Derivatives of the energies of a run, as its books have them: by a number, J, or by the time, W.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyRates {
    /// Put in since the start.
    pub input: f64,
    /// Of motion.
    pub kinetic: f64,
    /// Stored in contacts and links.
    pub elastic: f64,
    /// Lost to friction since the start.
    pub friction: f64,
    /// Lost to dampers since the start.
    pub damping: f64,
}

/// m, M and N at a height; and what a profile that moves makes of them.
type Sums = [f64; 3];

/// A contact at a moment.
struct Pressed<'a> {
    contact: &'a Contact,
    memory: &'a Memory,
    motion: Motion,
    /// d, the height of its slip front (m), and the slope σκ of its edge.
    edge: [f64; 3],
}

impl Variation<'_> {
    /// How the energies of the run change by number `j` where it stands. None where the variation has not led them along
    /// ([`Self::with_energies`]), was not made by [`Model::variation`](crate::Model::variation), or a waveform has jumped.
    #[must_use]
    pub fn energies(&self, state: &State, j: usize) -> Option<EnergyRates> {
        let [origin, before] = self.works.beginning(j)?;
        let (parameter, column) = (self.parameters.get(j)?, self.column(j)?);
        let (model, layout) = (self.model, self.layout);
        let mut rates = EnergyRates { damping: self.works.damping(j), ..EnergyRates::default() };
        rates.input = self.works.input(j) + before + model.lifted(|i| column[i]);
        for (i, free) in model.free.iter().enumerate() {
            let (v, moved) = (state.y[layout.velocity(i)], column[layout.velocity(i)]);
            let [force, _] = parameter.coordinate(i);
            rates.input += force * (state.shifts[i] + state.y[i]);
            rates.kinetic += free.mass * v * moved + 0.5 * parameter.mass(i) * v * v;
        }
        let at = Moment::of(self.model, state);
        for contact in &model.contacts {
            let [normal, tangential] = self.stored(contact, state, (parameter, j, at))?;
            rates.elastic += contact.count * (normal + tangential);
            // What presses it puts that in.
            if !contact.is_constant() && contact.coupling().is_none() {
                rates.input += contact.count * normal;
            }
        }
        rates.elastic += self.strained(state, (parameter, column, at));
        let stored = rates.kinetic + rates.elastic - origin;
        rates.friction = rates.input - stored - rates.damping;
        Some(rates)
    }

    /// How fast the energies of the run itself change where it stands, W: how they go on with the time.
    #[must_use]
    pub fn powers(&self, state: &State) -> EnergyRates {
        let (model, layout, slopes) = (self.model, self.layout, self.slopes(state));
        let eq = Equations::on(model, state, layout, false);
        let velocity = |i: usize| state.y[layout.velocity(i)];
        let (input, damping) = (slopes[layout.input()] + model.lifted(velocity), slopes[layout.damping()]);
        let mut powers = EnergyRates { input, damping, ..EnergyRates::default() };
        for (i, free) in model.free.iter().enumerate() {
            powers.kinetic += free.mass * velocity(i) * slopes[layout.velocity(i)];
        }
        for contact in &model.contacts {
            let motion = eq.motion(contact, state.t, |i| state.y[i]);
            if !contact.is_constant() && contact.coupling().is_none() {
                powers.input += contact.count * contact.interface.normal_force(motion.d) * motion.dd;
            }
            if !contact.inert {
                let rates = contact.growth_rates(eq.law(contact.place), &motion, 0.0);
                powers.friction += contact.count * rates.friction;
            }
        }
        powers.elastic = powers.input - powers.kinetic - powers.friction - powers.damping;
        powers
    }

    /// Acceleration of a free coordinate of a body where the run stands, m/s² or rad/s²; none of one that is not free.
    #[must_use]
    pub fn acceleration(&self, state: &State, index: usize, axis: Axis) -> Option<f64> {
        match self.model.bodies.get(index)?.bindings[axis as usize] {
            Binding::Free(i) => self.slopes(state).get(self.layout.velocity(i)).copied(),
            Binding::Held(_) | Binding::Driven(_) => None,
        }
    }

    /// How F_x of a contact changes by number `j` where its slide turns, as it does now, and the limit of friction, N, of all its identical
    /// members: with the moment of the turn, which moves by -δu̇/ü where what presses it varies. None where it is apart, or has
    /// events that accumulate.
    #[must_use]
    pub fn turn(&self, state: &State, contact: usize, j: usize) -> Option<[f64; 2]> {
        let (contact, parameter) = (self.model.contacts.get(contact)?, self.parameters.get(j)?);
        let at = Moment::of(self.model, state);
        let eq = Equations::on(self.model, state, self.layout, false);
        let motion = eq.motion(contact, state.t, |i| state.y[i]);
        let (law, (du, dd)) = (&contact.interface, *self.moved(contact, at).get(j)?);
        let swells = motion.dd != 0.0;
        let dd = dd + if swells { motion.dd * self.turns_later(contact, state, (parameter, j)) } else { 0.0 };
        let whole = law.stick_stiffness(motion.d);
        let pull = match state.law(contact.place) {
            (memory, Mode::Slip(branch)) => {
                let front = if branch.is_gross() { 0.0 } else { contact.front(memory, branch, &motion) };
                let edge = edge(contact, branch.sense(), front, &motion);
                let along = law.stick_stiffness(front);
                let held = self.held[contact.place].below(law.profile(), front, j);
                let force = contact.force(state.law(contact.place), &motion, || 0.0);
                along * du + edge[2] * (whole - along) * dd - law.tangential_modulus() * held
                    + parameter.pull(contact, memory, force, edge)
            }
            // F_x is a state, which stands still with the slide.
            (_, Mode::Grow) => *self.column(j)?.get(self.layout.force(contact.slot?))?,
            _ => return None,
        };
        // κG*M(d)
        let (slope, modulus) = (law.stick_slope(), law.tangential_modulus());
        let steeper = parameter.slope(contact.place) + slope * parameter.tangential(contact.place);
        let swell = whole * dd + modulus * parameter.reduced(contact.place, motion.d);
        let limit = steeper * modulus * law.reduced_force(motion.d) + slope * swell;
        Some([pull, limit].map(|force| contact.count * force))
    }

    /// By how much later a slide turns by number `j`, s.
    fn turns_later(&self, contact: &Contact, state: &State, (parameter, j): (&Parameter, usize)) -> f64 {
        let Some(column) = self.column(j) else { return f64::NAN };
        let eq = Equations::on(self.model, state, self.layout, false);
        let (slopes, velocity) = (self.slopes(state), |i: usize| self.layout.velocity(i));
        let view = Components { t: state.t, y: |i: usize| state.y[i] };
        let pull = eq.acceleration(&contact.u, &view, |i| slopes[velocity(i)]);
        let shift = parameter.shift(contact, Moment::of(self.model, state));
        let faster: f64 = contact.u.free.iter().map(|(i, a)| a * column[velocity(*i)]).sum();
        -(faster + shift.du) / pull
    }

    /// How the energy of links changes, J.
    fn strained(&self, state: &State, (parameter, column, at): (&Parameter, &[f64], Moment<'_>)) -> f64 {
        let eq = Equations::on(self.model, state, self.layout, false);
        let view = Components { t: state.t, y: |i: usize| state.y[i] };
        let of = |(l, link): (usize, &crate::model::Link)| {
            let (length, stroke) = (eq.read(&link.elongation, &view).value, eq.stroke(link, &view).value);
            let (rates, moved) = (parameter.link_rates(l), parameter.stretched(self.model, l, at));
            let own: f64 = link.elongation.free.iter().map(|(i, a)| a * column[*i]).sum();
            let stretch = stroke - length;
            link.stiffness * stretch * (moved.stretch - own) + 0.5 * rates.stiffness * stretch * stretch
                - rates.preload * length
                - link.preload * (moved.length + own)
        };
        self.model.links.iter().enumerate().map(of).sum()
    }

    /// How the energy of one contact changes, along both directions, J.
    fn stored(
        &self,
        contact: &Contact,
        state: &State,
        (parameter, j, at): (&Parameter, usize, Moment<'_>),
    ) -> Option<[f64; 2]> {
        let eq = Equations::on(self.model, state, self.layout, false);
        let (motion, (memory, mode)) =
            (eq.motion(contact, state.t, |i| state.y[i]), state.law(contact.place));
        let moved = *self.moved(contact, at).get(j)?;
        let normal = contact.interface.normal_force(motion.d) * moved.1
            + parameter.normal_energy(contact, motion.d.max(0.0));
        let tangential = match mode {
            _ if contact.inert => 0.0,
            Mode::Open => 0.0,
            Mode::Grow => self.works.grown(contact.slot?, j),
            Mode::Slip(branch) => {
                let front = if branch.is_gross() { 0.0 } else { contact.front(memory, branch, &motion) };
                let edge = edge(contact, branch.sense(), front, &motion);
                let pressed = Pressed { contact, memory, motion, edge };
                self.sheared(&pressed, moved, (parameter, j))
            }
            Mode::Whole { .. } | Mode::Lull { .. } => return None,
        };
        Some([normal, tangential])
    }

    /// How the energy of springs along the slide changes, J: of those below the front by their anchors, above it by the edge.
    pub(super) fn held_energy(&self, contact: &Contact, state: &State, moved: (f64, f64), j: usize) -> f64 {
        let eq = Equations::on(self.model, state, self.layout, false);
        let motion = eq.motion(contact, state.t, |i| state.y[i]);
        let memory = &state.memories[contact.place];
        let first = self.count() - self.parameters.len();
        let Some(parameter) = j.checked_sub(first).and_then(|j| self.parameters.get(j)) else { return 0.0 };
        let pressed = Pressed { contact, memory, motion, edge: [motion.d, motion.d.max(0.0), 0.0] };
        self.sheared(&pressed, moved, (parameter, j))
    }

    fn sheared(&self, of: &Pressed<'_>, (du, dd): (f64, f64), (parameter, j): (&Parameter, usize)) -> f64 {
        let Pressed { contact, memory, motion, edge: [d, front, slope] } = of;
        let (c, law) = (contact.place, &contact.interface);
        let (sums, top) = (sums(law.profile(), *front), sums(law.profile(), *d));
        let (once, twice) = above([*d, *front], sums, top);
        let turn = slope.signum() * parameter.slope(c);
        // Twice the energy over G*, and half of how that changes.
        let mut square = slope * slope * twice;
        let mut moved = slope * slope * dd * once + slope * turn * twice;
        let mut swell = 0.0;
        if let (Some(low), Some(high)) = (parameter.sums(c, *front), parameter.sums(c, *d)) {
            swell += slope * slope * above([*d, *front], low, high).1;
        }
        let Memory::Curve(curve) = memory else { return 0.0 };
        let heights: Vec<f64> = curve.knots().map(|(h, _)| h).collect();
        for (piece, [anchor, grade]) in lines(memory).into_iter().enumerate() {
            let (low, high) = (heights[piece], heights.get(piece + 1).map_or(*front, |h| h.min(*front)));
            if low >= high {
                break;
            }
            let [a, b] = self.anchors[c].line(piece, j).unwrap_or_default();
            let stretch = [motion.u - anchor, -grade];
            let lengths = |h: f64| self::sums(law.profile(), h);
            let over = between([low, high], [lengths(low), lengths(high)]);
            square += product(stretch, stretch, over);
            moved += product(stretch, [du - a, -b], over);
            if let (Some(from), Some(to)) = (parameter.sums(c, low), parameter.sums(c, high)) {
                swell += product(stretch, stretch, between([low, high], [from, to]));
            }
        }
        law.tangential_modulus() * (moved + 0.5 * (swell + parameter.tangential(c) * square))
    }
}

fn sums(profile: &Profile, h: f64) -> Sums {
    [profile.reduced_stiffness(h), profile.reduced_force(h), profile.reduced_energy(h)]
}

/// ∫dm, ∫h dm and ∫h² dm between two heights.
fn between([low, high]: [f64; 2], [from, to]: [Sums; 2]) -> Sums {
    let moments =
        |h: f64, [m, force, energy]: Sums| [m, h * m - force, h * (h * m - 2.0 * force) + 2.0 * energy];
    let (from, to) = (moments(low, from), moments(high, to));
    [to[0] - from[0], to[1] - from[1], to[2] - from[2]]
}

/// ∫(a + bh)(a' + b'h)dm.
fn product([a, b]: [f64; 2], [other, slope]: [f64; 2], [none, once, twice]: Sums) -> f64 {
    a * other * none + (a * slope + b * other) * once + b * slope * twice
}

/// ∫(d - h')dm and ∫(d - h')² dm from the front to d.
fn above([d, front]: [f64; 2], [m, force, energy]: Sums, [_, whole, all]: Sums) -> (f64, f64) {
    let rise = d - front;
    let once = whole - force - rise * m;
    (once, 2.0 * (all - energy - rise * force) - rise * rise * m)
}
