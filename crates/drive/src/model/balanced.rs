//! Quasi-static (massless, "balanced") coordinates, whose position satisfies a balance of forces.
//!
//! A quasi-static coordinate has no inertia: its value is the equilibrium of forces at each time. For contacts it acts like a prescribed
//! motion. Signals are numbered in the order waveforms, blocks, quasi-static coordinates. Each quasi-static coordinate q satisfies
//!
//! k q + Σ a F(a q + rest) = P(t),
//!
//! with the stiffness k of springs (N/m), the forces F of contacts whose u or d contains a q (a = ±1), and the load P (N). P contains loads
//! and forces of the other ends of springs. Coordinates without a contact are eliminated when the model is built. Their loads act through
//! springs, and their position follows from the coordinates with contacts.

mod reduced;

use super::{Binding, Body, Link, Measure, Model, Stroke};
use crate::contact::Contact;
use crate::equations::{Equations, Instant};
use crate::scene::{self, Axis, Freedom, Scene, Varying};
use crate::{Field, Part, SceneError, SceneFault, Waveform};
pub(super) use reduced::{assign, springs};

/// Quasi-static ("balanced") coordinate of a body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Balanced {
    pub(crate) body: usize,
    /// Axis, x or z.
    pub(crate) axis: Axis,
    /// Position at t = 0, m. Along z this is the equilibrium position. Along x it is the reference position for contacts; the loads of t =
    /// 0 then move the coordinate from this position in zero time.
    pub(crate) first: f64,
    /// Contacts that act along the coordinate, with its coefficient (1 or -1) in their u or d.
    pub(crate) contacts: Vec<(usize, f64)>,
    /// Stiffness of the springs, N/m; 1 for a coordinate without contacts.
    pub(crate) stiffness: f64,
    /// Load that does not depend on contacts, N; for a coordinate without contacts this is its position, m.
    pub(crate) pull: Pull,
    /// Coordinates with contacts that move this coordinate if it has no contacts, with their factors.
    pub(crate) led: Vec<(usize, f64)>,
    /// Load on the coordinate itself, before the elimination of other coordinates.
    pub(crate) own: Pull,
    /// Index of the state that stores the position while one of the coordinate's contacts grows in full stick.
    pub(crate) slot: Option<usize>,
}

/// Sum of loads and spring forces on a quasi-static coordinate.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Pull {
    /// Sum of constant loads, N.
    pub(crate) force: f64,
    /// Loads that follow waveforms, with their factors.
    pub(crate) loads: Vec<(usize, f64)>,
    /// Springs and actuators with the remaining part of their elongation, and their factors.
    pub(crate) links: Vec<(Link, f64)>,
}

impl Pull {
    /// Adds a multiple of another sum of loads.
    fn add(&mut self, other: &Self, factor: f64) {
        if factor == 0.0 {
            return;
        }
        self.force += factor * other.force;
        self.loads.extend(other.loads.iter().map(|(w, a)| (*w, factor * a)));
        self.links.extend(other.links.iter().map(|(link, a)| (link.clone(), factor * a)));
    }

    /// Returns the largest magnitude of the sum over the ranges of the waveforms, N.
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

/// Adds a quasi-static coordinate of a body and returns its binding. `known` is the number of waveforms and blocks.
///
/// Fails for a pitch coordinate, and for a body with a mass.
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

/// Time step of numerical differentiation, relative to the extent of the shortest waveform.
const MOMENT: f64 = 1e-5;

/// Returns the time step of numerical differentiation, s.
pub(super) fn moment(waveforms: &[Waveform]) -> f64 {
    let shortest = waveforms.iter().map(Waveform::extent).fold(f64::INFINITY, f64::min);
    MOMENT * if shortest.is_finite() { shortest } else { 1.0 }
}

impl Model {
    /// Returns the smallest energy that a quasi-static coordinate can store, J: in a contact at its natural indentation, or in a spring
    /// under the largest load.
    pub(super) fn stored_scale(&self) -> Option<f64> {
        let range = |w: usize| self.signals().range(w);
        let of = |b: &Balanced| {
            let pressed = |(c, _): &(usize, f64)| {
                let contact = &self.contacts[*c];
                contact.count * contact.interface.normal_energy(contact.natural.depth)
            };
            let contacts = b.contacts.iter().filter(|_| b.axis == Axis::Z).map(pressed).sum::<f64>();
            let pull = b.pull.widest(range);
            // An eliminated coordinate has stiffness 1, and its load is a length.
            let springs =
                if b.stiffness > 0.0 && !b.contacts.is_empty() { pull * pull / b.stiffness } else { 0.0 };
            contacts + springs
        };
        self.balanced.iter().map(of).filter(|work| work.is_normal()).reduce(f64::min)
    }

    /// Returns the rounding error of the work of loads that springs hold, J.
    pub(crate) fn balanced_rounding(&self) -> f64 {
        let held = self.balanced.iter().filter(|b| b.stiffness > 0.0 && !b.contacts.is_empty());
        let stored = held.map(|b| b.pull.widest(|w| self.signals().range(w)).powi(2) / b.stiffness);
        f64::EPSILON * stored.filter(|work| work.is_finite()).fold(0.0, f64::max)
    }

    /// Sets the stroke of contacts that one quasi-static coordinate moves while they stick: its largest load divided by the stiffness of
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

    /// Sets quasi-static coordinates along z to their equilibrium position at t = 0.
    pub(super) fn settle_balanced(&mut self) {
        if self.balanced.iter().all(|b| b.axis != Axis::Z) {
            return;
        }
        let state = self.rest();
        let equations = Equations::on(self, &state, self.layout());
        let at = Instant { t: 0.0, y: &|i| state.y[i] };
        let places: Vec<f64> = (0..self.balanced.len()).map(|b| equations.place_value(b, &at)).collect();
        for (balanced, place) in self.balanced.iter_mut().zip(places) {
            if balanced.axis == Axis::Z && place.is_finite() {
                balanced.first = place;
            }
        }
    }
}

/// Returns an error if a model has quasi-static coordinates together with free coordinates or blocks.
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

/// Adds external loads to quasi-static coordinates; `first` is the signal index of the first coordinate. Guides of the pitch carry moments.
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

/// Splits a linear form into its terms of quasi-static coordinates and the rest.
fn split(measure: &Measure, first: usize) -> (Vec<(usize, f64)>, Measure) {
    let own = measure.driven.iter().filter(|(s, _)| *s >= first).map(|(s, a)| (s - first, *a)).collect();
    let mut rest = measure.clone();
    rest.driven.retain(|(s, _)| *s < first);
    (own, rest)
}

/// Returns whether a linear form depends on a quasi-static coordinate.
fn is_balanced(measure: &Measure, first: usize) -> bool {
    measure.driven.iter().any(|(signal, _)| *signal >= first)
}

/// Returns an error for a damper on a quasi-static coordinate, because the position would depend on its past.
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
        let presses =
            contact.coupling().is_some_and(|d| is_balanced(d, first)) && contact.normal_damping > 0.0;
        if contact.interface.damping() > 0.0 && moved || presses {
            return Err(SceneFault::BalancedDamper.of(Part::Contact(i), Field::Damping));
        }
        if contact.interface.kinetic().is_some() && is_balanced(&contact.u, first) {
            return Err(SceneFault::BalancedBreak.of(Part::Contact(i), Field::Friction));
        }
    }
    Ok(())
}

/// Returns the displacement (u or d) of a contact along an axis, as a linear form, if the contact exerts a force along this axis.
fn measure_of(contact: &Contact, axis: Axis) -> Option<&Measure> {
    match axis {
        Axis::X => (!contact.inert).then_some(&contact.u),
        Axis::Z => contact.coupling(),
        Axis::Pitch => None,
    }
}
