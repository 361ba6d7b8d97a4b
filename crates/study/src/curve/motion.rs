//! Steady motion of a drive: by shooting if possible, otherwise by simulation until it is steady.
//!
//! [`steady::find`] searches for a periodic orbit. Without an orbit or with an unstable orbit, the drive is simulated (`waiting`).

use super::waiting::{Unstable, waited};
use crate::steady::{self, Multiplier, Options, SteadyError};
use serde::{Deserialize, Serialize};
use stickslip_drive::Waveform;
use stickslip_run::{Job, Watcher};
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Maximum number of periods of the shooting search, without and with internal states of piezo drivers or materials. Successful searches
/// with such states are short; models with ceramic hysteresis (play operators) often have no periodic orbit.
const SHOT: u32 = 400;
const SHOT_OF_BLOCKS: u32 = 100;
/// Tolerance of the local error per time step.
const TOLERANCE: f64 = 1e-9;

/// Type of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Course {
    /// Every period has the same step length.
    Steady,
    /// The step length oscillates about a mean.
    Beats,
    /// The step length varies irregularly.
    Irregular,
}

/// Motion of the body named in `figures`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Step length along x per period of the waveform named in `figures`, m. Mean of oscillating or irregular steps.
    pub step: f64,
    /// Estimated error of the step length, m. For oscillating or irregular steps: 95 % confidence half-width of their long-term mean.
    pub error: f64,
    /// Amplitude of oscillating steps or half the range of irregular steps, m. 0 for steady steps.
    pub spread: f64,
    /// Period of the waveform named in `figures`, s.
    pub period: f64,
    /// Type of the motion.
    pub course: Course,
    /// Floquet multiplier of largest modulus. `None` if the motion was found by simulation or the orbit has no multipliers.
    pub multiplier: Option<Multiplier>,
    /// Number of simulated periods.
    pub work: u32,
    /// Smallest gross slip displacement u_c of the body's contacts, m: the scale of the step length. 0 without contacts.
    pub natural: f64,
}

/// Reason why there is no steady motion.
#[derive(Debug, Clone, PartialEq, Error, Serialize, Deserialize)]
pub enum Motionless {
    /// The curve was interrupted before this point was computed.
    #[error("not run")]
    NotRun,
    /// The parameter value gives an invalid scenario.
    #[error(transparent)]
    #[serde(skip)]
    Scenario(#[from] ScenarioError),
    /// No periodic waveform, or no body whose steps are evaluated.
    #[error("no periodic waveform and free body determine the steps")]
    NoSteps,
    /// The waveform ends after a few cycles.
    #[error("the waveform ends after {0} cycles, before the steps are steady")]
    Ends(u32),
    /// The run or the search for the periodic orbit stopped with an error.
    #[error("{0}")]
    Stopped(String),
    /// The body is dragged away: it accelerates, or it slips during the whole period and moves equally far in every period.
    #[error("slides away: after {periods} periods the body moves by {step:.3e} m per period, {}", away(*step, *change))]
    SlidesAway {
        /// Number of simulated periods.
        periods: u32,
        /// Last step length, m.
        step: f64,
        /// Change of the last step length, m.
        change: f64,
    },
    /// All contacts of the body are open. The displacement of a flying body per period does not count as a step.
    #[error(
        "in the air: after {periods} periods all contacts of the body are open, so its displacement per period is not a step"
    )]
    Flies {
        /// Number of simulated periods.
        periods: u32,
    },
    /// The motion leaves an unstable periodic orbit, but has not reached another motion.
    #[error(
        "leaves the periodic orbit: a disturbance grows by {:.2e} % per period; after {periods} periods the step is {step:.4e} m ± {spread:.1e} m and has not settled",
        100.0 * (growth - 1.0)
    )]
    Grows {
        /// Number of simulated periods.
        periods: u32,
        /// Mean step length, m.
        step: f64,
        /// Amplitude of the oscillation of the steps, m.
        spread: f64,
        /// Growth factor of a disturbance per period.
        growth: f64,
    },
    /// The step length still changes.
    #[error(
        "not settled: after {periods} periods the step of {step:.3e} m still changes by {change:.1e} m per period"
    )]
    Unsettled {
        /// Number of simulated periods.
        periods: u32,
        /// Last step length, m.
        step: f64,
        /// Change of the last step length, m.
        change: f64,
    },
}

/// Relative change of the step length below which it counts as constant.
const EVEN: f64 = 1e-6;
/// Step length, relative to the gross slip displacement u_c, below which a motion counts as no step.
pub(super) const STILL: f64 = 1e-5;

/// Describes the motion of a body that slides away.
fn away(step: f64, change: f64) -> String {
    match change.abs() <= EVEN * step.abs() {
        true => "in permanent slip".to_owned(),
        false => format!("{change:.1e} m more than in the period before: friction does not hold the body"),
    }
}

impl Motion {
    /// Computes the steady motion of a scenario.
    ///
    /// # Errors
    /// Fails if nothing makes steps, the run stops with an error or the steps do not settle. Returns
    /// [`Motionless::NotRun`] if the watcher interrupts.
    pub fn of(job: &Job, watcher: &dyn Watcher) -> Result<Self, Motionless> {
        let goes_on = || watcher.goes_on();
        let periods = if job.scenario.scene.blocks.is_empty() { SHOT } else { SHOT_OF_BLOCKS };
        let options = Options { tolerance: TOLERANCE, periods, goes_on: &goes_on, ..Options::default() };
        match steady::find(job, &options) {
            Ok(found) if found.is_stable() => Self::found(job, &found),
            Ok(found) => {
                let period = waveform(job)?.period().ok_or(Motionless::NoSteps)?;
                let share = 1.0 / found.periods_of(period);
                let leaves = found.step.map(|step| Unstable {
                    step: share * step,
                    error: share * found.bound,
                    growth: math::powf(found.radius(), share),
                });
                let motion = waited(job, watcher, leaves)?;
                Ok(Self { work: motion.work + found.work, ..motion })
            }
            Err(SteadyError::Interrupted(_)) => Err(Motionless::NotRun),
            Err(
                SteadyError::NoConvergence { .. }
                | SteadyError::Shakedown { .. }
                | SteadyError::Gains { .. }
                | SteadyError::Commanded(_)
                | SteadyError::Endless(_)
                | SteadyError::Incommensurate { .. }
                | SteadyError::Flies { .. }
                | SteadyError::Run(_),
            ) => waited(job, watcher, None),
            Err(error) => Err(Motionless::Stopped(error.to_string())),
        }
    }

    fn found(job: &Job, found: &steady::Steady) -> Result<Self, Motionless> {
        let body = job.scenario.figures.body.ok_or(Motionless::NoSteps)?;
        let period = waveform(job)?.period().ok_or(Motionless::NoSteps)?;
        // The common period of all waveforms may be a multiple of the period of this waveform.
        let share = 1.0 / found.periods_of(period);
        let step = share * found.step.ok_or(Motionless::NoSteps)?;
        let natural = natural(job, body);
        if found.is_dragged && step.abs() > STILL * natural {
            return Err(Motionless::SlidesAway { periods: found.work, step, change: 0.0 });
        }
        Ok(Self {
            step,
            error: share * found.bound,
            spread: 0.0,
            period,
            course: Course::Steady,
            multiplier: found.multipliers.first().copied(),
            work: found.work,
            natural,
        })
    }

    /// Returns the mean velocity along x, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.step / self.period
    }

    /// Returns the power against a load along -x, W. 0 without steps.
    #[must_use]
    pub fn power(&self, load: f64) -> f64 {
        if self.stands() { 0.0 } else { load * self.speed() }
    }

    /// Returns the direction of the steps along x, 1 or -1. Returns 1 without steps.
    #[must_use]
    pub fn sense(&self) -> f64 {
        if self.steps(-1.0) { -1.0 } else { 1.0 }
    }

    /// Returns the type of the motion in one or two words. Steady motion without steps is `no step`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.course {
            Course::Steady if self.stands() => "no step",
            Course::Steady => "steady",
            Course::Beats => "oscillates",
            Course::Irregular => "irregular",
        }
    }

    /// Returns whether the motion is steady with a step length that is below its error or negligible.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.course == Course::Steady && self.is_still()
    }

    /// Returns whether the motion makes no steps in either direction.
    #[must_use]
    pub fn is_still(&self) -> bool {
        !self.steps(1.0) && !self.steps(-1.0)
    }

    /// Returns whether the step length in a direction, 1 or -1, exceeds both its error and 1e-5 u_c.
    #[must_use]
    pub fn steps(&self, direction: f64) -> bool {
        direction * self.step > self.least().max(self.error)
    }

    /// Returns the shortest displacement per period that counts as a step, m.
    pub(super) fn least(&self) -> f64 {
        STILL * self.natural
    }
}

impl Motionless {
    /// Returns whether this reason implies that the drive makes no steady step.
    ///
    /// The drive makes no steady step if a load drags the body away, or if the step length, at its present rate of decrease, would vanish
    /// within twice the simulated periods.
    #[must_use]
    pub fn makes_no_step(&self) -> bool {
        match self {
            Self::SlidesAway { .. } => true,
            Self::Unsettled { periods, step, change } => {
                -change * step.signum() * f64::from(*periods) >= 0.5 * step.abs()
            }
            _ => false,
        }
    }

    /// Returns whether the journal stores a result. Only interruptions and invalid scenarios are not stored.
    pub(super) fn is_no_end(found: &Result<Motion, Self>) -> bool {
        !matches!(found, Err(Self::NotRun | Self::Scenario(_)))
    }

    /// Returns the kind of reason in a few words.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NotRun => "not run",
            Self::Scenario(_) => "refused",
            Self::NoSteps | Self::Ends(_) => "no steps to count",
            Self::Stopped(_) => "stopped",
            Self::SlidesAway { .. } => "slides away",
            Self::Flies { .. } => "in the air",
            Self::Grows { .. } => "leaves",
            Self::Unsettled { .. } => "not settled",
        }
    }
}

/// Returns the waveform whose period is the period of the steps.
pub(super) fn waveform(job: &Job) -> Result<&Waveform, Motionless> {
    let place = job.scenario.figures.waveform.ok_or(Motionless::NoSteps)?;
    let named = job.scenario.scene.waveforms.get(place).ok_or(Motionless::NoSteps)?;
    Ok(&named.part)
}

/// Returns the smallest gross slip displacement u_c of a body's contacts, m. Considers all contacts of the model if the body has no
/// contacts. Returns 0 if the model has no contacts.
pub(super) fn natural(job: &Job, body: usize) -> f64 {
    use stickslip_drive::scene::Side;
    let contacts = &job.scenario.scene.contacts;
    let least = |own: bool| {
        let all = contacts.iter().enumerate();
        let counted = all.filter(|(_, contact)| !own || contact.part.between.contains(&Side::Body(body)));
        let lengths = counted.map(|(c, _)| job.contact_scale(c).0).filter(|length| *length > 0.0);
        lengths.reduce(f64::min)
    };
    least(true).or_else(|| least(false)).unwrap_or(0.0)
}
