//! Holding force of a drive at rest in one direction.

use crate::curve::Bracket;
use stickslip_drive::facts::{Pressed, Setup};
use stickslip_drive::scene::{Axis, Load, Scene, Start, Varying};
use stickslip_drive::{Model, Part, Plan, SceneError, SceneFault, Stepper, WALK_TOLERANCE};
use stickslip_run::Watcher;
use stickslip_scenario::{Scenario, ScenarioError};
use thiserror::Error;

/// Ratio of the largest test load to the sum of all forces. If the drive holds this load, a spring or another part holds it.
const ENDLESS: f64 = 64.0;
/// Uncertainty of the force equilibrium, as a fraction of the sum of friction and other forces. The search for the equilibrium allows a
/// residual of 1e-9 per coordinate.
const RESOLVED: f64 = 4e-9;
/// Holding forces below this fraction of the sum of friction and other forces count as zero.
const NOTHING: f64 = 1e-12;

/// Holding force with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// Largest load that is held, N.
    pub force: f64,
    /// Uncertainty of the load, N: half of the bracket plus the uncertainty of the equilibrium.
    pub half_width: f64,
    /// Body and coordinate without equilibrium at larger loads.
    pub lost: Lost,
    /// Number of equilibrium searches.
    pub runs: u32,
}

/// Coordinate without equilibrium.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lost {
    /// Name of the body.
    pub body: String,
    /// Coordinate of the body.
    pub axis: Axis,
}

impl Lost {
    /// Returns a phrase that describes the motion of the body, such as `slider slides away`.
    #[must_use]
    pub fn words(&self) -> String {
        let does = match self.axis {
            Axis::X => "slides away",
            Axis::Z => "comes loose",
            // A tilting body changes its normal forces, so sliding and tilting cannot be distinguished.
            Axis::Pitch => "slides or tips over",
        };
        format!("{} {does}", self.body)
    }
}

/// Reason why there is no holding force.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Holdless {
    /// The computation was interrupted before this point.
    #[error("not run")]
    NotRun,
    /// The scenario is invalid or has no equilibrium search.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The drive has no equilibrium even without the load.
    #[error("without a load, {}", .0.words())]
    Without(Lost),
    /// Something other than friction holds the load.
    #[error(
        "no finite holding force: the drive holds {load:.3e} N, {ENDLESS} times all friction and other \
         forces, so a spring or another part holds the body"
    )]
    Endless {
        /// A load that is held, N.
        load: f64,
    },
}

impl Holdless {
    /// Returns the kind of reason in a few words.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NotRun => "not run",
            Self::Scenario(_) => "refused",
            Self::Without(_) => "held by nothing",
            Self::Endless { .. } => "no finite force",
        }
    }
}

/// A drive at rest with a loaded body.
pub(super) struct Still {
    scenario: Scenario,
    plan: Plan,
    body: usize,
}

impl Still {
    /// Creates the drive from a scenario; `body` is the index of the loaded body.
    pub(super) fn new(mut scenario: Scenario, body: usize) -> Self {
        scenario.scene.start = Start::Equilibrium;
        // There is no time integration, so a time step that is too long for a run has no effect.
        let plan = Plan { stepper: Stepper::Event { tolerance: WALK_TOLERANCE }, ..scenario.plan };
        Self { scenario, plan, body }
    }

    /// Finds the largest load with an equilibrium, to a relative tolerance. `sense` is the direction of the load along x, 1 or -1.
    ///
    /// # Errors
    /// Fails if the drive is not held without load, the load is not limited by friction, or the watcher interrupts.
    pub(super) fn held(&self, sense: f64, tolerance: f64, watcher: &dyn Watcher) -> Result<Held, Holdless> {
        let mut runs = 0;
        let mut lost = None;
        let mut try_at = |load: f64| -> Result<Option<f64>, Holdless> {
            if !watcher.goes_on() {
                return Err(Holdless::NotRun);
            }
            runs += 1;
            let gives_way = self.gives_way(sense * load)?;
            let holds = gives_way.is_none().then_some(1.0);
            lost = gives_way.or_else(|| lost.take());
            Ok(holds)
        };
        if try_at(0.0)?.is_none() {
            let without = |lost| Err(Holdless::Without(lost));
            return lost.map_or(Err(Holdless::NotRun), without);
        }
        let scale = self.scale()?;
        if try_at(ENDLESS * scale)?.is_some() {
            return Err(Holdless::Endless { load: ENDLESS * scale });
        }
        // Start at the sum of all forces and double or halve the load, so that the bracket is not wider than its lower end.
        let mut still = 2.0 * scale;
        while try_at(still)?.is_some() {
            still *= 2.0;
        }
        let mut holds = 0.5 * still;
        while holds > NOTHING * scale && try_at(holds)?.is_none() {
            (still, holds) = (holds, 0.5 * holds);
        }
        // Reserve a part of the tolerance for the uncertainty of the equilibrium.
        let known = RESOLVED * scale;
        let narrow = (tolerance - 2.0 * known / holds).max(0.5 * tolerance);
        let bracket = match holds > NOTHING * scale {
            true => Bracket::narrow(vec![(holds, 1.0)], still, narrow, |load, _| try_at(load))?,
            false => None,
        };
        let (force, half_width) =
            bracket.map_or((0.0, still), |bracket| (bracket.middle(), bracket.half_width() + known));
        lost.map_or(Err(Holdless::NotRun), |lost| Ok(Held { force, half_width, lost, runs }))
    }

    /// Returns the coordinate without equilibrium under a load, or `None` if the drive holds the load.
    fn gives_way(&self, load: f64) -> Result<Option<Lost>, Holdless> {
        let mut scene = self.scenario.scene.clone();
        if load != 0.0 {
            scene.loads.push(Load { on: self.body, x: Varying::Constant(load), ..Load::default() });
        }
        match Model::new(&scene).and_then(|model| model.start(&self.plan)) {
            Ok(_) => Ok(None),
            Err(error) => self.lost(&error).map(Some),
        }
    }

    /// Returns the coordinate without equilibrium from the error that reports it.
    ///
    /// # Errors
    /// Fails if the error has another cause.
    fn lost(&self, error: &SceneError) -> Result<Lost, Holdless> {
        let name = |b: usize| self.scenario.scene.bodies[b].name.clone();
        match (&error.fault, error.part) {
            (SceneFault::NoEquilibrium { body, axis, .. }, _) => Ok(Lost { body: body.clone(), axis: *axis }),
            (SceneFault::Turned { body, .. }, _) => Ok(Lost { body: body.clone(), axis: Axis::Pitch }),
            (SceneFault::Unbalanced { axis, .. }, Part::Body(b)) => Ok(Lost { body: name(b), axis: *axis }),
            _ => Err(self.scenario.refusal(error).into()),
        }
    }

    /// Returns the sum of all friction limits and all other forces along x, N. Returns 1 N if the sum is 0.
    fn scale(&self) -> Result<f64, Holdless> {
        let scene = &self.scenario.scene;
        let refused = |error| self.scenario.refusal(&error);
        let model = Model::new(scene).map_err(refused)?;
        let start = model.start(&self.plan).map_err(refused)?;
        let setup = Setup { scene, model: &model, start: &start };
        let limit = |c| {
            let depth = model.indentations(&start, c)?.start;
            Pressed::of(setup, c, depth).map(|pressed| pressed.limit_force)
        };
        let friction: f64 = (0..scene.contacts.len()).filter_map(limit).sum();
        let scale = friction + pulls(scene);
        Ok(if scale > 0.0 { scale } else { 1.0 })
    }
}

/// Returns the sum of the magnitudes of external forces along x at t = 0, N: loads, spring preloads and weight.
fn pulls(scene: &Scene) -> f64 {
    let at_first = |force: Varying| match force {
        Varying::Constant(force) => force,
        Varying::Follows(w) => scene.waveforms.get(w).map_or(0.0, |named| {
            let waveform = &named.part;
            waveform.sample(&waveform.piece_at(0.0), 0.0).value
        }),
    };
    let loads = scene.loads.iter().map(|load| at_first(load.x).abs());
    let mass: f64 = scene.bodies.iter().filter_map(|body| body.part.mass).sum();
    let preloads = scene.springs.iter().map(|spring| spring.part.preload.abs());
    loads.chain(preloads).sum::<f64>() + (mass * scene.gravity.components().0).abs()
}
