//! Methods in a benchmark, and the time integrators of the program.

use crate::clock::{Stopwatch, Times};
use crate::problem::Problem;
use crate::samples::{Sampler, Samples};
use stickslip_drive::scene::EngineChoice;
use stickslip_drive::{Accuracy, Counts, Limits, Model, Plan, RunError, Scene, Stepper};
use stickslip_run::Unrecorded;
use stickslip_run::Watcher;

/// Method that solves a problem at a tolerance or with a step.
pub(crate) trait Contestant {
    /// Runs once. Returns samples of the free coordinates, and counts. Fails after `wall` s.
    fn sample(&self, value: f64, wall: f64, watcher: &dyn Watcher) -> Result<(Samples, Counts), Stop>;

    /// Runs several times without output. Returns the times of one run.
    fn time(&self, value: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop>;
}

/// Reason why a method has no result.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Stop {
    /// The time limit was reached.
    Slow,
    /// Interrupted by the watcher.
    Interrupted,
    /// Error of the run.
    Failed(String),
}

impl From<RunError> for Stop {
    fn from(error: RunError) -> Self {
        match error {
            RunError::OutOfTime { .. } => Self::Slow,
            RunError::Interrupted { .. } => Self::Interrupted,
            other => Self::Failed(other.to_string()),
        }
    }
}

/// Time integrator of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stepping {
    Event,
    Dopri5,
    Rk4,
    Verlet,
    Frames,
}

impl Stepping {
    pub(crate) const ALL: [Self; 5] = [Self::Event, Self::Dopri5, Self::Rk4, Self::Verlet, Self::Frames];

    pub(crate) fn name(self) -> &'static str {
        self.at(0.0, 0.0).name()
    }

    /// Returns whether the integrator has a fixed step instead of a tolerance.
    pub(crate) fn is_fixed(self) -> bool {
        matches!(self.at(0.0, 0.0).accuracy(), Accuracy::Step(_))
    }

    /// Returns the stepper with a tolerance or a step (s); frames last as long as a sample interval, s.
    fn at(self, value: f64, interval: f64) -> Stepper {
        match self {
            Self::Event => Stepper::Event { tolerance: value },
            Self::Dopri5 => Stepper::Dopri5 { tolerance: value },
            Self::Rk4 => Stepper::Rk4 { step: value },
            Self::Verlet => Stepper::Verlet { step: value },
            Self::Frames => Stepper::Frames { length: interval, accuracy: value },
        }
    }
}

/// Returns the model with all contacts on the exact memory curve, or on rows of springs with these lengths.
pub(crate) fn with_engine(scene: &Scene, springs: Option<(usize, &[Option<f64>])>) -> Scene {
    let mut scene = scene.clone();
    for (c, contact) in scene.contacts.iter_mut().enumerate() {
        contact.part.engine = match springs {
            None => EngineChoice::Curve,
            Some((count, spans)) => EngineChoice::Springs { count, span: spans.get(c).copied().flatten() },
        };
    }
    scene
}

/// Time integrator of the program with one of its contact engines.
pub(crate) struct Own<'p> {
    problem: &'p Problem,
    model: Model,
    stepping: Stepping,
}

impl<'p> Own<'p> {
    pub(crate) fn new(problem: &'p Problem, model: Model, stepping: Stepping) -> Self {
        Self { problem, model, stepping }
    }

    fn plan(&self, value: f64, wall: Option<f64>, every: Option<f64>) -> Plan {
        let limits = Limits { wall, ..Limits::default() };
        Plan {
            duration: self.problem.duration,
            stepper: self.stepping.at(value, Samples::interval(self.problem.duration)),
            limits,
            every,
            until_steady: None,
        }
    }
}

impl Contestant for Own<'_> {
    fn sample(&self, value: f64, wall: f64, watcher: &dyn Watcher) -> Result<(Samples, Counts), Stop> {
        let plan = self.plan(value, Some(wall), Some(Samples::interval(self.problem.duration)));
        let mut sampler = Sampler::new(&self.problem.columns, watcher);
        let mut state = self.model.start(&plan).map_err(|error| Stop::Failed(error.to_string()))?;
        stickslip_drive::run(&self.model, &plan, &mut state, &mut sampler)?;
        Ok((sampler.samples, state.counts()))
    }

    fn time(&self, value: f64, times: u32, watcher: &dyn Watcher) -> Result<Times, Stop> {
        let plan = self.plan(value, None, None);
        let start = self.model.start(&plan).map_err(|error| Stop::Failed(error.to_string()))?;
        let mut states = vec![start; times as usize];
        let watch = Stopwatch::start();
        for state in &mut states {
            stickslip_drive::run(&self.model, &plan, state, &mut Unrecorded(watcher))?;
        }
        Ok(watch.each(times))
    }
}
