//! Runs of scenes that differ in numbers alone, one after the other in one room.

use super::located::Workspace;
use super::run;
use crate::model::Scaffold;
use crate::record::Record;
use crate::state::Underway;
use crate::{Model, Plan, RunError, Scene, SceneError, State, Stepper};
use thiserror::Error;

/// Runs one scene after another: model, state and workspace of each are made in the room of the one before.
///
/// What comes out is what [`Model::new`], [`Model::start`] and [`run`](crate::run()) make of each scene alone, to the last bit.
/// Nothing is allocated for scenes of the shape of an earlier one (as many bodies, contacts, links and loads, bound alike) with
/// one free coordinate, no block and a given start, stepped between located events; elsewhere only the model's eigenvalues, an
/// equilibrium, blocks, or parts that are stepped apart are. Memories deeper than any before take room, too.
pub struct Variants {
    model: Model,
    state: State,
    scaffold: Scaffold,
    workspace: Workspace,
    row: Vec<f64>,
}

/// Why a variant did not come to its end.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum VariantError {
    /// Its scene makes no model, or no start.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The run stopped itself.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl Default for Variants {
    fn default() -> Self {
        Self::new()
    }
}

impl Variants {
    /// Room that has yet to grow.
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

    /// Builds the model of a scene, starts it and moves it to the end of a plan.
    ///
    /// # Errors
    /// What [`Model::new`], [`Model::start`] and [`run`](crate::run()) refuse; of a run that stopped itself the state is that
    /// where it did.
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

    /// The constants of the last variant; after an error in its scene those of none.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The state in which the last variant ended.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }
}
