//! What a drive at rest holds along one way.

use crate::curve::Bracket;
use stickslip_drive::facts::{Pressed, Setup};
use stickslip_drive::scene::{Axis, Load, Scene, Start, Varying};
use stickslip_drive::{Model, Part, Plan, SceneError, SceneFault, Stepper, WALK_TOLERANCE};
use stickslip_run::Watcher;
use stickslip_scenario::{Scenario, ScenarioError};
use thiserror::Error;

/// A load that is held though it is so many times all friction and all other forces: something else holds it.
const ENDLESS: f64 = 64.0;
/// How far a balance is known, as a share of all friction and all other forces: what is left on a coordinate may be 1e-9 of what acts on it.
const RESOLVED: f64 = 4e-9;
/// A drive that does not hold this share of them holds nothing.
const NOTHING: f64 = 1e-12;

/// A holding force.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// The largest load that is held, N.
    pub force: f64,
    /// How far it may be off, N: half of the bracket, and how far a balance is known.
    pub half_width: f64,
    /// What gives way beyond.
    pub lost: Lost,
    /// Equilibria that were looked for.
    pub runs: u32,
}

/// A coordinate that nothing holds in balance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lost {
    /// Name of the body.
    pub body: String,
    /// Which coordinate.
    pub axis: Axis,
}

impl Lost {
    /// What its body does.
    #[must_use]
    pub fn words(&self) -> String {
        let does = match self.axis {
            Axis::X => "slides away",
            Axis::Z => "comes loose",
            // All that slides lifts or presses as well: which came first is not told apart.
            Axis::Pitch => "slides or tips over",
        };
        format!("{} {does}", self.body)
    }
}

/// Why no holding force is told.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Holdless {
    /// Nobody computed it.
    #[error("not run")]
    NotRun,
    /// The value makes no scenario, or none whose equilibrium can be looked for.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// It does not even hold what acts without the load.
    #[error("without a load {} already", .0.words())]
    Without(Lost),
    /// Something other than friction holds it.
    #[error(
        "no finite holding force: {load:.3e} N are held, {ENDLESS} times all friction and other forces; something else holds them, \
         as a spring does"
    )]
    Endless {
        /// A load that is held, N.
        load: f64,
    },
}

impl Holdless {
    /// The kind of reason, in a word or two.
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

/// A drive at rest.
pub(super) struct Still {
    scenario: Scenario,
    plan: Plan,
    body: usize,
}

impl Still {
    /// Of a scenario, one of whose bodies is to be loaded.
    pub(super) fn new(mut scenario: Scenario, body: usize) -> Self {
        scenario.scene.start = Start::Equilibrium;
        // Nothing is stepped: a step that would be too long for a run is none of its business.
        let plan = Plan { stepper: Stepper::Event { tolerance: WALK_TOLERANCE }, ..scenario.plan };
        Self { scenario, plan, body }
    }

    /// The largest load along a sense of x, 1 or -1, that has an equilibrium, to a share of its size.
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
        // From about where friction ends, so that the bracket is never wider than its size.
        let mut still = 2.0 * scale;
        while try_at(still)?.is_some() {
            still *= 2.0;
        }
        let mut holds = 0.5 * still;
        while holds > NOTHING * scale && try_at(holds)?.is_none() {
            (still, holds) = (holds, 0.5 * holds);
        }
        // Room within the tolerance for how far a balance is known.
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

    /// What gives way under a load; none where it is held.
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

    /// What an error says gives way, unless it says something else.
    fn lost(&self, error: &SceneError) -> Result<Lost, Holdless> {
        let name = |b: usize| self.scenario.scene.bodies[b].name.clone();
        match (&error.fault, error.part) {
            (SceneFault::NoEquilibrium { body, axis, .. }, _) => Ok(Lost { body: body.clone(), axis: *axis }),
            (SceneFault::Turned { body, .. }, _) => Ok(Lost { body: body.clone(), axis: Axis::Pitch }),
            (SceneFault::Unbalanced { axis, .. }, Part::Body(b)) => Ok(Lost { body: name(b), axis: *axis }),
            _ => Err(self.scenario.refusal(error).into()),
        }
    }

    /// All friction, with all other forces along x, N: more than that friction does not hold. 1 N where there is none of either.
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

/// Forces along x that act at t = 0 whatever gives way, by their size, N.
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
