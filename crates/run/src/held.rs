//! A run that owns its job, for callers that store it or move it between threads.

use crate::checkpoint::model_key;
use crate::job::Job;
use self_cell::self_cell;
use std::sync::Arc;
use stickslip_drive::scene::Named;
use stickslip_drive::{
    BytesError, Channel, Command, CommandError, InputError, Record, Run, RunError, Shape, State, Waveform,
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
    /// The run cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// A waveform that the caller sets or commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Port {
    /// Name of the waveform.
    pub name: String,
    /// Index among the waveforms, the argument of [`Held::hold`], [`Held::lead`] and [`Held::command`].
    pub place: usize,
    /// SI unit of the first quantity that follows the waveform.
    pub unit: &'static str,
    /// Minimum and maximum value, in this unit. For a generator, these are the limits of the stroke.
    pub range: (f64, f64),
    /// Description.
    pub text: String,
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
        Cell::try_new(job, |job| Run::new(&job.model, &job.scenario.plan, state)).map(|cell| Self { cell })
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

    /// Returns the simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.with_state(State::time)
    }

    /// Returns the state in binary form. Another process can continue the run from these bytes by [`Self::from_bytes`].
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let job = self.job();
        self.with_state(|state| state.to_bytes(&job.model, &model_key(&job.scenario)))
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
        let known = |channel: Channel| Quantity {
            unit: names::unit(&channel.name),
            text: TRACE.text(&channel.name),
            name: channel.name,
        };
        self.job().model.channels().into_iter().map(known).collect()
    }

    /// Returns the waveforms of kind `input`, whose values the caller sets.
    #[must_use]
    pub fn inputs(&self) -> Vec<Port> {
        self.ports(|shape| match shape {
            Shape::Input { initial, range, .. } => {
                Some((*range, format!("given by the caller, initially {initial}")))
            }
            _ => None,
        })
    }

    /// Returns the waveforms of kind `generator`, which the caller commands.
    #[must_use]
    pub fn generators(&self) -> Vec<Port> {
        self.ports(|shape| match shape {
            Shape::Generator(generator) => {
                let (low, high) = generator.frequencies;
                Some((generator.strokes, format!("cycles with commanded strokes at {low} to {high} Hz")))
            }
            _ => None,
        })
    }

    fn ports(&self, of: impl Fn(&Shape) -> Option<((f64, f64), String)>) -> Vec<Port> {
        let scene = &self.job().scenario.scene;
        let port = |(place, named): (usize, &Named<Waveform>)| {
            let (range, text) = of(named.part.shape())?;
            Some(Port { name: named.name.clone(), place, unit: scene.waveform_unit(place), range, text })
        };
        scene.waveforms.iter().enumerate().filter_map(port).collect()
    }
}
