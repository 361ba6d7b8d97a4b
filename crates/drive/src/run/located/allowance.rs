//! What error each component of a step may have.
//!
//! The error of a step is measured in units of these scales, and 1 is just allowed. Scales are the tolerance
//! times natural lengths, so that one tolerance suits every scene, and never less than the rounding of what
//! they are compared with: errors that no shorter step makes smaller would end a run in steps too small. They
//! are set at events and at rejections, not at every step.

use super::shift::FAR;
use crate::Model;
use crate::contact::{Contact, PLACES};
use crate::equations::{Components, Equations};
use crate::model::{Binding, Body, Link, Measure, Stroke};
use crate::state::{Allowed, State};

/// Part of the tolerance that is asked of the estimates where a list of springs puts kinks into the law: they are no events,
/// and the estimates of a method of high order see them late; and where a row under a normal that moves begins a step at
/// every change of a spring. Without it errors were 20 to 1000 times the tolerance.
// With 0.01 a sine drive on 64 heights saves a quarter of its evaluations, for books of the size of the tolerance and twenty
// times the error; 1e-4 costs a quarter more.
const KINKS: f64 = 1e-3;
/// Part of the tolerance that is asked of the estimates where a contact passes bends of its stiffness, as a normal law has at its points and
/// a tipped paraboloid where its cone ends: by an indentation that moves, or by damping, which asks for the stiffness itself.
// Without it errors of drawn scenes are 21 to 510 tolerances from 1e-6 to 1e-11, with it 0.3 to 23 for 1.2 to 4 times the evaluations; with
// 0.1 3 to 140.
const BENDS: f64 = 1e-2;
/// Part of the tolerance that is asked of the estimates where a free body rests on rows under constant normals, whose springs
/// slip one by one and end no step: all of it down to [`ROWS_FROM`], and ever less below, down to this.
// Of 14 drawn scenes errors are up to 1 500 tolerances at 1e-10 without it, and 25 with it, for 1.4 to 2.1 times the evaluations.
// At 1e-8 a tenth takes 1.3 times as many, up to 2, and a hundredth 1.7, up to 3.2; at 1e-6 a hundredth up to 4.2.
const ROWS: f64 = 1e-2;
/// Tolerance down to which the kinks of such rows are left to the estimates.
const ROWS_FROM: f64 = 1e-7;
/// Finest tolerance that rounding leaves room for.
// On heights at a tolerance of 1e-12 books are 2e-11 with it, 1e-10 with 1e-12; with 1e-14 7 % more evaluations gain
// half of that.
const FINEST: f64 = 1e-13;
/// Step, in 1/ω of the fastest natural motion, above which rounding of time in the force of a stroke is no reason to shorten it.
// Without it the flyback of a stage that has run for 0.4 s took steps of 16 ps, 3.1 million of them at a tolerance of 1e-11. With
// 0.001 that period takes 59 600 steps in all, with 0.01 to 8 46 300; with 1 or more a stack at 1e-12 ends in other last digits.
const RUSH: f64 = 0.1;
/// Tolerance below which contacts are asked, too: at it a thousand seconds of a drive that goes by 10⁵ natural lengths a second are not seen.
const RUSH_BELOW: f64 = 1e-8;

/// Friction below which u_c may lie below the rounding of places.
const FAINT: f64 = 1e-4;

/// Differences over which derivatives are taken, in natural scales: far below what bends a contact's force, which is a tenth of
/// u_c and more, and far above rounding.
const DIFFERENCE: f64 = 1e-7;

/// Absolute errors allowed of a step.
pub(super) struct Allowance {
    /// As they are now.
    pub(super) allowed: Allowed,
    /// That of the run.
    tolerance: f64,
    /// What is asked of the error estimates, relative to natural scales.
    pub(super) strict: f64,
    /// Natural scale of work, J.
    work: f64,
    /// Share of a work that is rounding, where no contact and no stroke tells how much of it matters.
    rounding: f64,
    /// Share of the kinetic energy that is rounding of works, beside contacts that rub.
    moving: f64,
    /// What rounding makes of the work that waveforms put in, J.
    least: f64,
    /// Whether a contact's friction is so small that the tolerance may lie below the rounding of places beside it.
    is_faint: bool,
}

impl Allowance {
    /// Of growing contacts' forces; the rest is known step by step. The integrals of work steer the steps as well: energy
    /// books close at the tolerance.
    ///
    /// `tolerance` is relative to natural scales: u_c, u_cω, μF_N and μF_N u_c.
    pub(super) fn new(model: &Model, tolerance: f64, mut scale: Vec<f64>) -> Self {
        let part = model.contacts.iter().map(|contact| part(model, contact, tolerance)).fold(1.0, f64::min);
        let strict = if part < 1.0 { (part * tolerance).max(f64::min(tolerance, FINEST)) } else { tolerance };
        let layout = model.layout();
        scale.clear();
        scale.resize(layout.total(), 0.0);
        for contact in &model.contacts {
            if let Some(slot) = contact.slot {
                let limit = contact.friction_limit();
                // Without friction there is no limit to compare with, and no force either.
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
            // Blocks name their own natural scales: the run knows none of them by kind.
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
        // Where nothing rubs the works have no scale but what moves: a swing at resonance grows by the same in every period.
        let moving = if rubs { f64::EPSILON } else { 0.0 };
        let allowed = Allowed { scale, power: 0.0 };
        Self { allowed, tolerance, strict, work, rounding, moving, least, is_faint }
    }

    /// The tolerance times the natural scale, and never below what rounding of a far-travelled coordinate makes of the force,
    /// or rounding of time of the work of a fast follower.
    ///
    /// With ε the spacing of doubles at 1: positions tolerance·length + 8ε|x|, at least ε|v|·length/speed; velocities
    /// tolerance·speed + 8ε|x|·speed/length + 8ε|v|; works tolerance·μF_N u_c + 8εtP with the power P of the followers,
    /// where more is asked than the tolerance that of [`surge`], and 8ε|W| of works W where loads alone move bodies; at least
    /// 2ε of the kinetic energy.
    // A slider of friction 1e-8 that rests beside two masses on a spring asked for their work to 1e-28 J of 1e-6 J, and the run stood still.
    pub(super) fn set(&mut self, model: &Model, state: &State) {
        let layout = model.layout();
        let Allowed { scale, power } = &mut self.allowed;
        let mut kinetic = 0.0_f64;
        for (i, free) in model.free.iter().enumerate() {
            let (length, speed) = free.scale;
            // A displacement that has travelled far rounds the force of a stiff contact, and the force the
            // velocity.
            let (x, v) = (PLACES * state.y[i].abs(), PLACES * state.y[layout.velocity(i)].abs());
            let rate = state.y[layout.velocity(i)].abs();
            // Near 0 a place has the rounding of the way that a step goes.
            scale[i] = (self.strict * length + x).max(f64::EPSILON * rate * (length / speed));
            kinetic += free.mass * rate * rate;
            scale[layout.velocity(i)] = self.strict * speed + x * (speed / length) + v;
        }
        // The time of a corner is rounded to εt, in which a follower at power P does the work Pεt. Without
        // this term a flyback of a nanosecond or less ended in steps too small.
        let work = self.strict * self.work + PLACES * state.t * *power;
        // What is asked beyond the tolerance gives way where rounding is in it.
        let beyond = (self.tolerance - self.strict) * self.work;
        let noise = if beyond > 0.0 { PLACES * state.t * surge(model, state) } else { 0.0 };
        // A mass that a step of load drives over metres has put in 10¹⁵ times what natural lengths of a micrometre let expect.
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
        // Where nothing swings there is no such step.
        let by_contacts = self.strict < RUSH_BELOW;
        if model.fastest > 0.0 && (by_contacts || !model.links.is_empty()) {
            allow_rush(model, state, scale, by_contacts);
        }
    }
}

impl Allowance {
    /// The works of a contact that only followers move are measured by its own, however much larger others beside it are: nothing free
    /// is between them, whose rounding would be theirs as well.
    // Loops of 1e-14 J beside a contact of 6e-3 J were 1.1 % off at any tolerance.
    fn allow_walked(&mut self, model: &Model, state: &State) {
        let layout = model.layout();
        for contact in model.contacts.iter().filter(|contact| contact.is_walked()) {
            let Some(slot) = contact.slot else { continue };
            let work = contact.natural_work();
            if work > 0.0 {
                let power = power(contact, &Equations::on(model, state, layout, false), state);
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

/// Part of the tolerance that a contact asks of the estimates.
fn part(model: &Model, contact: &Contact, tolerance: f64) -> f64 {
    let is_row = !contact.engine.branches();
    let profile = contact.interface.profile();
    let passes = contact.interface.damping() > 0.0 || !contact.is_constant();
    if profile.has_kinks() || is_row && !contact.is_constant() {
        KINKS
    } else if passes && profile.has_bends() {
        BENDS
    } else if is_row && !contact.inert && !contact.has_lulls() && !model.free.is_empty() {
        (tolerance / ROWS_FROM).clamp(ROWS, 1.0)
    } else {
        1.0
    }
}

/// How far a derivative moves each coupled component of a model.
pub(super) fn differences(model: &Model) -> Vec<f64> {
    let mut natural = Allowance::new(model, 1.0, Vec::new());
    natural.set(model, &model.rest());
    let unit = DIFFERENCE / natural.strict;
    let coupled = model.layout().dimension();
    natural.allowed.scale[..coupled].iter().map(|scale| unit * scale).collect()
}

/// Raises what is allowed to what rounding of time leaves of the forces of fast strokes and followers, and rounding of places of contacts
/// whose bodies started far from the origin, and of stacks whose ends have gone far from there.
///
/// A stage of a step lies at a time that is rounded to εt, and a link's force changes by F' = kṡ + cs̈ in a second, a contact's by mω²u̇ of
/// what it follows: accelerations are wrong by εtF'/m and powers by εtF'ṡ, and what a step makes of them falls with its length only.
/// Allowed is what one of [`RUSH`]/ω makes of them, ω the fastest natural motion's.
fn allow_rush(model: &Model, state: &State, scale: &mut [f64], by_contacts: bool) {
    let layout = model.layout();
    let equations = Equations::on(model, state, layout, false);
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
        // All that holds the coordinate when it sticks: mω².
        let stiffness = (free.scale.1 / free.scale.0).powi(2) / free.mobility;
        push(stiffness * (late * rate.abs() + place), rate, &contact.u.free);
    }
    scale[layout.dimension()..].iter_mut().for_each(|scale| *scale = scale.max(work));
}

/// Raises what is allowed to the rounding of the places that contacts and links tell from each other: a friction may be so small that its
/// u_c is less than a few of their last places.
///
/// A place rounds the force of all that holds it, and the force, by kεx/m = ω²εx, the velocity within 1/ω; the force of a stack rounds its
/// power within that time.
// A stage on two feet of frictions 0.5 and 1e-12, tipped by 24 µrad, took steps of a thousandth of its period for the rounding of 50 nm.
fn allow_places(model: &Model, state: &State, scale: &mut [f64]) {
    let layout = model.layout();
    let equations = Equations::on(model, state, layout, false);
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

/// By how much the power of free strokes rises in a step, W: kṡ²h. So much may rounding of the time of a stage of it be mistaken.
///
/// A step of h is at most the fastest natural motion's 1/ω.
// Without it an impact drive on rows, asked for works to 6e-21 J, took steps of 5 ns after half a second: ten times as many.
fn surge(model: &Model, state: &State) -> f64 {
    if model.links.is_empty() {
        return 0.0;
    }
    let equations = Equations::on(model, state, model.layout(), false);
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let rise = |link: &Link| link.stiffness * equations.stroke(link, &at).rate.powi(2);
    let step = state.step.min(1.0 / model.fastest);
    if step > 0.0 { model.links.iter().map(rise).sum::<f64>() * step } else { 0.0 }
}

/// Largest power that followers can put into the contacts now, W: μF_N times their speed, and of profiles with kinks what springs that
/// all stick resist by their damping.
///
/// An upper bound: no spring takes more than its limit of friction and that. Asked at corners only: on a straight
/// piece the speed between two of them is one and the same.
// The damping of a height is gone as soon as it slips, and no event says when: without it a flyback of a nanosecond over two damped
// heights, whose damping was thousands of μF_N, ended in steps too small. On smooth profiles it fades, or is gone at an event.
pub(super) fn follower_power(model: &Model, state: &State) -> f64 {
    let equations = Equations::on(model, state, model.layout(), false);
    model.contacts.iter().map(|contact| power(contact, &equations, state)).sum()
}

/// The same of one contact.
fn power(contact: &Contact, equations: &Equations<'_>, state: &State) -> f64 {
    let at = Components { t: state.t, y: |i: usize| state.y[i] };
    let rate = |w: usize| equations.signal(w, &at).rate;
    let speed: f64 = contact.u.driven.iter().map(|(w, a)| a * rate(*w)).sum();
    let kinked = contact.interface.profile().has_kinks();
    let stuck = if kinked { contact.interface.stick_stiffness(contact.natural.depth) } else { 0.0 };
    let damped = contact.interface.viscosity(stuck) * speed.abs();
    contact.count * (contact.friction_limit() + damped) * speed.abs()
}
