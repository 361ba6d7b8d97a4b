//! Coordinates without mass, whose place satisfies the balance of forces at every moment.
//!
//! A balanced coordinate is a signal that is solved for, and bodies follow it as they follow a waveform: signals are numbered
//! through, waveforms, then blocks, then balanced coordinates. Along each of them
//!
//! k q + Σ a F(a q + rest) = P(t),
//!
//! with the springs' stiffness k (N/m), the contacts' forces F, by ±1 = a in their u or d, and the pull P (N) of loads and of
//! the springs' other ends. Bodies without a contact of their own are eliminated when the model is built: what pulls at the
//! far end of a rig pulls through its springs, and the place of that end follows from the place of the contact.

mod reduced;

use super::{Binding, Body, Link, Measure, Model, Stroke};
use crate::contact::Contact;
use crate::equations::{Equations, Instant};
use crate::scene::{self, Axis, Freedom, Scene, Varying};
use crate::{Field, Part, SceneError, SceneFault, Waveform};
pub(super) use reduced::{assign, springs};

/// A coordinate without mass.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Balanced {
    pub(crate) body: usize,
    /// Along x or z.
    pub(crate) axis: Axis,
    /// Where it is at t = 0, m. Along x where it is drawn: contacts count from there, and the loads of t = 0 move it away in
    /// no time. Along z where it is balanced.
    pub(crate) first: f64,
    /// Contacts that act along it, and how much of their u, or d, one m of it makes: 1 or -1.
    pub(crate) contacts: Vec<(usize, f64)>,
    /// Stiffness of the springs, N/m; of a coordinate without contacts 1.
    pub(crate) stiffness: f64,
    /// What does not depend on the places of contacts, N; of a coordinate without contacts its place, m.
    pub(crate) pull: Pull,
    /// Of one without contacts: balanced coordinates that move it along, and by how much.
    pub(crate) led: Vec<(usize, f64)>,
    /// Its own share, before others were eliminated.
    pub(crate) own: Pull,
    /// Place among the components that carry it while a contact of its own grows; in the order of the coordinates.
    pub(crate) slot: Option<usize>,
}

/// A sum of loads and ends of springs.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Pull {
    /// Constant loads.
    pub(crate) force: f64,
    /// Loads that follow waveforms, and their factors.
    pub(crate) loads: Vec<(usize, f64)>,
    /// Springs and stacks, with what is left of their elongation, and their factors.
    pub(crate) links: Vec<(Link, f64)>,
}

impl Pull {
    /// Adds a multiple of another sum.
    fn add(&mut self, other: &Self, factor: f64) {
        if factor == 0.0 {
            return;
        }
        self.force += factor * other.force;
        self.loads.extend(other.loads.iter().map(|(w, a)| (*w, factor * a)));
        self.links.extend(other.links.iter().map(|(link, a)| (link.clone(), factor * a)));
    }

    /// Largest magnitude, N, by the ranges of the waveforms.
    pub(super) fn widest(&self, range: impl Fn(usize) -> (f64, f64)) -> f64 {
        let wide = |w: usize| {
            let (low, high) = range(w);
            low.abs().max(high.abs())
        };
        let loads: f64 = self.loads.iter().map(|(w, a)| (a * wide(*w)).abs()).sum();
        let link = |link: &Link| {
            let stroke = match link.stroke {
                Stroke::Constant(s) => s.abs(),
                Stroke::Driven(w) => wide(w),
            };
            let driven: f64 = link.elongation.driven.iter().map(|(w, a)| (a * wide(*w)).abs()).sum();
            link.preload.abs() + link.stiffness * (stroke + link.elongation.constant.abs() + driven)
        };
        self.force.abs() + loads + self.links.iter().map(|(l, a)| a.abs() * link(l)).sum::<f64>()
    }
}

/// What a coordinate of a body is bound to where it is balanced; `known` signals come before, `count` balanced ones so far.
pub(super) fn bind(
    (place, body): (usize, &scene::Body),
    axis: Axis,
    (known, all): (usize, &mut Vec<Balanced>),
) -> Result<Binding, SceneError> {
    let refused = |fault: SceneFault, field| Err(fault.of(Part::Body(place), field));
    if axis == Axis::Pitch {
        return refused(SceneFault::BalancedPitch, Field::Coordinate(axis));
    }
    if body.mass.is_some() {
        return refused(SceneFault::BalancedMass(axis), Field::Mass);
    }
    let first = if axis == Axis::X { body.x.position } else { body.z.position };
    all.push(Balanced {
        body: place,
        axis,
        first,
        contacts: Vec::new(),
        stiffness: 0.0,
        pull: Pull::default(),
        led: Vec::new(),
        own: Pull::default(),
        slot: None,
    });
    Ok(Binding::Driven(known + all.len() - 1))
}

/// Part of the shortest waveform over which rates are compared: central differences of it miss a part of 1e-10.
const MOMENT: f64 = 1e-5;

/// How far ahead and back rates are compared for their own rate, s.
pub(super) fn moment(waveforms: &[Waveform]) -> f64 {
    let shortest = waveforms.iter().map(Waveform::extent).fold(f64::INFINITY, f64::min);
    MOMENT * if shortest.is_finite() { shortest } else { 1.0 }
}

impl Model {
    /// The smallest of what balanced coordinates can store, J: a contact at its natural depth, a spring under the widest pull.
    pub(super) fn stored_scale(&self) -> Option<f64> {
        let range = |w: usize| self.signals().range(w);
        let of = |b: &Balanced| {
            let pressed = |(c, _): &(usize, f64)| {
                let contact = &self.contacts[*c];
                contact.count * contact.interface.normal_energy(contact.natural.depth)
            };
            let contacts = b.contacts.iter().filter(|_| b.axis == Axis::Z).map(pressed).sum::<f64>();
            let pull = b.pull.widest(range);
            // Of one that has been eliminated the stiffness is 1, and its pull a length.
            let springs =
                if b.stiffness > 0.0 && !b.contacts.is_empty() { pull * pull / b.stiffness } else { 0.0 };
            contacts + springs
        };
        self.balanced.iter().map(of).filter(|work| work.is_normal()).reduce(f64::min)
    }

    /// What rounding makes of the work of pulls that springs hold, J.
    pub(crate) fn balanced_rounding(&self) -> f64 {
        let held = self.balanced.iter().filter(|b| b.stiffness > 0.0 && !b.contacts.is_empty());
        let stored = held.map(|b| b.pull.widest(|w| self.signals().range(w)).powi(2) / b.stiffness);
        f64::EPSILON * stored.filter(|work| work.is_finite()).fold(0.0, f64::max)
    }

    /// Tells contacts that one balanced coordinate moves how far at most it does while they stick: as far as its pull goes against
    /// springs and contact.
    pub(super) fn sweep_balanced(&mut self) {
        let pulls: Vec<f64> =
            self.balanced.iter().map(|b| b.pull.widest(|w| self.signals().range(w))).collect();
        for (balanced, pull) in self.balanced.iter().zip(pulls).filter(|(b, _)| b.axis == Axis::X) {
            for (c, _) in &balanced.contacts {
                let contact = &mut self.contacts[*c];
                let natural = &mut contact.natural;
                let stuck = contact.count * contact.interface.stick_stiffness(natural.depth);
                let way = pull / (balanced.stiffness + stuck);
                if contact.u.driven.len() == 1 && way > 0.0 && way < natural.displacement {
                    natural.sweep = way / natural.displacement;
                }
            }
        }
    }

    /// Puts balanced coordinates along z where they are at t = 0.
    pub(super) fn settle_balanced(&mut self) {
        if self.balanced.iter().all(|b| b.axis != Axis::Z) {
            return;
        }
        let state = self.rest();
        let equations = Equations::on(self, &state, self.layout(), false);
        let at = Instant { t: 0.0, y: &|i| state.y[i] };
        let places: Vec<f64> = (0..self.balanced.len()).map(|b| equations.place_value(b, &at)).collect();
        for (balanced, place) in self.balanced.iter_mut().zip(places) {
            if balanced.axis == Axis::Z && place.is_finite() {
                balanced.first = place;
            }
        }
    }
}

/// Refuses what a balanced coordinate does not go with: free coordinates, whose forces would depend on the same
/// balance, and blocks.
pub(super) fn check_company(scene: &Scene) -> Result<(), SceneError> {
    let balanced = scene.bodies.iter().enumerate().find_map(|(i, body)| {
        let of = |(_, c): &(Axis, scene::Coordinate)| c.freedom == Freedom::Balanced;
        body.part.coordinates().into_iter().find(of).map(|(axis, _)| (i, axis))
    });
    let Some((i, axis)) = balanced else { return Ok(()) };
    let field = Field::Coordinate(axis);
    if scene.bodies.iter().any(|body| body.part.is_free()) {
        return Err(SceneFault::BalancedBesideFree(axis).of(Part::Body(i), field));
    }
    if !scene.blocks.is_empty() {
        return Err(SceneFault::BalancedBesideBlock(axis).of(Part::Body(i), field));
    }
    Ok(())
}

/// Adds the loads on balanced coordinates to them; `first` is the signal of the first.
///
/// A force at a point beside the reference point turns, which the guide of the pitch carries.
pub(super) fn load(scene: &Scene, bodies: &[Body], (first, all): (usize, &mut [Balanced])) {
    for load in &scene.loads {
        let [x, z, _] = bodies[load.on].bindings;
        for (place, value) in [(x, load.x), (z, load.z)] {
            let Binding::Driven(signal) = place else { continue };
            let Some(balanced) = signal.checked_sub(first).and_then(|b| all.get_mut(b)) else { continue };
            match value {
                Varying::Constant(force) => balanced.own.force += force,
                Varying::Follows(w) => balanced.own.loads.push((w, 1.0)),
            }
        }
    }
}

/// The terms of a measure that balanced coordinates make, by their places, and what is left of it.
fn split(measure: &Measure, first: usize) -> (Vec<(usize, f64)>, Measure) {
    let own = measure.driven.iter().filter(|(s, _)| *s >= first).map(|(s, a)| (s - first, *a)).collect();
    let mut rest = measure.clone();
    rest.driven.retain(|(s, _)| *s < first);
    (own, rest)
}

/// Whether a measure depends on a balanced coordinate.
fn is_balanced(measure: &Measure, first: usize) -> bool {
    measure.driven.iter().any(|(signal, _)| *signal >= first)
}

/// Refuses dampers: their forces depend on velocities, and the place would follow from what was before.
pub(super) fn check_dampers(
    scene: &Scene,
    (links, contacts): (&[Link], &[Contact]),
    first: usize,
) -> Result<(), SceneError> {
    for (i, link) in links.iter().enumerate() {
        if link.damping > 0.0 && is_balanced(&link.elongation, first) {
            let part = match i.checked_sub(scene.springs.len()) {
                None => Part::Spring(i),
                Some(i) => Part::Actuator(i),
            };
            return Err(SceneFault::BalancedDamper.of(part, Field::Damping));
        }
    }
    for (i, contact) in contacts.iter().enumerate() {
        let moved =
            is_balanced(&contact.u, first) || contact.coupling().is_some_and(|d| is_balanced(d, first));
        if contact.interface.damping() > 0.0 && moved {
            return Err(SceneFault::BalancedDamper.of(Part::Contact(i), Field::Damping));
        }
    }
    Ok(())
}

/// The direction of an axis along which forces are balanced.
fn measure_of(contact: &Contact, axis: Axis) -> Option<&Measure> {
    match axis {
        Axis::X => (!contact.inert).then_some(&contact.u),
        Axis::Z => contact.coupling(),
        Axis::Pitch => None,
    }
}
