//! Consecutive runs of models that differ in numbers only, in the same storage.

use super::located::Workspace;
use super::run;
use crate::model::Scaffold;
use crate::record::Record;
use crate::state::Underway;
use crate::{Model, Plan, RunError, Scene, SceneError, State, Stepper};
use thiserror::Error;

/// Storage for consecutive runs, in which model, state and workspace are reused.
///
/// The results are bit-identical to those of [`Model::new`], [`Model::start`] and [`run`](crate::run()) for each [`Scene`] alone.
///
/// Scenarios ([`Scene`]) have the same shape if numbers and bindings of bodies, contacts, links and loads are equal. A run of the same
/// shape allocates no memory with one free coordinate, no block, a given start and the stepper [`Stepper::Event`]. Other runs allocate, for
/// example for eigenvalues, an equilibrium or blocks. A slip memory that is deeper than before allocates, too.
pub struct Variants {
    model: Model,
    state: State,
    scaffold: Scaffold,
    workspace: Workspace,
    row: Vec<f64>,
}

/// Reason why a variant has failed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum VariantError {
    /// The scenario ([`Scene`]) has no valid model, or its run cannot start.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The run has stopped with an error.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl Default for Variants {
    fn default() -> Self {
        Self::new()
    }
}

impl Variants {
    /// Creates empty storage.
    #[must_use]
    pub fn new() -> Self {
        Self {
            model: Model::blank(),
            state: State::blank(),
            scaffold: Scaffold::default(),
            workspace: Workspace::default(),
            row: Vec::new(),
        }
    }

    /// Builds the model of a scenario ([`Scene`]), starts it and runs it to the end of a plan.
    ///
    /// # Errors
    /// The errors of [`Model::new`], [`Model::start`] and [`run`](crate::run()). After an error of the run,
    /// [`Self::state`] is the state in which it stopped.
    pub fn run(&mut self, scene: &Scene, plan: &Plan, record: &mut dyn Record) -> Result<(), VariantError> {
        self.model.rebuild(scene, &mut self.scaffold)?;
        let way = match self.state.underway.take() {
            Some(Underway::Located(way)) => Some(way),
            _ => None,
        };
        self.model.start_in(plan, &mut self.state, &mut self.row)?;
        let (model, state) = (&self.model, &mut self.state);
        match model.effective(plan.stepper) {
            Stepper::Event { tolerance } => {
                self.workspace.run((model, plan, tolerance), state, way, record)?;
            }
            _ => run(model, plan, state, record)?,
        }
        Ok(())
    }

    /// Returns the model of the last variant. If its scenario ([`Scene`]) was invalid, the model has no meaning.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the state in which the last variant ended.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }
}
