//! Steady motion of a drive: found directly where that is possible, else by waiting for it.
//!
//! [`steady::find`] leads into the motion that repeats itself, whether or not a run would stay in it. Where it is not
//! found, or a disturbance of it grows, the drive is run (`waiting`).

use super::waiting::{Unstable, waited};
use crate::steady::{self, Multiplier, Options, SteadyError};
use serde::{Deserialize, Serialize};
use stickslip_drive::Waveform;
use stickslip_run::{Job, Watcher};
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Most periods of the search for a motion that repeats itself, and where drivers or materials remember: what is found there is found
/// soon, and plays of a ceramic are not.
const SHOT: u32 = 400;
const SHOT_OF_BLOCKS: u32 = 100;
/// Its local error per step.
const TOLERANCE: f64 = 1e-9;

/// What the motion does at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Course {
    /// The same step in every period.
    Steady,
    /// Steps that swing about a mean.
    Beats,
    /// Steps that change without a pattern.
    Irregular,
}

/// Motion of the figures' body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Step along x in a period of the figures' waveform, m: of steps that swing or change without a pattern their mean.
    pub step: f64,
    /// How far the step may lie from its limit, m: an estimate. Of steps that swing or change without a pattern by 95 % how far
    /// the mean of all later ones may lie from it, which is not by how much they swing.
    pub error: f64,
    /// Amplitude of steps that swing, half the range of irregular ones, m; 0 of steady ones.
    pub spread: f64,
    /// Period of the figures' waveform, s.
    pub period: f64,
    /// What it does.
    pub course: Course,
    /// The largest Floquet multiplier, where the motion was found directly and has one.
    pub multiplier: Option<Multiplier>,
    /// Periods that were computed.
    pub work: u32,
    /// Least u_c of the body's contacts, m: the scale of steps; 0 without contacts.
    pub natural: f64,
}

/// Why there is no motion.
#[derive(Debug, Clone, PartialEq, Error, Serialize, Deserialize)]
pub enum Motionless {
    /// Nobody computed it: the curve was interrupted before.
    #[error("not run")]
    NotRun,
    /// The value makes no scenario.
    #[error(transparent)]
    #[serde(skip)]
    Scenario(#[from] ScenarioError),
    /// No waveform with a period makes steps, or no body.
    #[error("nothing has a period and a body whose steps could be counted")]
    NoSteps,
    /// The waveform ends.
    #[error("its waveform ends after {0} cycles: too few to become steady")]
    Ends(u32),
    /// The run stops itself, or the search does where waiting does not help either.
    #[error("{0}")]
    Stopped(String),
    /// A load, or what else pulls, drags the body away: it accelerates, or slips all through and goes as far in every period.
    #[error("slides away: after {periods} periods {step:.3e} m a period, {}", away(*step, *change))]
    SlidesAway {
        /// Periods that were run.
        periods: u32,
        /// The last step, m.
        step: f64,
        /// What it has changed, m.
        change: f64,
    },
    /// All contacts of the body are open: how far it flies in a period is no step.
    #[error(
        "in the air: after {periods} periods all contacts of the body are open, and what it flies in a period is no step"
    )]
    Flies {
        /// Periods that were run.
        periods: u32,
    },
    /// Steps that swing about those of a motion that a run leaves, or are those, and have come to nothing else yet.
    #[error(
        "leaves its steady motion: a disturbance grows by {:.2e} % a period, and after {periods} periods {step:.4e} m a period ± {spread:.1e} m are no other motion yet",
        100.0 * (growth - 1.0)
    )]
    Grows {
        /// Periods that were run.
        periods: u32,
        /// The mean step, m.
        step: f64,
        /// By what steps swing about it, m.
        spread: f64,
        /// By which factor a disturbance grows in a period.
        growth: f64,
    },
    /// Steps on their way.
    #[error(
        "steps go on changing: after {periods} periods {step:.3e} m, by {change:.1e} m from the last to this one"
    )]
    Unsettled {
        /// Periods that were run.
        periods: u32,
        /// The last step, m.
        step: f64,
        /// What it has changed, m.
        change: f64,
    },
}

/// Changes below this share of a step are none.
const EVEN: f64 = 1e-6;
/// A step below this share of the natural length is none.
pub(super) const STILL: f64 = 1e-5;

/// How a body goes on that slides away.
fn away(step: f64, change: f64) -> String {
    match change.abs() <= EVEN * step.abs() {
        true => "slipping all through".to_owned(),
        false => format!("{change:.1e} m more than in the one before: friction does not hold it"),
    }
}

impl Motion {
    /// The steady motion of a job, or the course that its steps take instead.
    ///
    /// # Errors
    /// Nothing that steps, a run that stops itself, steps that do not settle; [`Motionless::NotRun`] where the watcher wants an end.
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
        // All waveforms together may take several periods of this one.
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

    /// Mean speed along x, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.step / self.period
    }

    /// Power against a load that acts along -x, W; 0 where there is no step.
    #[must_use]
    pub fn power(&self, load: f64) -> f64 {
        if self.stands() { 0.0 } else { load * self.speed() }
    }

    /// Sense of its steps along x, 1 or -1; 1 of those that are none.
    #[must_use]
    pub fn sense(&self) -> f64 {
        if self.steps(-1.0) { -1.0 } else { 1.0 }
    }

    /// What it does, in a word or two: a steady motion may make no step.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.course {
            Course::Steady if self.stands() => "no step",
            Course::Steady => "steady",
            Course::Beats => "oscillates",
            Course::Irregular => "irregular",
        }
    }

    /// Whether it is steady without a step: what is told of one would be what it may be off.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.course == Course::Steady && self.is_still()
    }

    /// Whether it makes no step either way.
    #[must_use]
    pub fn is_still(&self) -> bool {
        !self.steps(1.0) && !self.steps(-1.0)
    }

    /// Whether it steps along a direction, 1 or -1: further than the error and than a hundred-thousandth of u_c.
    #[must_use]
    pub fn steps(&self, direction: f64) -> bool {
        direction * self.step > self.least().max(self.error)
    }

    /// A step that is no longer counts as none, m.
    pub(super) fn least(&self) -> f64 {
        STILL * self.natural
    }
}

impl Motionless {
    /// Whether there is no steady step, for what is known: a load drags the drive away, or its steps become less so slowly that
    /// they do not end within the periods that were run, but would not last as many again.
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

    /// Whether what was found is more than that somebody wanted an end, or that the value makes no scenario, which is soon found again.
    pub(super) fn is_no_end(found: &Result<Motion, Self>) -> bool {
        !matches!(found, Err(Self::NotRun | Self::Scenario(_)))
    }

    /// The kind of reason, in a word or two.
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

/// The waveform whose period is that of the steps.
pub(super) fn waveform(job: &Job) -> Result<&Waveform, Motionless> {
    let place = job.scenario.figures.waveform.ok_or(Motionless::NoSteps)?;
    let named = job.scenario.scene.waveforms.get(place).ok_or(Motionless::NoSteps)?;
    Ok(&named.part)
}

/// Least u_c of the contacts of a body, m; of all of them where it has none of its own; 0 where there are none.
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
