//! A run that owns its job: for callers who hold it for long and hand it from thread to thread.

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

/// A run that stands between two calls at any time its caller wants: [`Run`] with the job that it is of.
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

/// Why a run does not go on from bytes.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum HeldError {
    /// The bytes.
    #[error(transparent)]
    Bytes(#[from] BytesError),
    /// The run.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// A waveform that the caller feeds or commands.
#[derive(Debug, Clone, PartialEq)]
pub struct Port {
    /// Name of the waveform.
    pub name: String,
    /// Its place among the waveforms: what [`Held::hold`], [`Held::lead`] and [`Held::command`] ask for.
    pub place: usize,
    /// SI unit of what follows it first.
    pub unit: &'static str,
    /// Least and largest value that it takes, in that unit; of a generator those of the stroke.
    pub range: (f64, f64),
    /// What it is, in a sentence.
    pub text: String,
}

/// A channel of a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quantity {
    /// Name with its SI unit, such as `slider.x_m`.
    pub name: String,
    /// Its SI unit; empty where it has none.
    pub unit: &'static str,
    /// What it is, in a sentence.
    pub text: &'static str,
}

impl Held {
    /// A run from the start of its job.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn new(job: Arc<Job>) -> Result<Self, RunError> {
        let start = job.start.clone();
        Self::from_state(job, start)
    }

    /// A run that goes on from a state, such as one of [`State::from_bytes`].
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn from_state(job: Arc<Job>, state: State) -> Result<Self, RunError> {
        Cell::try_new(job, |job| Run::new(&job.model, &job.scenario.plan, state)).map(|cell| Self { cell })
    }

    /// What it is of.
    #[must_use]
    pub fn job(&self) -> &Arc<Job> {
        self.cell.borrow_owner()
    }

    /// Where it stands, and all that its future depends on.
    pub fn with_state<T>(&self, ask: impl FnOnce(&State) -> T) -> T {
        self.cell.with_dependent(|_, run| ask(run.state()))
    }

    /// When it stands, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.with_state(State::time)
    }

    /// Its state, as bytes from which another process goes on by [`Self::from_bytes`].
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let job = self.job();
        self.with_state(|state| state.to_bytes(&job.model, &model_key(&job.scenario)))
    }

    /// A run that goes on from bytes that one of the same motion has put down.
    ///
    /// # Errors
    /// Bytes of another motion, or damaged ones.
    pub fn from_bytes(job: Arc<Job>, bytes: &[u8]) -> Result<Self, HeldError> {
        let state = State::from_bytes(&job.model, &model_key(&job.scenario), bytes)?;
        Ok(Self::from_state(job, state)?)
    }

    /// [`Run::advance`].
    ///
    /// # Errors
    /// As there.
    pub fn advance(&mut self, until: f64, record: &mut dyn Record) -> Result<(), RunError> {
        self.cell.with_dependent_mut(|_, run| run.advance(until, record))
    }

    /// [`Run::hold`].
    ///
    /// # Errors
    /// As there.
    pub fn hold(&mut self, input: usize, value: f64) -> Result<(), InputError> {
        self.cell.with_dependent_mut(|_, run| run.hold(input, value))
    }

    /// [`Run::lead`].
    ///
    /// # Errors
    /// As there.
    pub fn lead(&mut self, input: usize, until: f64, value: f64) -> Result<(), InputError> {
        self.cell.with_dependent_mut(|_, run| run.lead(input, until, value))
    }

    /// [`Run::command`].
    ///
    /// # Errors
    /// As there.
    pub fn command(&mut self, generator: usize, command: Command) -> Result<(), CommandError> {
        self.cell.with_dependent_mut(|_, run| run.command(generator, command))
    }

    /// Values of all channels where it stands.
    #[must_use]
    pub fn row(&self) -> Vec<f64> {
        let mut row = Vec::new();
        self.cell.with_dependent(|_, run| run.row(&mut row));
        row
    }

    /// The channels of a row, in order.
    #[must_use]
    pub fn channels(&self) -> Vec<Quantity> {
        let known = |channel: Channel| Quantity {
            unit: names::unit(&channel.name),
            text: TRACE.text(&channel.name),
            name: channel.name,
        };
        self.job().model.channels().into_iter().map(known).collect()
    }

    /// Waveforms that the caller feeds: kind `input`.
    #[must_use]
    pub fn inputs(&self) -> Vec<Port> {
        self.ports(|shape| match shape {
            Shape::Input { initial, range, .. } => {
                Some((*range, format!("given by the caller, {initial} until then")))
            }
            _ => None,
        })
    }

    /// Waveforms that the caller commands: kind `generator`.
    #[must_use]
    pub fn generators(&self) -> Vec<Port> {
        self.ports(|shape| match shape {
            Shape::Generator(generator) => {
                let (low, high) = generator.frequencies;
                Some((generator.strokes, format!("cycles of commanded strokes at {low} to {high} Hz")))
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
