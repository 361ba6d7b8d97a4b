//! The solver and what steers it.
//!
//! [`Motion`] tries steps and knows how long they may be; whether one is accepted is not its choice
//! ([`step`](super::step)), nor when the next event is ([`aim`](super::aim)). [`Pace`] is what one step
//! leaves to the next; at an event it begins anew.

use super::Setting;
use super::aim::{Aim, SHRINK, reach, start};
use super::allowance::Allowance;
use crate::Waveform;
use crate::contact::{Contact, Guard};
use crate::equations::Equations;
use crate::method::Method;
use crate::model::{Free, Model};
use crate::record;
use crate::state::{Ahead, Gait, Grip, State, Whereabouts};
use stickslip_stepper::{Attempt, End, Grade, Target};

/// Velocities this small, relative to the natural ones, are rounding: some hundred of their last places.
// With 1e-12 a growing power law ends elsewhere by a tenth of its error; with 1e-14 nothing differs.
const REST: f64 = 1e-13;
/// Largest product of step and rate at rest. Long steps multiply rounding by their many large coefficients.
// With 0.1 P1 on a sine has five times the error at 1e-6; with 10 nothing is saved.
const REST_REACH: f64 = 1.0;
/// How often a step is tried again to end nearer to its singular moment.
// Without any the books of a sine drive at 1e-9 are 25 times worse; more than two change only how a ball bounces that is set
// down without damping.
const CORRECTIONS: u32 = 2;

/// What rounding leaves of the books, relative to all that is in them.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// The solver and what steers it.
pub(super) struct Motion<A> {
    /// One step at a time, with its dense output.
    pub(super) solver: A,
    pub(super) whereabouts: Whereabouts,
    pub(super) allowance: Allowance,
    pub(super) pace: Pace,
    /// Whether something may fade several times within a step: of that the dense output is off by far more than the ends of steps.
    pub(super) fades: bool,
    /// Where the law has kinks that end no step: room for the channels of a moment, by whose books steps are judged as well.
    books: Option<Vec<f64>>,
}

/// How long steps may be.
pub(super) struct Pace {
    /// Longest step, s: a fraction of the period of the fastest smooth waveform.
    pub(super) longest: f64,
    /// What takes its place at the start of a run where there is none, s.
    first: f64,
    /// Longest step, s, of few stages, for what something near will end; 0 where the method has no other.
    pub(super) short: f64,
    /// Longest graded step, as a part of an even one.
    pub(super) reach: f64,
    /// Longest graded step from a touch, in radians of the swing that the touch begins.
    pub(super) start: f64,
    /// How near to a singular moment a step must end, as a part of it.
    pub(super) closeness: f64,
    /// How much must be left before such a moment for its law to matter, in natural lengths.
    pub(super) resolved: f64,
    /// What one step leaves to the next.
    pub(super) gait: Gait,
}

impl<A> Motion<A> {
    /// Nothing is started yet: the solver is behind until it is told of a state.
    pub(super) fn new(setting: &Setting<'_>, solver: A, scale: Vec<f64>) -> Self {
        let (model, tolerance) = (setting.model, setting.tolerance);
        let pace = Pace {
            longest: longest(model),
            first: scene_time(model),
            short: short(setting.method, model, tolerance),
            reach: reach(tolerance),
            start: start(tolerance),
            closeness: closeness(model, tolerance),
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
    /// Puts the solver where the state is.
    pub(super) fn start(&mut self, eq: &Equations<'_>, state: &State) {
        self.whereabouts = Whereabouts::Here;
        self.solver.start(eq, state.t, &state.y);
    }

    /// Tries a step; one that ends at a singular moment again, until that moment is met well enough.
    ///
    /// Gives the error in units of the allowance; 1 is just allowed. `aim` is moved to the end of the last
    /// attempt, which is at most `CORRECTIONS` after the first: each is a Newton step of the guard's own
    /// value and rate at the end, and all stages are evaluated again.
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
            // The guards that end a singular law are of displacements: their rates ask for no acceleration.
            let missed = -value / rate;
            let to = aim.target + missed + 0.5 * self.pace.closeness * h;
            // Beyond these the moment was foreseen badly: the attempt stands or falls as it is.
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

    /// The error of the last attempt, from time t to where a guard falls, of which it tells so much.
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

    /// The error of the last attempt where it would be accepted: the larger of the solver's own and of what the books of the step miss.
    ///
    /// Across a kink the solver's stages and the weights by which it tells its error see nearly the same: of a row of 16 springs at
    /// 1e-8 the work put in was wrong by thousands of tolerances.
    #[inline(always)]
    pub(super) fn with_books(&mut self, eq: &Equations<'_>, state: &State, t: f64, error: f64) -> f64 {
        if self.books.is_none() || error.is_nan() || error > 1.0 {
            error
        } else {
            error.max(self.missed(eq, state, t))
        }
    }

    /// What the books of a step from a state to time t miss, in units of what is allowed of the work put in.
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

    /// Longest step from here, s. Where something holds, a swing below the tolerance must die away instead of being
    /// nursed up to it, and one of the size of rounding must not be fed by more of it.
    ///
    /// `fastest` is the largest |λ| of the motions with all contacts stuck, 1/s. Sticking, a step is at most
    /// the limit of stability over it; at rest, [`REST_REACH`] over it; where nothing swings nothing binds but the
    /// waveforms.
    pub(super) fn longest_now(&self, t: f64, fastest: f64) -> f64 {
        // Undamped, a long step feeds a swing below the tolerance up to it; what is at rest stays so only
        // within these.
        // An implicit method lets it die in steps of any length.
        let reach = match self.pace.gait.grip {
            Grip::Slips => return self.longest(t),
            _ if self.solver.stability_limit() == f64::INFINITY => return self.longest(t),
            Grip::Sticks => self.solver.stability_limit(),
            Grip::Rests => REST_REACH,
        };
        self.longest(t).min(reach / fastest)
    }

    /// Longest step from time t whatever holds, s; finite.
    ///
    /// Where no wave bounds a step it is as long as the run so far, and at first as the longest waveform takes: none may depend
    /// on when the run will end.
    pub(super) fn longest(&self, t: f64) -> f64 {
        if self.pace.longest < f64::INFINITY { self.pace.longest } else { t.abs().max(self.pace.first) }
    }

    /// Looks whether all that is free is at rest.
    ///
    /// In gross slip the answer is given and the grip stays.
    pub(super) fn rest(&mut self, model: &Model, state: &State) -> bool {
        let rests = self.is_at_rest(model, state);
        self.pace.gait.grip = match self.pace.gait.grip {
            Grip::Slips => Grip::Slips,
            Grip::Sticks | Grip::Rests if rests => Grip::Rests,
            Grip::Sticks | Grip::Rests => Grip::Sticks,
        };
        rests
    }

    /// Whether all that is free is at rest but for rounding: velocities that some step has left, and accelerations that
    /// will not make more of them.
    ///
    /// For each free coordinate |v| ≤ 1e-13 of its natural speed, and |v̇|·length ≤ 1e-13 of the square of
    /// that speed.
    fn is_at_rest(&self, model: &Model, state: &State) -> bool {
        let velocity = |i: usize| model.free.len() + i;
        let still = |(i, free): (usize, &Free)| {
            let ((length, speed), pull) = (free.scale, self.solver.slope(velocity(i), End::Start));
            state.y[velocity(i)].abs() <= REST * speed && pull.abs() * length <= REST * speed * speed
        };
        model.free.iter().enumerate().all(still)
    }

    /// Component `i` at a time inside the step; before its end by the dense output.
    ///
    /// At the end itself the value is the step's own, to the last bit; the polynomial rounds.
    #[inline]
    pub(super) fn component(&self, i: usize, t: f64) -> f64 {
        if t == self.solver.span().end_time { self.solver.span().end[i] } else { self.solver.value(i, t) }
    }
}

impl Pace {
    /// After an event nothing is known of what is ahead.
    pub(super) fn restart(&mut self) {
        (self.gait.proven, self.gait.ahead) = (0.0, Ahead::Clear);
    }

    /// How the step after an accepted one of length `h` shrinks. On the way to a singular moment an even step has the same
    /// error as the one before where it is the same part of what is left.
    ///
    /// `singular` is the time to that moment from the start of the step just made, s; the factor is 1 -
    /// h/singular, not below
    /// [`SHRINK`], and only after a step on this way has been refused.
    pub(super) fn nearing(&self, h: f64, singular: f64) -> f64 {
        match self.gait.ahead {
            Ahead::Clear => 1.0,
            Ahead::Shortens => (1.0 - h / singular).max(SHRINK),
        }
    }

    /// What a refused step tells.
    ///
    /// A graded one that was too long proves no length for the next; an even one on the way to a singular
    /// moment says that such steps must shorten. Before, a fifth of all attempts under a vibrating foot at a
    /// tolerance of 1e-9 was thrown away.
    pub(super) fn refuse(&mut self, aim: &Aim) {
        if aim.closes.is_some() {
            self.gait.proven = 0.0;
        }
        self.gait.ahead = if aim.singular.is_finite() { Ahead::Shortens } else { Ahead::Clear };
    }

    /// The error by which a step is judged. From a singular moment it falls with the root of the length as that of an even
    /// step with the length.
    /// Without the square control took the error to fall faster than it does: at the touch of an impact three
    /// attempts in a row were thrown away.
    pub(super) fn judged(error: f64, grade: Grade) -> f64 {
        if grade == Grade::Start && error > 1.0 { error * error } else { error }
    }
}

/// Whether a walk goes by the whole law of a row of springs, whose force bends wherever a spring slips and no step ends.
fn is_kinked(model: &Model) -> bool {
    let bends = |contact: &Contact| !contact.inert && contact.engine.springs() > 0 && !contact.has_lulls();
    model.free.is_empty() && model.contacts.iter().any(bends)
}

/// Longest step, s, that leaps over no smooth wave; ∞ where there is none.
fn longest(model: &Model) -> f64 {
    model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min)
}

/// Period of the fastest swing with all contacts stuck, s; 1 ms where nothing swings.
fn natural(model: &Model) -> f64 {
    let period = std::f64::consts::TAU / model.fastest;
    if period.is_normal() { period } else { 1e-3 }
}

/// That, or the longest time that a waveform takes, s.
fn scene_time(model: &Model) -> f64 {
    let extents = model.waveforms.iter().map(Waveform::extent).filter(|extent| extent.is_finite());
    extents.fold(natural(model), f64::max)
}

/// How near to a singular moment a step must end, as a part of it. What is missed of a force that goes with a power 3/2 of
/// the time counts with the power 5/2, of the damping of the stuck springs with the power 3/2.
///
/// With tolerance^{2/5} and tolerance^{2/3} both misses are of the size of the tolerance; a tenth of it is
/// asked for.
fn closeness(model: &Model, tolerance: f64) -> f64 {
    let damped = model.contacts.iter().any(|contact| contact.interface.damping() > 0.0);
    0.1 * math::powf(tolerance, if damped { 2.0 / 3.0 } else { 0.4 })
}

/// What the estimate of a method of few stages tells of a swing of the natural amplitude, error · θ^-power after a step of θ rad, and
/// the longest step, rad, up to which swings do not grow, or by less than 1e-5 of a radian.
///
/// Of Dormand and Prince's: what its embedded polynomial of stability lacks of the fifth power, 1097/120000 - 1/120. Of Nyström's:
/// 35/336 of what the acceleration of its last stage differs from that at the end, at its largest.
const fn estimate(method: Method) -> Option<Estimate> {
    match method {
        Method::Brief => Some(Estimate { error: 8.1e-4, power: 5.0, stable: 0.9 }),
        Method::BriefNystrom => Some(Estimate { error: 7.5e-4, power: 4.0, stable: 0.5 }),
        _ => None,
    }
}

/// An estimate of few stages.
struct Estimate {
    error: f64,
    power: f64,
    stable: f64,
}

/// Longest step of few stages, s: there it meets the tolerance for the fastest swing; none where nothing swings.
fn short(method: Method, model: &Model, tolerance: f64) -> f64 {
    let Some(Estimate { error, power, stable }) = method.brief(model, tolerance).and_then(estimate) else {
        return 0.0;
    };
    if model.fastest == 0.0 {
        return 0.0;
    }
    math::powf(tolerance / error, power.recip()).min(1.0) * stable / model.fastest
}
