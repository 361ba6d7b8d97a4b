//! Steps of a drive and the convergence of the step length.

use super::losses::Losses;
use super::period::LastPeriod;
use super::{DriverSummary, period, why};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::outlook::Repetition;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Accuracy;
use stickslip_drive::scene::{Freedom, Side, Varying};
use stickslip_measure::Periods;
use stickslip_measure::settling::BAND;
use stickslip_measure::{Bounds, Settling, Steps, Strides};
use stickslip_quantity::Real;

/// A step below this fraction of the natural displacement counts as no step.
const NOTHING: f64 = 1e-2;
/// Number of samples of a period for the total travel of a waveform.
const MOMENTS: u32 = 1000;
/// Permitted ratio of the global to the local error of a run with a tolerance.
const GLOBAL: f64 = 100.0;
const FIXED: f64 = 1e-9;
/// Largest relative difference of the step lengths of a run with fixed time steps and of a periodic orbit that count as the same motion.
const COARSE: f64 = 0.1;
/// Fraction of the time with all contacts open above which a body counts as hopping.
const FLIES: f64 = 0.01;
/// Beginning of a note about the reason for missing steps.
pub(super) const NO_STEP: &str = "no step reported";
/// A step below this fraction of the motion of the body in a period counts as a rounding error.
const ROUNDING: f64 = 1e-9;

/// Steps of the body over the whole periods of the waveform, both named in `figures`.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DriveSummary {
    /// name of the body whose steps are evaluated
    body: String,
    /// name of the waveform whose periods define the steps
    waveform: String,
    /// period T of the waveform that defines the steps
    #[serde(rename = "period_s")]
    period: Real,
    /// number of whole periods, that is of steps. steps.csv lists all steps.
    periods: usize,
    /// step length in the last whole period: x at its end minus x at its start
    #[serde(rename = "last_m")]
    last: Real,
    /// largest magnitude of the step lengths
    #[serde(rename = "longest_m")]
    longest: Real,
    /// trend of the step lengths: `settled`, `not_settled` (approach a limit, or too few steps), `irregular`, `drifts`
    /// (no limit) or `oscillates`
    pub settling: SettlingSummary,
    /// Steady step length. Absent unless the steps have settled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady: Option<Steady>,
    /// mean velocity: displacement in all whole periods divided by their duration
    #[serde(rename = "mean_speed_m_s")]
    pub mean_speed: Real,
    /// net travel: x at the end of the run minus x at its start, including time outside whole periods
    #[serde(rename = "net_travel_m")]
    net_travel: Real,
    /// Evaluation of the last whole period.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_period: Option<LastPeriod>,
    /// sentences that explain the length of the last step
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub why: Vec<String>,
    /// Error of a step by the accuracy of fixed time steps, m. `None` with a tolerance.
    #[serde(skip)]
    promised: Option<f64>,
}

impl DriveSummary {
    /// Returns the sentences of [`Self::why`] if the last period made no step or one against the forward stroke,
    /// otherwise none.
    pub fn oddity(&self) -> &[String] {
        let is_odd = self.last_period.as_ref().is_some_and(why::is_odd);
        if is_odd { &self.why } else { &[] }
    }

    /// Returns the length of the last step, m.
    pub fn last(&self) -> Real {
        self.last
    }

    /// Widens the error of a settled step to its distance from the step of a stable periodic orbit. Step lengths do not
    /// show slow decay behind fast decay, nor the error of fixed time steps. A distance above 0.1 %, or 10 % with fixed
    /// time steps, means another motion and has no effect.
    pub(super) fn compare(&mut self, motion: &Repetition) {
        let Some(steady) = &mut self.steady else { return };
        let apart = (steady.step.0 - motion.step.0 / motion.periods as f64).abs();
        let band = if self.promised.is_some() { COARSE } else { BAND };
        if motion.stable == Some(true) && apart <= band * steady.step.0.abs() {
            steady.widen(apart);
        }
    }
}

/// Trend of the step lengths. Lengths are in m, changes and growth per period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "state", rename_all = "snake_case")]
pub enum SettlingSummary {
    /// Constant; the steady step length is available.
    Settled,
    /// Approaching a limit, or too few for a decision.
    NotSettled {
        /// change of the step length per period, at the end of the run
        #[serde(skip_serializing_if = "Option::is_none")]
        change_m: Option<Real>,
        /// extrapolated limit of the step lengths. Absent if there is none.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit_m: Option<Real>,
        /// uncertainty of the extrapolated limit
        #[serde(skip_serializing_if = "Option::is_none")]
        limit_error_m: Option<Real>,
    },
    /// Changing without a pattern.
    Irregular {
        /// half of the range of the step lengths
        spread_m: Real,
    },
    /// Changing in one direction without a limit.
    Drifts {
        /// change of the step length per period, at the end of the run
        change_m: Real,
    },
    /// Oscillating about a mean.
    #[serde(rename = "oscillates")]
    Beats {
        /// period of the oscillation of the step lengths, in drive periods
        periods: Real,
        /// relative growth of the oscillation per period, below 0 if it decays
        #[serde(skip_serializing_if = "Option::is_none")]
        growth: Option<Real>,
        /// mean of the oscillation of the step lengths
        mean_m: Real,
        /// amplitude of the oscillation of the step lengths at the end of the run
        amplitude_m: Real,
    },
}

/// Steady step length of a drive.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Steady {
    /// first period, counted from 0, from which all step lengths are within 0.1 % of the limit
    #[serde(rename = "from_period")]
    pub from: usize,
    /// number of last steps of which step_m is the mean
    periods: usize,
    /// steady step length: mean of the last steps
    #[serde(rename = "step_m")]
    pub step: Real,
    /// uncertainty of the steady step length: possible difference between step_m and the mean of all later steps. At
    /// least the distance from the periodic orbit, if this is stable and within 0.1 % (10 % with fixed time steps).
    /// With `frames`, at least their specified error of a stroke. Not included: the integration error within the
    /// tolerance, and the error of fixed time steps if no orbit was found.
    #[serde(rename = "error_m")]
    pub error: Real,
    /// standard deviation of the last steps, of which step_m is the mean
    #[serde(rename = "repeatability_m", skip_serializing_if = "Option::is_none")]
    pub repeatability: Option<Real>,
    /// Losses of a step.
    #[serde(flatten)]
    pub losses: Losses,
}

impl Steady {
    /// Increases the error of the step to at least `error`, m.
    fn widen(&mut self, error: f64) {
        self.error = Real(self.error.0.max(error));
        if self.step.0.abs() <= self.error.0 {
            self.losses.back_step = None;
        }
    }
}

/// Returns the number of periods after which `run.until_steady` ended a run.
pub(super) fn steady_after(job: &Job, outcome: &Outcome) -> Option<usize> {
    let plan = &job.scenario.plan;
    let asked = plan.until_steady.filter(|_| outcome.error.is_none())?;
    let end = Some(outcome.state.time()).filter(|end| *end < plan.duration)?;
    let waveform = job.scenario.scene.waveforms.get(asked.waveform)?;
    Periods::until(&waveform.part, end).map(|periods| periods.count)
}

/// Returns the steps of a run. Returns `None`, with a note if necessary, without whole periods or a free body.
pub(super) fn of(
    job: &Job,
    outcome: &Outcome,
    drivers: &Parts<DriverSummary>,
    notes: &mut Vec<String>,
) -> Option<DriveSummary> {
    let (scene, figures) = (&job.scenario.scene, job.scenario.figures);
    notes.extend(unchosen(job));
    let body = scene.bodies.get(figures.body?)?;
    let waveform = scene.waveforms.get(figures.waveform?)?;
    let period = waveform.part.period()?;
    if body.part.x.freedom != Freedom::Free {
        // A note is necessary only if some body is free.
        if let Some(free) = scene.bodies.iter().find(|body| body.part.x.freedom == Freedom::Free) {
            notes.push(format!(
                "no steps: x of \"{}\", the body of figures, is not free; x of \"{}\" is free",
                body.name, free.name
            ));
        }
        return None;
    }
    if Periods::until(&waveform.part, outcome.state.time()).is_none() {
        notes.push(format!(
            "no steps: the run is shorter than a period of {period} s of \"{}\"",
            waveform.name
        ));
        return None;
    }
    let strides = outcome.tally.strides().filter(|strides| strides.count() > 0);
    let Some(strides) = strides else {
        notes.push("no steps: the ends of the periods were not recorded".to_owned());
        return None;
    };
    let bounds = match flight(job, outcome) {
        // While the body touches nothing, no motion counts as a step.
        Some(_) => Bounds { most: 0.0, ..step_bounds(job) },
        // A hopping body has no upper bound of its steps.
        None if hops(job, outcome) => Bounds { most: f64::INFINITY, ..step_bounds(job) },
        None => step_bounds(job),
    };
    // Without contacts, the travel in a period is the only scale.
    let reach = strides.part(0..strides.count()).map(|stride| stride.most - stride.least).fold(0.0, f64::max);
    let bounds = Bounds { least: bounds.least.max(ROUNDING * reach), ..bounds };
    let steps = Steps::of_strides(strides, period, outcome.tally.net_travel(), bounds);
    let ends = [strides.last().map_or(f64::NAN, |last| last.length()), strides.longest()];
    let mut summary = summary(&steps, ends, (&body.name, &waveform.name, period));
    summary.promised = promised(job);
    if let (Some(steady), Some(promised)) = (&mut summary.steady, summary.promised) {
        steady.widen(promised);
    }
    let last = strides.last().map(|last| (last, bounds.error));
    summary.last_period = last.and_then(|last| period::of(job, outcome, last, stroke(job).is_some()));
    if let Some(last) = &summary.last_period {
        summary.why = why::of(job, drivers, last);
        if let (Some(steady), Ok(foot)) = (&mut summary.steady, last.foot) {
            steady.losses.lost_stroke = Some(Real(foot.travel - steady.step.0.abs()));
        }
    }
    Some(summary)
}

/// Returns the note that `figures` must name a body or waveform, if there are several free bodies or periodic waveforms
/// and `figures` names none.
fn unchosen(job: &Job) -> Option<String> {
    let (scene, figures) = (&job.scenario.scene, job.scenario.figures);
    let free = scene.bodies.iter().filter(|body| body.part.x.freedom == Freedom::Free);
    let free: Vec<String> = free.map(|body| format!("\"{}\"", body.name)).collect();
    let periodic = scene.waveforms.iter().filter(|waveform| waveform.part.period().is_some());
    let periodic: Vec<String> = periodic.map(|waveform| format!("\"{}\"", waveform.name)).collect();
    let (key, names) = match () {
        () if free.is_empty() || periodic.is_empty() => return None,
        () if figures.body.is_none() => ("body", free),
        () if figures.waveform.is_none() => ("waveform", periodic),
        () => return None,
    };
    Some(format!("{NO_STEP}: name a {key} in figures, one of {}", names.join(", ")))
}

/// Returns the time, s, since which all contacts of the body named in `figures` have been open, if it precedes the last whole period.
pub(crate) fn flight(job: &Job, outcome: &Outcome) -> Option<f64> {
    let (scene, figures) = (&job.scenario.scene, job.scenario.figures);
    let (body, waveform) = (figures.body?, scene.waveforms.get(figures.waveform?)?);
    let (last, _) = Periods::until(&waveform.part, outcome.state.time())?.last();
    let touching = scene.contacts.iter().enumerate();
    let own = touching.filter(|(_, contact)| contact.part.between.contains(&Side::Body(body)));
    let opened = own.map(|(c, _)| outcome.tally.contact(c)?.open_since);
    let since = opened.reduce(|a, b| Some(f64::max(a?, b?)))??;
    (since <= last).then_some(since)
}

/// Returns whether all contacts of the body named in `figures` are open for a considerable part of the time.
fn hops(job: &Job, outcome: &Outcome) -> bool {
    let Some(body) = job.scenario.figures.body else { return false };
    let touching = job.scenario.scene.contacts.iter().enumerate();
    let mut own = touching.filter(|(_, contact)| contact.part.between.contains(&Side::Body(body))).peekable();
    let flies = |c: usize| outcome.tally.contact(c).and_then(|contact| contact.open_share());
    own.peek().is_some() && own.all(|(c, _)| flies(c).is_some_and(|share| share > FLIES))
}

/// Returns bounds for steps, independent of the run.
///
/// * A step below 1 % of the natural displacement counts as no step.
/// * A step above twice the stroke, or above the total travel of a burst, means that the body slides away.
/// * The error of a step is at least the error that the stepper promises.
#[must_use]
pub fn step_bounds(job: &Job) -> Bounds {
    let natural = (0..job.scenario.scene.contacts.len()).filter_map(|c| job.model.contact_natural(c));
    let natural = natural.map(|natural| natural.displacement).fold(0.0, f64::max);
    let promised = match job.stepper() {
        (_, "tolerance", tolerance) => GLOBAL * tolerance,
        _ => FIXED,
    };
    let most = stroke(job).map_or(f64::INFINITY, |stroke| way(job).unwrap_or(0.0).max(2.0 * stroke));
    Bounds { least: NOTHING * natural, most, error: promised * natural }
}

/// Returns the error of a step that the stepper promises, m: for `frames` the accuracy times the stroke, for other fixed time steps 0.
/// Returns `None` for steppers with a tolerance.
fn promised(job: &Job) -> Option<f64> {
    match job.model.effective(job.scenario.plan.stepper).accuracy() {
        Accuracy::Tolerance(_) => None,
        Accuracy::Step(_) => Some(0.0),
        Accuracy::Frame { error, .. } => Some(error * stroke(job).unwrap_or(0.0)),
    }
}

/// Returns the stroke of the waveform named in `figures`, if a body or an actuator follows it.
pub(super) fn stroke(job: &Job) -> Option<f64> {
    let (scene, waveform) = (&job.scenario.scene, job.scenario.figures.waveform?);
    let is_here = |signal: usize| scene.waveform_of(signal) == Some(waveform);
    let followed =
        scene.bodies.iter().any(|body| matches!(body.part.x.freedom, Freedom::Follows(w) if is_here(w)));
    let drives = scene.actuators.iter().any(|it| matches!(it.part.stroke, Varying::Follows(w) if is_here(w)));
    let (low, high) = scene.waveforms.get(waveform)?.part.range();
    (followed || drives).then_some(high - low)
}

/// Returns the total travel of the waveform named in `figures` in a period, m, from samples. For bursts, it exceeds twice the stroke.
fn way(job: &Job) -> Option<f64> {
    let waveform = &job.scenario.scene.waveforms.get(job.scenario.figures.waveform?)?.part;
    let (period, delay) = (waveform.period()?, waveform.timing().delay);
    let value = |k: u32| {
        let t = delay + period * f64::from(k) / f64::from(MOMENTS);
        waveform.sample(&waveform.piece_at(t), t).value
    };
    Some((0..MOMENTS).map(|k| (value(k + 1) - value(k)).abs()).sum())
}

fn summary(
    steps: &Steps,
    [last, longest]: [f64; 2],
    (body, waveform, period): (&str, &str, f64),
) -> DriveSummary {
    DriveSummary {
        body: body.to_owned(),
        waveform: waveform.to_owned(),
        period: Real(period),
        periods: steps.periods,
        last: Real(last),
        longest: Real(longest),
        settling: settling(&steps.settling),
        steady: steps.steady.map(|steady| Steady {
            from: steady.from,
            periods: steady.periods,
            step: Real(steady.step),
            error: Real(steady.error),
            repeatability: steady.repeatability.map(Real),
            losses: Losses::of([steady.step, steady.error], steady.back_step, None),
        }),
        mean_speed: Real(steps.mean_speed),
        net_travel: Real(steps.net_travel),
        last_period: None,
        why: Vec::new(),
        promised: None,
    }
}

fn settling(settling: &Settling) -> SettlingSummary {
    match *settling {
        Settling::Settled(_) => SettlingSummary::Settled,
        Settling::NotSettled { change, limit } => SettlingSummary::NotSettled {
            change_m: change.map(Real),
            limit_m: limit.map(|(limit, _)| Real(limit)),
            limit_error_m: limit.map(|(_, error)| Real(error)),
        },
        Settling::Irregular { spread } => SettlingSummary::Irregular { spread_m: Real(spread) },
        Settling::Drifts { change } => SettlingSummary::Drifts { change_m: Real(change) },
        Settling::Beats { period, growth, about, amplitude } => SettlingSummary::Beats {
            periods: Real(period),
            growth: growth.map(|growth| Real(growth - 1.0)),
            mean_m: Real(about),
            amplitude_m: Real(amplitude),
        },
    }
}
