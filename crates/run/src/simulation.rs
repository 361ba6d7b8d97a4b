//! A run that another program advances step by step, with values for its inputs.

use crate::checkpoint::model_key;
use crate::held::{Held, HeldError};
use crate::job::Job;
use std::sync::{Arc, OnceLock};
use stickslip_drive::inputs::{Commanded, Feed, Input, Takes, inputs};
use stickslip_drive::{Record, RunError, State};
use thiserror::Error;

/// A run between two communication points, with the last values of its inputs.
pub struct Simulation {
    held: Held,
    inputs: Vec<Input>,
    /// Last value of each input, and for a linear input the time until which it is known, s.
    given: Vec<(f64, Option<f64>)>,
    generators: Vec<Commanded>,
    /// Key of the motion in saved states, which takes longer to compute than a step.
    key: OnceLock<[u8; 32]>,
}

/// Reason why a simulation does not advance.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SimulationError {
    /// A time or the value of an input is not accepted. Nothing has changed.
    #[error("{0}")]
    Refused(String),
    /// The run has stopped.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl Simulation {
    /// Creates a simulation in the initial state of its job.
    ///
    /// # Errors
    /// The integrator cannot be advanced step by step.
    pub fn new(job: Arc<Job>) -> Result<Self, RunError> {
        let inputs = inputs(&job.scenario.scene);
        let given = inputs.iter().map(|input| (input.initial, None)).collect();
        let start = job.start.clone();
        Ok(Self::of(Held::without_rows(job, start)?, inputs, given))
    }

    fn of(held: Held, inputs: Vec<Input>, given: Vec<(f64, Option<f64>)>) -> Self {
        let mut generators = Commanded::all(inputs.iter().map(|input| input.feed));
        for generator in &mut generators {
            inputs.iter().zip(&given).for_each(|(input, given)| generator.hear(input.feed, given.0));
            generator.know();
        }
        Self { held, inputs, given, generators, key: OnceLock::new() }
    }

    fn key(&self) -> &[u8; 32] {
        self.key.get_or_init(|| model_key(&self.held.job().scenario))
    }

    /// Returns the run.
    #[must_use]
    pub fn held(&self) -> &Held {
        &self.held
    }

    /// Returns the inputs.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// Returns the last value of an input; NaN for an unknown input.
    #[must_use]
    pub fn input(&self, index: usize) -> f64 {
        self.given.get(index).map_or(f64::NAN, |(value, _)| *value)
    }

    /// Advances to a time, s, with values for inputs, as pairs of index and value.
    ///
    /// A held input has its value from the current time on, a linear one reaches it at the new time. An input without a value keeps its
    /// last one. A linear input whose last piece already extends to the new time stays as it is.
    ///
    /// # Errors
    /// All values are checked before one is set. After an error of the run, the simulation is at the time reached.
    pub fn advance(
        &mut self,
        until: f64,
        values: &[(usize, f64)],
        record: &mut dyn Record,
    ) -> Result<(), SimulationError> {
        let now = self.held.time();
        if until.is_nan() || until < now || until.is_infinite() {
            let message = format!("expected a time of at least {now} s, got {until} s: times are absolute");
            return Err(SimulationError::Refused(message));
        }
        for (index, value) in values {
            self.check(*index, *value, (now, until)).map_err(SimulationError::Refused)?;
        }
        for (index, value) in values {
            self.set(*index, *value, (now, until))?;
        }
        for index in 0..self.inputs.len() {
            // Without a piece up to the new time the run could not advance.
            let (value, end) = self.given[index];
            if self.inputs[index].is_led() && end.is_some_and(|end| end < until) {
                self.set(index, value, (now, until))?;
            }
        }
        for generator in &mut self.generators {
            let command = self.held.with_run(|run| generator.command(run));
            command.map_err(|error| SimulationError::Refused(error.to_string()))?;
        }
        Ok(self.held.advance(until, record)?)
    }

    /// Checks a value; the error is the message.
    fn check(&self, index: usize, value: f64, (now, until): (f64, f64)) -> Result<(), String> {
        let Some(Input { name, takes, unit, feed, .. }) = self.inputs.get(index) else {
            return Err(format!("there is no input {index}"));
        };
        if !takes.has(value) {
            let allowed = match takes {
                Takes::Range(low, high) => format!("a value from {low} to {high} {unit}"),
                other => other.to_string(),
            };
            return Err(format!("{name:?}: expected {}, got {value}", allowed.trim_end()));
        }
        match (feed, self.given[index]) {
            (Feed::Lead(_), _) if until == now => {
                Err(format!("{name:?} is linear: expected a time after {now} s; times are absolute"))
            }
            (Feed::Lead(_), (known, Some(end))) if end >= until && known != value => {
                Err(format!("{name:?} already has the value {known} until {end} s"))
            }
            _ => Ok(()),
        }
    }

    fn set(&mut self, index: usize, value: f64, (now, until): (f64, f64)) -> Result<(), SimulationError> {
        let (feed, end) = (self.inputs[index].feed, self.given[index].1);
        let fed = match feed {
            Feed::Hold(place) => self.held.hold(place, value),
            Feed::Lead(place) if until > now && end.is_none_or(|end| end < until) => {
                self.held.lead(place, until, value)
            }
            Feed::Lead(_) => return Ok(()),
            Feed::Command(..) | Feed::Note => Ok(()),
        };
        fed.map_err(|error| SimulationError::Refused(format!("{:?}: {error}", self.inputs[index].name)))?;
        self.generators.iter_mut().for_each(|generator| generator.hear(feed, value));
        self.given[index] = (value, Some(until).filter(|_| matches!(feed, Feed::Lead(_))));
        Ok(())
    }

    /// Returns the state in binary form, with the last values of the inputs.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.held.bytes_with(self.key());
        for (value, end) in &self.given {
            let pair = [*value, end.unwrap_or(f64::NAN)];
            bytes.extend(pair.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes
    }

    /// Creates a simulation from the bytes of [`Self::to_bytes`], also in another process.
    ///
    /// # Errors
    /// The bytes are damaged, or belong to a scenario with another motion.
    pub fn from_bytes(job: Arc<Job>, bytes: &[u8]) -> Result<Self, HeldError> {
        let key = model_key(&job.scenario);
        Self::keyed(job, key, bytes)
    }

    /// Creates a simulation of the same job from bytes, faster than [`Self::from_bytes`].
    ///
    /// # Errors
    /// As for [`Self::from_bytes`].
    pub fn restored(&self, bytes: &[u8]) -> Result<Self, HeldError> {
        Self::keyed(Arc::clone(self.held.job()), *self.key(), bytes)
    }

    fn keyed(job: Arc<Job>, key: [u8; 32], bytes: &[u8]) -> Result<Self, HeldError> {
        let inputs = inputs(&job.scenario.scene);
        let (state, behind) = bytes.split_at(bytes.len().saturating_sub(16 * inputs.len()));
        let state = State::from_bytes(&job.model, &key, state)?;
        let held = Held::without_rows(job, state)?;
        let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
        let pairs = behind.chunks(16).map(|pair| {
            let (value, end) = pair.split_at(pair.len().min(8));
            (number(value), Some(number(end)).filter(|end| end.is_finite()))
        });
        let given: Vec<_> = pairs.collect();
        let fits = |(input, given): (&Input, &(f64, _))| input.takes.has(given.0);
        if given.len() != inputs.len() || !inputs.iter().zip(&given).all(fits) {
            return Err(HeldError::Inputs);
        }
        Ok(Self { key: key.into(), ..Self::of(held, inputs, given) })
    }
}
