//! Integrator of a run with located events, and its step length.
//!
//! [`Motion`] attempts steps and limits their length. The module [`step`](super::step) accepts or rejects them, and [`aim`](super::aim)
//! predicts the next event. [`Pace`] contains the data that one step passes to the next; an event resets these data.

use super::Setting;
use super::aim::{Aim, SHRINK, reach, start};
use super::allowance::Allowance;
use crate::Waveform;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::method::Method;
use crate::model::{Free, Model};
use crate::record;
use crate::state::{Ahead, Gait, Grip, State, Whereabouts};
use stickslip_contact::{Guard, Site};
use stickslip_stepper::{Attempt, End, Grade, Target};

/// Largest velocity that counts as rest, relative to the natural velocity. The value corresponds to several hundred rounding errors.
const REST: f64 = 1e-13;
/// Largest product of step length and rate at rest. Longer steps amplify rounding errors, because the method has large coefficients.
const REST_REACH: f64 = 1.0;
/// Largest number of repetitions of a step that bring its end closer to a singular moment.
const CORRECTIONS: u32 = 2;

/// Rounding error of the energy balance, relative to the size of its terms.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Integrator and step length.
pub(super) struct Motion<A> {
    /// Integrator, which takes one step at a time, with its dense output.
    pub(super) solver: A,
    pub(super) whereabouts: Whereabouts,
    pub(super) allowance: Allowance,
    pub(super) pace: Pace,
    /// Whether a motion may decay within a step, so that the dense output is far less accurate than the end of the step.
    pub(super) fades: bool,
    /// Scratch memory for the energy balance of a step, if the force law has kinks that end no step.
    books: Option<Vec<f64>>,
}

/// Limits of the step length.
pub(super) struct Pace {
    /// Maximum time step, s: a quarter of the shortest wave of any waveform; ∞ without waves.
    pub(super) longest: f64,
    /// Maximum time step at the start of a run without waves, s.
    first: f64,
    /// Maximum time step with few stages (order 5), taken shortly before an expected event, s; 0 if the method has no such step.
    pub(super) short: f64,
    /// Longest graded step, as a fraction of an even one.
    pub(super) reach: f64,
    /// Longest graded step after a touch, in radians of the oscillation that begins with the touch.
    pub(super) start: f64,
    /// Largest distance between a singular moment and the end of the step there, as a fraction of the step.
    pub(super) closeness: f64,
    /// Smallest remaining length of a law at which its singular end requires a graded step, in natural lengths.
    pub(super) resolved: f64,
    /// Data that one step passes to the next.
    pub(super) gait: Gait,
}

impl<A> Motion<A> {
    /// Creates an integrator without a starting point.
    pub(super) fn new(setting: &Setting<'_>, solver: A, scale: Vec<f64>) -> Self {
        let (model, tolerance) = (setting.model, setting.tolerance);
        let pace = Pace {
            longest: longest(model),
            first: scene_time(model),
            short: short(setting.method, model, tolerance),
            reach: reach(tolerance),
            start: start(tolerance),
            closeness: closeness(tolerance),
            resolved: math::powf(tolerance, 2.0 / 3.0),
            gait: Gait::FRESH,
        };
        let allowance = Allowance::new(model, tolerance, scale);
        let books = is_kinked(model).then(Vec::new);
        let fades = model.stiff || !model.blocks.is_empty();
        Self { solver, whereabouts: Whereabouts::Behind, allowance, pace, fades, books }
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Motion<A> {
    /// Restarts the integrator at the current state.
    pub(super) fn start(&mut self, eq: &Equations<'_>, state: &State) {
        self.whereabouts = Whereabouts::Here;
        self.solver.start(eq, state.t, &state.y);
    }

    /// Attempts a step and returns its error in units of the allowed error.
    ///
    /// A step to a singular moment is repeated up to [`CORRECTIONS`] times until it ends close enough. Each repetition is a Newton step for
    /// the event function at the end, with all stages evaluated again. `aim` is set to the end of the last attempt.
    #[inline(always)]
    pub(super) fn attempt(&mut self, eq: &Equations<'_>, t: f64, aim: &mut Aim, corner: f64) -> f64 {
        let target = Target { end: aim.target, grade: aim.grade };
        let mut error = self.solver.attempt(eq, target, &self.allowance.allowed.scale);
        let Some((c, guard)) = aim.closes else { return error };
        let contact = &eq.model.contacts[c];
        error = self.judged_at_end(eq, (c, guard), (t, aim.grade), error);
        for _ in 0..CORRECTIONS {
            let (end, h) = (self.solver.span().end, aim.target - t);
            let motion = eq.motion(contact, aim.target, |i| end[i]);
            let value = guard.value(contact, eq.law(c), &motion);
            let rate = guard.rate(contact, &eq.modes[c], &motion, (0.0, 0.0));
            // These event functions are lengths; their rates need no accelerations.
            let missed = -value / rate;
            let to = aim.target + missed + 0.5 * self.pace.closeness * h;
            // Outside these limits the prediction was poor, and the attempt is not repeated.
            let fits = to - t > SHRINK * h && to - t < aim.most && to < corner;
            if !(rate < 0.0 && error < 1.0 && missed.abs() > self.pace.closeness * h && fits) {
                break;
            }
            aim.target = to;
            let target = Target { end: to, grade: aim.grade };
            error = self.solver.attempt(eq, target, &self.allowance.allowed.scale);
            error = self.judged_at_end(eq, (c, guard), (t, aim.grade), error);
        }
        error
    }

    /// Returns the error of a step from time t to a zero of an event function. `told` is the error estimate of the integrator.
    fn judged_at_end(
        &self,
        eq: &Equations<'_>,
        (c, guard): (usize, Guard),
        (t, grade): (f64, Grade),
        told: f64,
    ) -> f64 {
        if grade != Grade::End {
            return told;
        }
        let contact = &eq.model.contacts[c];
        contact.missed(told, || {
            let begin = self.solver.span().begin;
            let motion = eq.motion(contact, t, |i| begin[i]);
            let unit =
                if guard == Guard::Contact { contact.natural.depth } else { contact.natural.displacement };
            (guard.value(contact, eq.law(c), &motion) / unit, self.allowance.strict)
        })
    }

    /// Returns the larger of the integrator's error and the error of the energy balance, for an acceptable step.
    ///
    /// If a step contains a kink of the force law, the embedded estimate can be too small by orders of magnitude.
    #[inline(always)]
    pub(super) fn with_books(&mut self, eq: &Equations<'_>, state: &State, t: f64, error: f64) -> f64 {
        if self.books.is_none() || error.is_nan() || error > 1.0 {
            error
        } else {
            error.max(self.missed(eq, state, t))
        }
    }

    /// Returns the error of the energy balance in a step to time t, in units of the allowed error of the input work.
    #[inline(never)]
    fn missed(&mut self, eq: &Equations<'_>, state: &State, t: f64) -> f64 {
        let Some(row) = &mut self.books else { return 0.0 };
        let end = self.solver.span().end;
        let at_end = |i: usize| end.get(i).copied().unwrap_or(state.y[i]);
        let (before, _) = record::balance(eq, state, state.t, &|i| state.y[i], row);
        let (after, size) = record::balance(eq, state, t, &at_end, row);
        let allowed = self.allowance.allowed.scale[eq.layout.input()];
        (after - before).abs() / (allowed + ROUNDING * size)
    }

    /// Returns the maximum time step from time t, s.
    ///
    /// `fastest` is the largest |λ| of the motions with all contacts stuck, 1/s. In stick the step is below the stability limit, so that no
    /// oscillation grows. At rest the step is at most [`REST_REACH`]/`fastest`, so that no rounding error grows. In gross slip only
    /// waveforms limit the step.
    pub(super) fn longest_now(&self, t: f64, fastest: f64) -> f64 {
        // An implicit method is stable at any step length.
        let reach = match self.pace.gait.grip {
            Grip::Slips => return self.longest(t),
            _ if self.solver.stability_limit() == f64::INFINITY => return self.longest(t),
            Grip::Sticks => self.solver.stability_limit(),
            Grip::Rests => REST_REACH,
        };
        self.longest(t).min(reach / fastest)
    }

    /// Returns the maximum time step from time t without regard to stick, s; finite.
    ///
    /// Without waves, the result is the duration of the run so far, and at first the longest duration of a waveform. The result does not
    /// depend on the end of the run.
    pub(super) fn longest(&self, t: f64) -> f64 {
        if self.pace.longest < f64::INFINITY { self.pace.longest } else { t.abs().max(self.pace.first) }
    }

    /// Determines and stores whether all free coordinates are at rest, and returns the result.
    ///
    /// During gross slip of all contacts, the stored constraint [`Grip::Slips`] is kept.
    pub(super) fn rest(&mut self, model: &Model, state: &State) -> bool {
        let rests = self.is_at_rest(model, state);
        self.pace.gait.grip = match self.pace.gait.grip {
            Grip::Slips => Grip::Slips,
            Grip::Sticks | Grip::Rests if rests => Grip::Rests,
            Grip::Sticks | Grip::Rests => Grip::Sticks,
        };
        rests
    }

    /// Whether all free coordinates are at rest within rounding: velocities are small and accelerations keep them small.
    ///
    /// For each coordinate |v| ≤ 1e-13 of its natural speed, and |v̇|·length ≤ 1e-13 of the square of that speed.
    fn is_at_rest(&self, model: &Model, state: &State) -> bool {
        let velocity = |i: usize| model.free.len() + i;
        let still = |(i, free): (usize, &Free)| {
            let ((length, speed), pull) = (free.scale, self.solver.slope(velocity(i), End::Start));
            state.y[velocity(i)].abs() <= REST * speed && pull.abs() * length <= REST * speed * speed
        };
        model.free.iter().enumerate().all(still)
    }

    /// Returns component `i` at a time inside the step, from the dense output.
    ///
    /// At the end of the step the value is that of the integrator, without the rounding error of the interpolant.
    #[inline]
    pub(super) fn component(&self, i: usize, t: f64) -> f64 {
        if t == self.solver.span().end_time { self.solver.span().end[i] } else { self.solver.value(i, t) }
    }
}

impl Pace {
    /// Resets the data of earlier steps after an event.
    pub(super) fn restart(&mut self) {
        (self.gait.proven, self.gait.ahead) = (0.0, Ahead::Clear);
    }

    /// Returns the factor by which the next step is shortened before a singular moment.
    ///
    /// Even steps keep the same error if each is the same fraction of the time left. `h` is the length of the accepted step; `singular` is
    /// the time from its start to the singular moment, s. The factor is 1 - h/singular, but at least [`SHRINK`]. The factor is 1 unless a
    /// step towards that moment has been rejected.
    pub(super) fn nearing(&self, h: f64, singular: f64) -> f64 {
        match self.gait.ahead {
            Ahead::Clear => 1.0,
            Ahead::Shortens => (1.0 - h / singular).max(SHRINK),
        }
    }

    /// Stores the consequences of a rejected step.
    ///
    /// The length of a rejected graded step says nothing about later steps. A rejected even step towards a singular moment shortens the
    /// next steps, see [`Self::nearing`].
    pub(super) fn refuse(&mut self, aim: &Aim) {
        if aim.closes.is_some() {
            self.gait.proven = 0.0;
        }
        self.gait.ahead = if aim.singular.is_finite() { Ahead::Shortens } else { Ahead::Clear };
    }

    /// Returns the error that step control uses for a step.
    ///
    /// The error of a graded step from a singular moment depends on the square root of its length. An error above 1 is therefore squared.
    pub(super) fn judged(error: f64, grade: Grade) -> f64 {
        if grade == Grade::Start && error > 1.0 { error * error } else { error }
    }
}

/// Whether a quasi-static run follows the full force law of a spring row, whose kinks end no step.
fn is_kinked(model: &Model) -> bool {
    let bends = |contact: &Contact| !contact.inert && contact.engine.springs() > 0 && !contact.has_lulls();
    model.free.is_empty() && model.contacts.iter().any(bends)
}

/// Returns the maximum time step that resolves every smooth wave, s; ∞ without waves.
fn longest(model: &Model) -> f64 {
    model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min)
}

/// Returns the period of the fastest oscillation with all contacts stuck, s; 1 ms without oscillation.
fn natural(model: &Model) -> f64 {
    let period = std::f64::consts::TAU / model.fastest;
    if period.is_normal() { period } else { 1e-3 }
}

/// Returns the longest duration of a waveform, at least the period of the fastest oscillation, s.
fn scene_time(model: &Model) -> f64 {
    let extents = model.waveforms.iter().map(Waveform::extent).filter(|extent| extent.is_finite());
    extents.fold(natural(model), f64::max)
}

/// Returns how close to a singular moment a step must end, as a fraction of the step.
///
/// A force with the power 3/2 of time causes an error with the power 5/2 of the time missed at the end. A missed fraction of
/// tolerance^{2/5} thus causes an error of the size of the tolerance. The result is a tenth of that fraction.
fn closeness(tolerance: f64) -> f64 {
    0.1 * math::powf(tolerance, 0.4)
}

/// Returns the constants of the error estimate of a method with few stages (order 5).
///
/// After a step of θ rad of an oscillation with natural amplitude, the estimate is error · θ^power. Oscillations do not grow, or grow by
/// less than 1e-5 per radian, up to a step of `stable` rad.
///
/// Dormand and Prince: deviation of the fifth power in the embedded stability polynomial, 1097/120000 - 1/120. Nyström:
/// 35/336 of the largest difference between the accelerations of the last stage and of the end.
const fn estimate(method: Method) -> Option<Estimate> {
    match method {
        Method::Brief => Some(Estimate { error: 8.1e-4, power: 5.0, stable: 0.9 }),
        Method::BriefNystrom => Some(Estimate { error: 7.5e-4, power: 4.0, stable: 0.5 }),
        _ => None,
    }
}

/// Constants of the error estimate of a method with few stages, see [`estimate`].
struct Estimate {
    error: f64,
    power: f64,
    stable: f64,
}

/// Returns the maximum time step with few stages, s, which meets the tolerance for the fastest oscillation.
///
/// The result is 0 if the method has no such step or nothing oscillates.
fn short(method: Method, model: &Model, tolerance: f64) -> f64 {
    let Some(Estimate { error, power, stable }) = method.brief(model, tolerance).and_then(estimate) else {
        return 0.0;
    };
    if model.fastest == 0.0 {
        return 0.0;
    }
    math::powf(tolerance / error, power.recip()).min(1.0) * stable / model.fastest
}
