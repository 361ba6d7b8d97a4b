//! Allowed error of each component of a step.
//!
//! The error of a step is measured in units of the allowed error. An allowed error is the tolerance times a natural scale, so that one
//! tolerance suits every model. An allowed error is never below the rounding error of the compared quantities, which no shorter step
//! reduces. Allowed errors are set at events and rejections, not at every step.

use super::shift::FAR;
use crate::Model;
use crate::contact::{Contact, PLACES};
use crate::equations::{Components, Equations};
use crate::model::{Binding, Body, Link, Measure, Stroke};
use crate::state::{Allowed, State};
use stickslip_contact::Site;

/// Factor on the tolerance where the force law has kinks that are no events.
///
/// Examples are profiles given as lists of springs, and spring rows under a varying normal force. Error estimates of
/// high order detect such kinks late.
const KINKS: f64 = 1e-3;
/// Factor on the tolerance where a contact passes bends of its stiffness, with varying indentation or contact damping.
///
/// A tabulated normal law has bends at its points, and a tipped paraboloid has one at the end of its cone.
const BENDS: f64 = 1e-2;
/// Factor of the tolerance for a contact with damping along the normal, whose impacts each add an error of the energies.
const IMPACTS: f64 = 0.1;
/// Smallest factor on the tolerance where a free body rests on spring rows under constant normal forces.
///
/// Springs slip one by one without ending a step. The factor is 1 down to [`ROWS_FROM`] and decreases with the tolerance below.
const ROWS: f64 = 1e-2;
/// Tolerance down to which the error estimates resolve the kinks of spring rows under constant normal forces.
const ROWS_FROM: f64 = 1e-7;
/// Smallest tolerance that rounding permits.
const FINEST: f64 = 1e-13;
/// Time over which rounding errors of fast strokes and prescribed motions are allowed, in 1/ω of the fastest oscillation.
const RUSH: f64 = 0.1;
/// Tolerance below which rounding errors of fast prescribed motions are allowed for contacts, too.
const RUSH_BELOW: f64 = 1e-8;

/// Friction coefficient below which u_c may be smaller than the rounding of positions.
const FAINT: f64 = 1e-4;

/// Finite difference for derivatives, in natural scales.
///
/// The difference is far below a tenth of u_c, where contact forces become nonlinear, and far above rounding.
const DIFFERENCE: f64 = 1e-7;

/// Allowed absolute errors of a step.
pub(super) struct Allowance {
    /// Current values.
    pub(super) allowed: Allowed,
    /// Tolerance of the run.
    tolerance: f64,
    /// Tolerance of the error estimates, relative to natural scales.
    pub(super) strict: f64,
    /// Natural scale of work, J.
    work: f64,
    /// Relative rounding error of energies in a model without friction, strokes and prescribed motions; 0 otherwise.
    rounding: f64,
    /// Fraction of the kinetic energy that is rounding error of energies in a model with friction; 0 otherwise.
    moving: f64,
    /// Rounding error of the work done by waveforms, J.
    least: f64,
    /// Whether a friction coefficient is so small that the tolerance may be below the rounding of positions.
    is_faint: bool,
}

impl Allowance {
    /// Creates the allowed errors that do not change in a run, such as those of forces of growing contacts.
    ///
    /// Energies have allowed errors, too, so that the energy balance is satisfied within the tolerance. `tolerance` is relative to the
    /// natural scales u_c, u_cω, μF_N and μF_N u_c.
    pub(super) fn new(model: &Model, tolerance: f64, mut scale: Vec<f64>) -> Self {
        let part = model.contacts.iter().map(|contact| part(model, contact, tolerance)).fold(1.0, f64::min);
        let strict = if part < 1.0 { (part * tolerance).max(f64::min(tolerance, FINEST)) } else { tolerance };
        let layout = model.layout();
        scale.clear();
        scale.resize(layout.total(), 0.0);
        for contact in &model.contacts {
            if let Some(slot) = contact.slot {
                let limit = contact.friction_limit();
                // Without friction there is no limit and no force, so any scale is suitable.
                let natural = if limit > 0.0 { limit } else { 1.0 };
                scale[layout.force(slot)] = natural * (strict * contact.natural.sweep).max(PLACES);
            }
        }
        for balanced in &model.balanced {
            if let Some(slot) = balanced.slot {
                let lengths = balanced.contacts.iter().map(|(c, _)| model.contacts[*c].natural.displacement);
                scale[layout.balanced(slot)] = strict * lengths.fold(f64::INFINITY, f64::min);
            }
        }
        for wired in &model.blocks {
            let first = layout.block(wired.first);
            // Blocks define their own natural scales.
            let own = scale[first..].iter_mut().zip(&wired.states.scales);
            own.for_each(|(scale, natural)| *scale = strict * natural);
        }
        let rubs = model.contacts.iter().any(|contact| contact.friction_limit() > 0.0);
        let follows = |body: &Body| body.bindings.iter().any(|place| matches!(place, Binding::Driven(_)));
        let strokes = model.links.iter().any(|link| matches!(link.stroke, Stroke::Driven(_)));
        let is_told = rubs || strokes || model.bodies.iter().any(follows);
        let rounding = if is_told { 0.0 } else { PLACES };
        let least = model.contacts.iter().map(Contact::rounding).fold(model.balanced_rounding(), f64::max);
        let is_faint = model
            .contacts
            .iter()
            .any(|contact| (f64::MIN_POSITIVE..FAINT).contains(&contact.interface.friction()));
        let work = model.work_scale();
        // Without friction, small works matter: at resonance every period adds the same work.
        let moving = if rubs { f64::EPSILON } else { 0.0 };
        let allowed = Allowed { scale, power: 0.0 };
        Self { allowed, tolerance, strict, work, rounding, moving, least, is_faint }
    }

    /// Sets the allowed errors at a state: the tolerance times natural scales, but at least rounding errors.
    ///
    /// With the spacing ε of doubles at 1, the power P of prescribed motions and work W where only loads move bodies:
    ///
    /// * position: tolerance·length + 8ε|x|, at least ε|v|·length/speed;
    /// * velocity: tolerance·speed + 8ε|x|·speed/length + 8ε|v|;
    /// * work: tolerance·μF_N u_c + 8εtP + 8ε|W|, at least 2ε of the kinetic energy.
    ///
    /// A stricter tolerance for kinks or bends adds at most the rounding error of [`surge`].
    pub(super) fn set(&mut self, model: &Model, state: &State) {
        let layout = model.layout();
        let Allowed { scale, power } = &mut self.allowed;
        let mut kinetic = 0.0_f64;
        for (i, free) in model.free.iter().enumerate() {
            let (length, speed) = free.scale;
            // Rounding of a large displacement causes errors of the contact force and hence of the velocity.
            let (x, v) = (PLACES * state.y[i].abs(), PLACES * state.y[layout.velocity(i)].abs());
            let rate = state.y[layout.velocity(i)].abs();
            // Near 0 a position has the rounding error of the distance covered in a step.
            scale[i] = (self.strict * length + x).max(f64::EPSILON * rate * (length / speed));
            kinetic += free.mass * rate * rate;
            scale[layout.velocity(i)] = self.strict * speed + x * (speed / length) + v;
        }
        // Time is rounded to εt, in which a follower of power P does the work Pεt.
        let work = self.strict * self.work + PLACES * state.t * *power;
        // A stricter tolerance must not be below the rounding error.
        let beyond = (self.tolerance - self.strict) * self.work;
        let noise = if beyond > 0.0 { PLACES * state.t * surge(model, state) } else { 0.0 };
        // Loads that move bodies far do work far above the natural scale.
        let gone = self.rounding * (state.y[layout.input()].abs() + state.y[layout.damping()].abs());
        let least = (self.moving * kinetic).max(self.least);
        scale[layout.dimension()..].fill((work + noise.min(beyond) + gone).max(least));
        if model.contacts.len() > 1 {
            self.allow_walked(model, state);
        }
        let scale = &mut self.allowed.scale;
        if self.is_faint {
            allow_places(model, state, scale);
        }
        // Without oscillation there is no such step.
        let by_contacts = self.strict < RUSH_BELOW;
        if model.fastest > 0.0 && (by_contacts || !model.links.is_empty()) {
            allow_rush(model, state, scale, by_contacts);
        }
    }
}

impl Allowance {
    /// Sets the allowed errors of the energies of contacts with prescribed motions only, relative to their own scale of work.
    ///
    /// Larger energies of other contacts do not matter, because no free coordinate connects them.
    fn allow_walked(&mut self, model: &Model, state: &State) {
        let layout = model.layout();
        for contact in model.contacts.iter().filter(|contact| contact.is_walked()) {
            let Some(slot) = contact.slot else { continue };
            let work = contact.natural_work();
            if work > 0.0 {
                let power = power(contact, &Equations::on(model, state, layout), state);
                let own =
                    (self.strict * work + PLACES * state.t * power / contact.count).max(contact.rounding());
                for place in [layout.elastic(slot), layout.friction(slot)] {
                    let scale = &mut self.allowed.scale[place];
                    *scale = scale.min(own);
                }
            }
        }
    }
}

/// Returns the factor by which a contact reduces the tolerance.
fn part(model: &Model, contact: &Contact, tolerance: f64) -> f64 {
    let is_row = !contact.engine.branches();
    let profile = contact.interface.profile();
    let passes = contact.interface.damping() > 0.0 || !contact.is_constant();
    if profile.has_kinks() || is_row && !contact.is_constant() {
        KINKS
    } else if contact.normal_damping > 0.0 {
        IMPACTS
    } else if passes && profile.has_bends() {
        BENDS
    } else if is_row && !contact.inert && !contact.has_lulls() && !model.free.is_empty() {
        (tolerance / ROWS_FROM).clamp(ROWS, 1.0)
    } else {
        1.0
    }
}

/// Returns the finite difference for each coupled component of a model.
pub(super) fn differences(model: &Model) -> Vec<f64> {
    let mut natural = Allowance::new(model, 1.0, Vec::new());
    natural.set(model, &model.rest());
    let unit = DIFFERENCE / natural.strict;
    let coupled = model.layout().dimension();
    natural.allowed.scale[..coupled].iter().map(|scale| unit * scale).collect()
}

/// Raises the allowed errors to rounding errors of time in fast strokes and prescribed motions, and of large positions.
///
/// The time of a stage is rounded to εt. The force of a spring or actuator changes at the rate F' = kṡ + cs̈, the force of a contact at
/// mω²u̇ of its prescribed motion. Accelerations thus have errors of εtF'/m and powers of εtF'ṡ. The allowed error is their effect over the
/// time [`RUSH`]/ω, with ω of the fastest oscillation.
///
/// Large positions occur for bodies that start far from the origin, and for actuator ends that have moved far.
fn allow_rush(model: &Model, state: &State, scale: &mut [f64], by_contacts: bool) {
    let layout = model.layout();
    let equations = Equations::on(model, state, layout);
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let moment = RUSH / model.fastest;
    let late = f64::EPSILON * state.t;
    let mut work = 0.0;
    let mut push = |force: f64, rate: f64, free: &[(usize, f64)]| {
        let push = moment * force.abs();
        work += push * rate.abs();
        for (i, a) in free {
            let speed = push * a.abs() * model.free[*i].mobility;
            let (place, velocity) = (*i, layout.velocity(*i));
            scale[place] = scale[place].max(speed * moment);
            scale[velocity] = scale[velocity].max(speed);
        }
    };
    for link in model.links.iter().filter(|link| matches!(link.stroke, Stroke::Driven(_))) {
        let stroke = equations.stroke(link, &at);
        let travel = link.elongation.travel(|i| state.y[i]);
        let lengths = link.elongation.free.iter().map(|(i, a)| a.abs() * model.free[*i].scale.0);
        let is_far = travel > FAR * lengths.fold(f64::INFINITY, f64::min);
        let place = if is_far { f64::EPSILON * travel } else { 0.0 };
        let timely = late * (link.stiffness * stroke.rate + link.damping * stroke.acceleration);
        let force = timely.abs() + link.stiffness * place;
        push(force, stroke.rate, &link.elongation.free);
    }
    for contact in model.contacts.iter().filter(|contact| by_contacts && !contact.inert) {
        let rate = |w: usize| equations.signal(w, &at).rate;
        let rate: f64 = contact.u.driven.iter().map(|(w, a)| a * rate(*w)).sum();
        let place = f64::EPSILON * contact.u.constant.abs();
        let Some((first, _)) = contact.u.free.first() else { continue };
        let free = &model.free[*first];
        // Stiffness that holds the coordinate in stick: mω².
        let stiffness = (free.scale.1 / free.scale.0).powi(2) / free.mobility;
        push(stiffness * (late * rate.abs() + place), rate, &contact.u.free);
    }
    scale[layout.dimension()..].iter_mut().for_each(|scale| *scale = scale.max(work));
}

/// Raises the allowed errors to rounding errors of the positions that determine contact displacements and elongations.
///
/// With very small friction, u_c may be only a few rounding errors of a position. The rounding error εx of a position causes the
/// acceleration error kεx/m = ω²εx, and within 1/ω the velocity error ωεx. The force error of an actuator causes an error of its power in
/// the same time.
fn allow_places(model: &Model, state: &State, scale: &mut [f64]) {
    let layout = model.layout();
    let equations = Equations::on(model, state, layout);
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let mut round = |measure: &Measure| {
        let driven: f64 =
            measure.driven.iter().map(|(w, a)| (a * equations.signal(*w, &at).value).abs()).sum();
        let place = f64::EPSILON * (measure.travel(|i| state.y[i]) + driven);
        for (i, a) in &measure.free {
            let (place, (length, speed)) = (place / a.abs(), model.free[*i].scale);
            scale[*i] = scale[*i].max(place);
            scale[layout.velocity(*i)] = scale[layout.velocity(*i)].max(place * (speed / length));
        }
    };
    model.contacts.iter().filter(|contact| !contact.inert).for_each(|contact| round(&contact.u));
    let mut work = 0.0;
    for link in &model.links {
        round(&link.elongation);
        let stroke = equations.stroke(link, &at);
        let force = link.stiffness
            * (stroke.value - link.elongation.value(|i| state.y[i], |w| equations.signal(w, &at).value));
        work += f64::EPSILON * (force * stroke.rate).abs() / model.fastest;
    }
    scale[layout.dimension()..].iter_mut().for_each(|scale| *scale = scale.max(work));
}

/// Returns the increase of the power of strokes in a step h, W: kṡ²h. Rounding of the time of a stage causes such an error.
///
/// The step h is at most 1/ω of the fastest oscillation.
fn surge(model: &Model, state: &State) -> f64 {
    if model.links.is_empty() {
        return 0.0;
    }
    let equations = Equations::on(model, state, model.layout());
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let rise = |link: &Link| link.stiffness * equations.stroke(link, &at).rate.powi(2);
    let step = state.step.min(1.0 / model.fastest);
    if step > 0.0 { model.links.iter().map(rise).sum::<f64>() * step } else { 0.0 }
}

/// Returns an upper bound of the power that prescribed motions can put into the contacts, W.
///
/// The bound is μF_N times the prescribed speed. It is computed at corners only, because the speed is constant on a linear piece.
pub(super) fn follower_power(model: &Model, state: &State) -> f64 {
    let equations = Equations::on(model, state, model.layout());
    model.contacts.iter().map(|contact| power(contact, &equations, state)).sum()
}

/// Returns an upper bound of the power that prescribed motions can put into one contact, W.
fn power(contact: &Contact, equations: &Equations<'_>, state: &State) -> f64 {
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let rate = |w: usize| equations.signal(w, &at).rate;
    let speed: f64 = contact.u.driven.iter().map(|(w, a)| a * rate(*w)).sum();
    contact.count * contact.friction_limit() * speed.abs()
}
