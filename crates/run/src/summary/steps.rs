//! The quantities of a drive.

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

/// A step below this share of the natural displacement counts as nothing.
const NOTHING: f64 = 1e-2;
/// Moments of a period at which a waveform is looked at for its way.
const MOMENTS: u32 = 1000;
/// Global over local error of a run, as comparisons allow it; that of fixed steps, which promise none.
const GLOBAL: f64 = 100.0;
const FIXED: f64 = 1e-9;
/// Share by which a step that is made of fixed steps may be off, and still be of the motion that is found directly.
const COARSE: f64 = 0.1;
/// Share of the time in which all contacts of a body are open that hops.
const FLIES: f64 = 0.01;
/// What a note begins with that says why there are no steps.
pub(super) const NO_STEP: &str = "no step reported";
/// A step below this share of how far the body goes in a period is rounding.
const ROUNDING: f64 = 1e-9;

/// Steps of the body named in `figures`, over the whole periods of the waveform named there.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DriveSummary {
    /// the body that steps
    body: String,
    /// the waveform whose periods make the steps
    waveform: String,
    /// period T of the waveform
    #[serde(rename = "period_s")]
    period: Real,
    /// number of steps, one for each whole period; steps.csv has every one of them
    periods: usize,
    /// length of the last: x at the end of its period minus x at the start
    #[serde(rename = "last_m")]
    last: Real,
    /// largest magnitude of the length of a step
    #[serde(rename = "longest_m")]
    longest: Real,
    /// `settled`, `not_settled`, `irregular`, `drifts` or `oscillates`: what the lengths of the steps do
    pub settling: SettlingSummary,
    /// The step that they have settled to; none where they have not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady: Option<Steady>,
    /// way in the whole periods over their time
    #[serde(rename = "mean_speed_m_s")]
    pub mean_speed: Real,
    /// x at the end of the run minus x at the start; what comes before and after whole periods counts
    #[serde(rename = "net_travel_m")]
    net_travel: Real,
    /// What happened in the last whole period.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_period: Option<LastPeriod>,
    /// why the last step is as long as it is, in sentences
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub why: Vec<String>,
    /// What fixed steps promise of a step, m; none of a tolerance.
    #[serde(skip)]
    promised: Option<f64>,
}

impl DriveSummary {
    /// The sentences of [`Self::why`] where the last period made no step, or one against its slower way; none otherwise.
    pub fn oddity(&self) -> &[String] {
        let is_odd = self.last_period.as_ref().is_some_and(why::is_odd);
        if is_odd { &self.why } else { &[] }
    }

    /// Length of the last step, m.
    pub fn last(&self) -> Real {
        self.last
    }

    /// Compares a settled step with that of the motion that was found directly: what fades slowly hides behind what fades fast, and
    /// steps do not tell of it, nor of what fixed steps miss. One that is farther away than settled steps are from their limit, and fixed
    /// steps from what they are to be, is of another motion.
    pub(super) fn compare(&mut self, motion: &Repetition) {
        let Some(steady) = &mut self.steady else { return };
        let apart = (steady.step.0 - motion.step.0 / motion.periods as f64).abs();
        let band = if self.promised.is_some() { COARSE } else { BAND };
        if motion.stable == Some(true) && apart <= band * steady.step.0.abs() {
            steady.widen(apart);
        }
    }
}

/// What the lengths of the steps do from period to period. Lengths are in m, changes and growth are those of one period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "state", rename_all = "snake_case")]
pub enum SettlingSummary {
    /// They stay what they are: the steady step says more.
    Settled,
    /// They are on their way, or too few to tell.
    NotSettled {
        /// their change per period, at the end
        #[serde(skip_serializing_if = "Option::is_none")]
        change_m: Option<Real>,
        /// where they lead
        #[serde(skip_serializing_if = "Option::is_none")]
        limit_m: Option<Real>,
        /// how far off that may be
        #[serde(skip_serializing_if = "Option::is_none")]
        limit_error_m: Option<Real>,
    },
    /// They change without a pattern, half of the last half of them by more than this to either side.
    Irregular {
        /// half of what lies between the longest and the shortest
        spread_m: Real,
    },
    /// They change in one direction, to no limit that could be told.
    Drifts {
        /// their change per period, at the end
        change_m: Real,
    },
    /// They swing about a mean.
    #[serde(rename = "oscillates")]
    Beats {
        /// drive periods of one oscillation
        periods: Real,
        /// share by which the oscillation grows per period; below 0 it decays
        #[serde(skip_serializing_if = "Option::is_none")]
        growth: Option<Real>,
        /// mean of the oscillation
        mean_m: Real,
        /// its amplitude at the end
        amplitude_m: Real,
    },
}

/// The step of a drive that has settled.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Steady {
    /// period, from 0, from which on every step lies within a thousandth of the limit
    #[serde(rename = "from_period")]
    pub from: usize,
    /// number of the last steps that the steady step is the mean of
    periods: usize,
    /// the steady step: their mean
    #[serde(rename = "step_m")]
    pub step: Real,
    /// how far the mean of all later steps may lie from it; at least as far as it is from the steady motion found directly,
    /// where that is stable and within a thousandth, of fixed steps within a tenth; with `frames` at least what may be lost of
    /// a stroke. What fixed steps miss by their length is not in it where no steady motion was found, nor what a tolerance
    /// allows
    #[serde(rename = "error_m")]
    pub error: Real,
    /// standard deviation of those steps
    #[serde(rename = "repeatability_m", skip_serializing_if = "Option::is_none")]
    pub repeatability: Option<Real>,
    /// What a step loses.
    #[serde(flatten)]
    pub losses: Losses,
}

impl Steady {
    /// Widens the error of the step.
    fn widen(&mut self, error: f64) {
        self.error = Real(self.error.0.max(error));
        if self.step.0.abs() <= self.error.0 {
            self.losses.back_step = None;
        }
    }
}

/// Periods after which a run ended before its time without a fault.
pub(super) fn steady_after(job: &Job, outcome: &Outcome) -> Option<usize> {
    let plan = &job.scenario.plan;
    let asked = plan.until_steady.filter(|_| outcome.error.is_none())?;
    let end = Some(outcome.state.time()).filter(|end| *end < plan.duration)?;
    let waveform = job.scenario.scene.waveforms.get(asked.waveform)?;
    Periods::until(&waveform.part, end).map(|periods| periods.count)
}

/// The steps of a run; none, with a note where that needs one, if there are no whole periods or no free body.
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
        // Where no body is free nobody asked for steps.
        if let Some(free) = scene.bodies.iter().find(|body| body.part.x.freedom == Freedom::Free) {
            notes.push(format!(
                "no steps: x of \"{}\", the body of figures, is not free; \"{}\" is one that is",
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
        // Nothing holds it any more: whatever it does in a period is no step.
        Some(_) => Bounds { most: 0.0, ..step_bounds(job) },
        // What flies a part of each period may come down anywhere.
        None if hops(job, outcome) => Bounds { most: f64::INFINITY, ..step_bounds(job) },
        None => step_bounds(job),
    };
    // Without contacts nothing tells what a step is but how far the body goes in a period.
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

/// That a scene of several free bodies has no step reported, for it does not say of which; none where there is nothing to choose.
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

/// Since when all contacts of the body of the figures are open, s, where that is a whole period of their waveform and more.
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

/// Whether the body of the figures is in the air for a good part of the time: one of its contacts, and all that there are.
fn hops(job: &Job, outcome: &Outcome) -> bool {
    let Some(body) = job.scenario.figures.body else { return false };
    let touching = job.scenario.scene.contacts.iter().enumerate();
    let mut own = touching.filter(|(_, contact)| contact.part.between.contains(&Side::Body(body))).peekable();
    let flies = |c: usize| outcome.tally.contact(c).and_then(|contact| contact.open_share());
    own.peek().is_some() && own.all(|(c, _)| flies(c).is_some_and(|share| share > FLIES))
}

/// What is known of a step before any is made.
///
/// A step below a hundredth of the natural displacement of the contacts is none; none is longer than twice the stroke, or than all strokes of a burst
/// to and fro, without being carried away; each may be off by the error that the stepper promises.
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

/// What fixed steps promise of a step, m: of frames what may be lost of a stroke, of others nothing is known; none of a tolerance.
fn promised(job: &Job) -> Option<f64> {
    match job.model.effective(job.scenario.plan.stepper).accuracy() {
        Accuracy::Tolerance(_) => None,
        Accuracy::Step(_) => Some(0.0),
        Accuracy::Frame { error, .. } => Some(error * stroke(job).unwrap_or(0.0)),
    }
}

/// Stroke of the waveform of the figures, where it is a length: one that a body or an actuator follows.
pub(super) fn stroke(job: &Job) -> Option<f64> {
    let (scene, waveform) = (&job.scenario.scene, job.scenario.figures.waveform?);
    let is_here = |signal: usize| scene.waveform_of(signal) == Some(waveform);
    let followed =
        scene.bodies.iter().any(|body| matches!(body.part.x.freedom, Freedom::Follows(w) if is_here(w)));
    let drives = scene.actuators.iter().any(|it| matches!(it.part.stroke, Varying::Follows(w) if is_here(w)));
    let (low, high) = scene.waveforms.get(waveform)?.part.range();
    (followed || drives).then_some(high - low)
}

/// All the way to and fro of the waveform of the figures in a period, m, as it looks at some moments: a burst goes several times.
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
