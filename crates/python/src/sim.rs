//! Simulation that is advanced step by step.

use crate::watch::{Signals, is_main, lock};
use crate::{RunError, text};
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Arc, Mutex, MutexGuard};
use stickslip_drive::Unrecorded;
use stickslip_drive::inputs::Input;
use stickslip_run::{Job, Simulation, SimulationError};

/// Simulation between two calls of `advance`. Calls from several threads are serialised.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Sim {
    job: Arc<Job>,
    inputs: Vec<Input>,
    standing: Mutex<Simulation>,
}

impl Sim {
    pub(crate) fn new(job: &Arc<Job>) -> PyResult<Self> {
        let simulation = Simulation::new(Arc::clone(job))
            .map_err(|error| RunError::new_err(text(&error, error.advice())))?;
        Ok(Self::of(job, simulation))
    }

    fn of(job: &Arc<Job>, simulation: Simulation) -> Self {
        let inputs = simulation.inputs().to_vec();
        Self { job: Arc::clone(job), inputs, standing: Mutex::new(simulation) }
    }

    fn standing(&self) -> PyResult<MutexGuard<'_, Simulation>> {
        lock(&self.standing)
    }

    fn restored(&self, bytes: &[u8]) -> PyResult<Simulation> {
        Simulation::from_bytes(Arc::clone(&self.job), bytes)
            .map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

#[pymethods]
impl Sim {
    /// Advances to a time in s, with values of inputs by name. A linear input without a value keeps its last value.
    fn advance(&self, py: Python<'_>, until: f64, inputs: Vec<(String, f64)>) -> PyResult<()> {
        let mut given = Vec::with_capacity(inputs.len());
        for (name, value) in inputs {
            let Some(place) = self.inputs.iter().position(|input| input.name == name) else {
                let known: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
                let known =
                    if known.is_empty() { "this scenario has none".to_owned() } else { known.join(", ") };
                return Err(PyValueError::new_err(format!("{name:?} is not an input; inputs: {known}")));
            };
            given.push((place, value));
        }
        let is_main = is_main(py)?;
        py.detach(|| {
            let mut simulation = self.standing()?;
            let signals = Signals::new(is_main);
            let moved = simulation.advance(until, &given, &mut Unrecorded(&signals));
            signals.take()?;
            moved.map_err(|error| match error {
                SimulationError::Refused(message) => PyValueError::new_err(message),
                SimulationError::Run(error) => {
                    let raised = RunError::new_err(text(&error, error.advice()));
                    let t = simulation.held().time();
                    Python::attach(|py| {
                        // If the attribute cannot be set, the message remains.
                        let _ = raised.value(py).setattr("t", t);
                    });
                    raised
                }
            })
        })
    }

    /// Returns the values of all channels in their order.
    fn row<'p>(&self, py: Python<'p>) -> PyResult<Bound<'p, PyArray1<f64>>> {
        Ok(py.detach(|| self.standing().map(|simulation| simulation.held().row()))?.into_pyarray(py))
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        py.detach(|| Ok(self.standing()?.held().time()))
    }

    fn state<'p>(&self, py: Python<'p>) -> PyResult<Bound<'p, PyBytes>> {
        let bytes = py.detach(|| self.standing().map(|simulation| simulation.to_bytes()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    fn restore(&self, py: Python<'_>, bytes: &[u8]) -> PyResult<()> {
        py.detach(|| {
            let restored = self.restored(bytes)?;
            *self.standing()? = restored;
            Ok(())
        })
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        py.detach(|| {
            let bytes = self.standing()?.to_bytes();
            Ok(Self::of(&self.job, self.restored(&bytes)?))
        })
    }

    /// Returns name with unit and unit of each channel.
    fn channels(&self, py: Python<'_>) -> PyResult<Vec<(String, &'static str)>> {
        let channels = py.detach(|| self.standing().map(|simulation| simulation.held().channels()))?;
        Ok(channels.into_iter().map(|channel| (channel.name, channel.unit)).collect())
    }

    /// Returns name, unit and range of each input.
    fn inputs(&self) -> Vec<(String, &'static str, (f64, f64))> {
        self.inputs.iter().map(|input| (input.name.clone(), input.unit, input.takes.bounds())).collect()
    }
}
