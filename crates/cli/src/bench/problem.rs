//! A scenario as a problem to be solved: its reference, and how far an answer is from it.

use super::baseline::Mechanism;
use super::contestant::with_engine;
use super::norm::{self, Coordinate, Errors, Norm};
use super::samples::{Sampler, Samples};
use crate::interrupt::Interrupt;
use stickslip_contact::Interface;
use stickslip_drive::scene::Side;
use stickslip_drive::{Limits, Model, Plan, RunError, Scene, SceneError, Stepper};
use stickslip_results::Job;
use thiserror::Error;

/// Tolerance of the reference: two orders below the finest run …
pub(super) const REFERENCE: f64 = 1e-14;
/// … and of the run that tells how sure the reference is of itself.
pub(super) const CHECK: f64 = 1e-13;
/// A row of springs reaches this much further than the deepest indentation of the reference.
const REACH: f64 = 1.05;

/// A scenario with its reference.
pub(super) struct Problem {
    pub(super) scene: Scene,
    /// Simulated time, s.
    pub(super) duration: f64,
    /// The exact model.
    pub(super) model: Model,
    /// Columns of the free coordinates in a row.
    pub(super) columns: Vec<usize>,
    pub(super) norm: Norm,
    pub(super) reference: Samples,
    /// Difference between the reference and a run at ten times its tolerance.
    pub(super) doubt: Errors,
    /// Lengths of the rows of springs that hold a contact at its deepest, m; none where the load is constant.
    pub(super) spans: Vec<Option<f64>>,
    /// The scene as the baselines see it, or what they do not know of it.
    pub(super) mechanism: Result<Mechanism, String>,
    /// Coordinates at the end known from elsewhere, m or rad.
    pub(super) known: Vec<(usize, f64)>,
}

/// A channel's value at the end, known from elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Known {
    pub(crate) channel: String,
    pub(crate) value: f64,
}

/// Why a scenario is no problem to measure by.
#[derive(Debug, Clone, PartialEq, Error)]
pub(super) enum ProblemError {
    #[error("{0}: nothing is free, so there is nothing to integrate")]
    NothingFree(String),
    #[error("{0}: nothing moves, so there is no length to measure errors by")]
    NothingMoves(String),
    #[error("{name}: --known {channel}: expected a free coordinate, one of {choice}")]
    Channel { name: String, channel: String, choice: String },
    #[error("{name}: {source}")]
    Scene { name: String, source: SceneError },
    #[error("{name}: the reference at a tolerance of {tolerance:e}: {source}")]
    Reference { name: String, tolerance: f64, source: RunError },
}

impl Problem {
    /// Computes the reference of a scenario.
    pub(super) fn new(job: &Job, known: &[Known], interrupt: &Interrupt) -> Result<Self, ProblemError> {
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
            let mut sampler = Sampler::new(&columns, interrupt).watching(depths.iter().copied());
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
    pub(super) fn scales(&self) -> Vec<(f64, f64)> {
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
    pub(super) fn errors(&self, samples: &Samples) -> (Errors, Option<f64>) {
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
