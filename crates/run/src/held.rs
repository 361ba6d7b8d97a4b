//! A run that owns its job, for callers that store it or move it between threads.

use crate::checkpoint::model_key;
use crate::job::Job;
use self_cell::self_cell;
use std::sync::Arc;
use stickslip_drive::inputs::{Input, inputs};
use stickslip_drive::{
    BytesError, Channel, Command, CommandError, InputError, Plan, Record, Run, RunError, State,
};
use stickslip_quantity::{columns::TRACE, names};
use thiserror::Error;

self_cell!(
    struct Cell {
        owner: Arc<Job>,
        #[not_covariant]
        dependent: Run,
    }
);

/// A [`Run`] with shared ownership of its job. The caller advances the run step by step.
///
/// ```no_run
/// # use std::{path::Path, sync::Arc};
/// # use stickslip_run::{Held, Job};
/// let job = Job::prepare(Path::new("scenarios/p1.json"), &[], Path::new(""))?;
/// let mut run = Held::new(Arc::new(job))?;
/// let x = run.channels().iter().position(|channel| channel.name == "slider.x_m").unwrap();
/// run.advance(1e-3, &mut ())?;
/// println!("{:e} m after {} s", run.row()[x], run.time());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Held {
    cell: Cell,
}

/// Error of creating a run from a stored state.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum HeldError {
    /// The stored state is invalid.
    #[error(transparent)]
    Bytes(#[from] BytesError),
    /// The stored values of the inputs are missing or out of range.
    #[error("the state has no valid values of the inputs")]
    Inputs,
    /// The run cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// A channel of a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quantity {
    /// Name with its SI unit, such as `slider.x_m`.
    pub name: String,
    /// SI unit. Empty for channels without a unit.
    pub unit: &'static str,
    /// Description.
    pub text: &'static str,
}

/// Returns a channel with its unit and description.
pub(crate) fn quantity_of(channel: Channel) -> Quantity {
    Quantity { unit: names::unit(&channel.name), text: TRACE.text(&channel.name), name: channel.name }
}

impl Held {
    /// Creates a run from the initial state of its job.
    ///
    /// # Errors
    /// The same errors as for [`Run::new`].
    pub fn new(job: Arc<Job>) -> Result<Self, RunError> {
        let start = job.start.clone();
        Self::from_state(job, start)
    }

    /// Creates a run from a state, such as a state read by [`State::from_bytes`].
    ///
    /// # Errors
    /// The same errors as for [`Run::new`].
    pub fn from_state(job: Arc<Job>, state: State) -> Result<Self, RunError> {
        let plan = job.scenario.plan;
        Self::planned(job, state, &plan)
    }

    /// Creates a run that computes no rows on its way.
    pub(crate) fn without_rows(job: Arc<Job>, state: State) -> Result<Self, RunError> {
        let plan = Plan { every: None, until_steady: None, ..job.scenario.plan };
        Self::planned(job, state, &plan)
    }

    fn planned(job: Arc<Job>, state: State, plan: &Plan) -> Result<Self, RunError> {
        Cell::try_new(job, |job| Run::new(&job.model, plan, state)).map(|cell| Self { cell })
    }

    /// Returns the job of the run.
    #[must_use]
    pub fn job(&self) -> &Arc<Job> {
        self.cell.borrow_owner()
    }

    /// Calls `ask` with the current state and returns its result.
    pub fn with_state<T>(&self, ask: impl FnOnce(&State) -> T) -> T {
        self.cell.with_dependent(|_, run| ask(run.state()))
    }

    /// Calls `act` with the run and returns its result.
    pub(crate) fn with_run<T>(&mut self, act: impl FnOnce(&mut Run<'_>) -> T) -> T {
        self.cell.with_dependent_mut(|_, run| act(run))
    }

    /// Returns the simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.with_state(State::time)
    }

    /// Returns the state in binary form. Another process can continue the run from these bytes by [`Self::from_bytes`].
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.bytes_with(&model_key(&self.job().scenario))
    }

    /// Returns the state in binary form, with the known key of its motion.
    pub(crate) fn bytes_with(&self, key: &[u8; 32]) -> Vec<u8> {
        let job = self.job();
        self.with_state(|state| state.to_bytes(&job.model, key))
    }

    /// Creates a run from the bytes of [`Self::to_bytes`]. Both scenarios must have the same motion: equal [`model_key`].
    ///
    /// # Errors
    /// The bytes are damaged or belong to a scenario with another motion.
    pub fn from_bytes(job: Arc<Job>, bytes: &[u8]) -> Result<Self, HeldError> {
        let state = State::from_bytes(&job.model, &model_key(&job.scenario), bytes)?;
        Ok(Self::from_state(job, state)?)
    }

    /// Advances the run, see [`Run::advance`].
    ///
    /// # Errors
    /// The same errors as for [`Run::advance`].
    pub fn advance(&mut self, until: f64, record: &mut dyn Record) -> Result<(), RunError> {
        self.cell.with_dependent_mut(|_, run| run.advance(until, record))
    }

    /// Sets an input to a constant value, see [`Run::hold`].
    ///
    /// # Errors
    /// The same errors as for [`Run::hold`].
    pub fn hold(&mut self, input: usize, value: f64) -> Result<(), InputError> {
        self.cell.with_dependent_mut(|_, run| run.hold(input, value))
    }

    /// Lets an input change linearly to a value until a given time, see [`Run::lead`].
    ///
    /// # Errors
    /// The same errors as for [`Run::lead`].
    pub fn lead(&mut self, input: usize, until: f64, value: f64) -> Result<(), InputError> {
        self.cell.with_dependent_mut(|_, run| run.lead(input, until, value))
    }

    /// Commands a generator, see [`Run::command`].
    ///
    /// # Errors
    /// The same errors as for [`Run::command`].
    pub fn command(&mut self, generator: usize, command: Command) -> Result<(), CommandError> {
        self.cell.with_dependent_mut(|_, run| run.command(generator, command))
    }

    /// Returns the current values of all channels.
    #[must_use]
    pub fn row(&self) -> Vec<f64> {
        let mut row = Vec::new();
        self.cell.with_dependent(|_, run| run.row(&mut row));
        row
    }

    /// Returns the channels of a row in order.
    #[must_use]
    pub fn channels(&self) -> Vec<Quantity> {
        self.job().model.channels().into_iter().map(quantity_of).collect()
    }

    /// Returns the inputs: values of waveforms of kind `input`, and commands of generators.
    #[must_use]
    pub fn inputs(&self) -> Vec<Input> {
        inputs(&self.job().scenario.scene)
    }
}
