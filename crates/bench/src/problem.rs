//! A scenario as a problem to be solved: its reference, and how far an answer is from it.

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

/// Tolerance of the reference: two orders below the finest run …
pub(crate) const REFERENCE: f64 = 1e-14;
/// … and of the run that tells how sure the reference is of itself.
pub(crate) const CHECK: f64 = 1e-13;
/// A row of springs reaches this much further than the deepest indentation of the reference.
const REACH: f64 = 1.05;

/// A scenario with its reference.
pub(crate) struct Problem {
    pub(crate) scene: Scene,
    /// Simulated time, s.
    pub(crate) duration: f64,
    /// The exact model.
    pub(crate) model: Model,
    /// Columns of the free coordinates in a row.
    pub(crate) columns: Vec<usize>,
    pub(crate) norm: Norm,
    pub(crate) reference: Samples,
    /// Difference between the reference and a run at ten times its tolerance.
    pub(crate) doubt: Errors,
    /// Lengths of the rows of springs that hold a contact at its deepest, m; none where the load is constant.
    pub(crate) spans: Vec<Option<f64>>,
    /// The scene as the baselines see it, or what they do not know of it.
    pub(crate) mechanism: Result<Mechanism, String>,
    /// Coordinates at the end known from elsewhere, m or rad.
    pub(crate) known: Vec<(usize, f64)>,
}

/// A channel's value at the end, known from elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// Name of the channel, such as `slider.x_m`.
    pub channel: String,
    /// Its value, m or rad.
    pub value: f64,
}

/// Why a scenario is no problem to measure by.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ProblemError {
    /// Without equations of motion.
    #[error("{0}: nothing is free, so there is nothing to integrate")]
    NothingFree(String),
    /// Without a length to measure by.
    #[error("{0}: nothing moves, so there is no length to measure errors by")]
    NothingMoves(String),
    /// Something known of what is no free coordinate.
    #[error("{name}: --known {channel}: expected a free coordinate, one of {choice}")]
    Channel {
        /// The scenario.
        name: String,
        /// What stands there.
        channel: String,
        /// What could.
        choice: String,
    },
    /// A scene that the exact engine refuses.
    #[error("{name}: {source}")]
    Scene {
        /// The scenario.
        name: String,
        /// What is wrong with it.
        source: SceneError,
    },
    /// A reference that did not come to its end.
    #[error("{name}: the reference at a tolerance of {tolerance:e}: {source}")]
    Reference {
        /// The scenario.
        name: String,
        /// Tolerance of the run.
        tolerance: f64,
        /// What the run says.
        source: RunError,
    },
}

impl Problem {
    /// Computes the reference of a scenario.
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

    /// Natural length (m) and velocity (m/s) of each free coordinate: those of the first contact that it moves.
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

    /// Errors against the reference, and the largest against what is known from elsewhere.
    pub(crate) fn errors(&self, samples: &Samples) -> (Errors, Option<f64>) {
        let known = self.known.iter().map(|(i, value)| self.norm.against(*i, samples.end()[*i], *value));
        (self.norm.errors(samples, &self.reference), known.reduce(f64::max))
    }
}

/// Lengths of rows of springs.
fn spans(job: &Job, model: &Model, deepest: &[(usize, f64)]) -> Vec<Option<f64>> {
    let laws: Vec<&Interface> = model.contacts().map(|(_, law)| law).collect();
    let span = |(c, law): (usize, &&Interface)| {
        let (_, d) = deepest.get(c).filter(|_| !job.has_constant_load(c))?;
        Some(2.0 * law.profile().radius(REACH * d))
    };
    laws.iter().enumerate().map(span).collect()
}
