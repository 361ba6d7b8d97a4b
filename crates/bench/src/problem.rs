//! Scenario as a benchmark problem, with its reference solution and errors.

use crate::baseline::Mechanism;
use crate::contestant::with_engine;
use crate::norm::{self, Coordinate, Errors, Norm};
use crate::samples::{Sampler, Samples};
use stickslip_contact::Interface;
use stickslip_drive::scene::Side;
use stickslip_drive::{Limits, Model, Plan, RunError, Scene, SceneError, Stepper};
use stickslip_run::Job;
use stickslip_run::Watcher;
use thiserror::Error;

/// Tolerance of the reference solution, two orders of magnitude below the finest run.
pub(crate) const REFERENCE: f64 = 1e-14;
/// Tolerance of a second run that estimates the error of the reference.
pub(crate) const CHECK: f64 = 1e-13;
/// Factor on the largest indentation of the reference. Rows of springs have the length of the contact width at the resulting indentation.
const REACH: f64 = 1.05;

/// Scenario with its reference solution.
pub(crate) struct Problem {
    pub(crate) scene: Scene,
    /// Simulated time, s.
    pub(crate) duration: f64,
    /// Model with exact contacts.
    pub(crate) model: Model,
    /// Columns of the free coordinates.
    pub(crate) columns: Vec<usize>,
    pub(crate) norm: Norm,
    pub(crate) reference: Samples,
    /// Difference between the reference and the run at ten times its tolerance.
    pub(crate) doubt: Errors,
    /// Lengths of the rows of springs, m; `None` for contacts under constant load.
    pub(crate) spans: Vec<Option<f64>>,
    /// Model for the reference implementations. The error names an unsupported feature.
    pub(crate) mechanism: Result<Mechanism, String>,
    /// Known coordinates at the end, m or rad.
    pub(crate) known: Vec<(usize, f64)>,
}

/// Known value of a channel at the end.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// Name of the channel, such as `slider.x_m`.
    pub channel: String,
    /// Value, m or rad.
    pub value: f64,
}

/// Reason why a scenario is not suitable for a benchmark.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ProblemError {
    /// The model has no free coordinate.
    #[error("{0}: no coordinate is free, so there is no motion to integrate")]
    NothingFree(String),
    /// Nothing moves, so there is no length to which errors are relative.
    #[error("{0}: nothing moves, so there is no length to which errors are relative")]
    NothingMoves(String),
    /// A known value belongs to a channel that is not a free coordinate.
    #[error("{name}: --known {channel}: expected a free coordinate, one of {choice}")]
    Channel {
        /// Name of the scenario.
        name: String,
        /// Channel given by the user.
        channel: String,
        /// List of the possible channels.
        choice: String,
    },
    /// The model is invalid with exact contacts.
    #[error("{name}: {source}")]
    Scene {
        /// Name of the scenario.
        name: String,
        /// Error of the model.
        source: SceneError,
    },
    /// The reference run failed.
    #[error("{name}: the reference at a tolerance of {tolerance:e}: {source}")]
    Reference {
        /// Name of the scenario.
        name: String,
        /// Tolerance of the run.
        tolerance: f64,
        /// Error of the run.
        source: RunError,
    },
}

impl Problem {
    /// Computes the reference solution of a scenario.
    pub(crate) fn new(job: &Job, known: &[Known], watcher: &dyn Watcher) -> Result<Self, ProblemError> {
        let name = || job.name.clone();
        let scenario = &job.scenario;
        let coordinates = norm::coordinates(&scenario.scene);
        if coordinates.is_empty() {
            return Err(ProblemError::NothingFree(name()));
        }
        let known = known.iter().map(|known| {
            let place = coordinates.iter().position(|coordinate| coordinate.channel == known.channel);
            let choice = || coordinates.iter().map(|c| c.channel.clone()).collect::<Vec<_>>().join(", ");
            let unknown =
                || ProblemError::Channel { name: name(), channel: known.channel.clone(), choice: choice() };
            Ok((place.ok_or_else(unknown)?, known.value))
        });
        let known = known.collect::<Result<Vec<_>, _>>()?;
        let scene = with_engine(&scenario.scene, None);
        let model = Model::new(&scene).map_err(|source| ProblemError::Scene { name: name(), source })?;
        let channels = model.channels();
        let column = |wanted: &str| channels.iter().position(|channel| channel.name == wanted);
        let columns: Vec<usize> = coordinates.iter().filter_map(|c| column(&c.channel)).collect();
        let depths: Vec<usize> =
            scene.contacts.iter().filter_map(|contact| column(&format!("{}.d_m", contact.name))).collect();
        let duration = scenario.plan.duration;
        let fine = |tolerance| {
            let plan = Plan {
                duration,
                stepper: Stepper::Event { tolerance },
                limits: Limits::default(),
                every: Some(Samples::interval(duration)),
                until_steady: None,
            };
            let mut state =
                model.start(&plan).map_err(|source| ProblemError::Scene { name: name(), source })?;
            let mut sampler = Sampler::new(&columns, watcher).watching(depths.iter().copied());
            stickslip_drive::run(&model, &plan, &mut state, &mut sampler)
                .map_err(|source| ProblemError::Reference { name: name(), tolerance, source })?;
            Ok((sampler.samples, sampler.largest))
        };
        let ((reference, deepest), (check, _)) = (fine(REFERENCE)?, fine(CHECK)?);
        let norm = Norm::new(&scene, scenario.figures, coordinates, &reference)
            .ok_or_else(|| ProblemError::NothingMoves(name()))?;
        let doubt = norm.errors(&check, &reference);
        let spans = spans(job, &model, &deepest);
        let plan = Plan {
            duration,
            stepper: Stepper::Event { tolerance: REFERENCE },
            limits: Limits::default(),
            every: None,
            until_steady: None,
        };
        let start = model.start(&plan).map_err(|source| ProblemError::Scene { name: name(), source })?;
        let mechanism = Mechanism::new(&scene, &model, &start);
        Ok(Self { scene, duration, model, columns, norm, reference, doubt, spans, mechanism, known })
    }

    /// Returns natural length, m, and velocity, m/s, of each free coordinate: the natural units of the first contact of its body.
    pub(crate) fn scales(&self) -> Vec<(f64, f64)> {
        let touches =
            |body: usize, c: &usize| self.scene.contacts[*c].part.between.contains(&Side::Body(body));
        let natural = |coordinate: &Coordinate| {
            let contact = (0..self.scene.contacts.len()).find(|c| touches(coordinate.body, c));
            let natural = contact.and_then(|c| self.model.contact_natural(c));
            natural.map_or((self.norm.length, 1.0), |natural| (natural.displacement, natural.velocity))
        };
        self.norm.coordinates.iter().map(natural).collect()
    }

    /// Returns the errors relative to the reference, and the largest error relative to known values.
    pub(crate) fn errors(&self, samples: &Samples) -> (Errors, Option<f64>) {
        let known = self.known.iter().map(|(i, value)| self.norm.against(*i, samples.end()[*i], *value));
        (self.norm.errors(samples, &self.reference), known.reduce(f64::max))
    }
}

/// Returns the lengths of rows of springs.
fn spans(job: &Job, model: &Model, deepest: &[(usize, f64)]) -> Vec<Option<f64>> {
    let laws: Vec<&Interface> = model.contacts().map(|(_, law)| law).collect();
    let span = |(c, law): (usize, &&Interface)| {
        let (_, d) = deepest.get(c).filter(|_| !job.has_constant_load(c))?;
        Some(2.0 * law.profile().radius(REACH * d))
    };
    laws.iter().enumerate().map(span).collect()
}
