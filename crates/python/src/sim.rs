//! A run that stands between two calls.

use crate::watch::Signals;
use crate::{RunError, text};
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use stickslip_drive::{Interpolation, Shape, Unrecorded};
use stickslip_run::{Held, Job, Port};

/// A held run. Calls from several threads wait for each other.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Sim {
    job: Arc<Job>,
    inputs: Vec<Port>,
    standing: Mutex<Standing>,
}

struct Standing {
    held: Held,
    /// What each input was given last; nothing after a state was restored.
    last: Vec<Option<f64>>,
}

impl Sim {
    pub(crate) fn new(job: &Arc<Job>) -> PyResult<Self> {
        let held =
            Held::new(Arc::clone(job)).map_err(|error| RunError::new_err(text(&error, error.advice())))?;
        Ok(Self::of(job, held))
    }

    fn of(job: &Arc<Job>, held: Held) -> Self {
        let inputs = held.inputs();
        let last = vec![None; inputs.len()];
        Self { job: Arc::clone(job), inputs, standing: Mutex::new(Standing { held, last }) }
    }

    fn standing(&self) -> MutexGuard<'_, Standing> {
        self.standing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn restored(&self, bytes: &[u8]) -> PyResult<Held> {
        Held::from_bytes(Arc::clone(&self.job), bytes)
            .map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// Whether an input is held until its next value, or led there in a straight line.
    fn is_held(&self, place: usize) -> bool {
        let waveform = self.job.scenario.scene.waveforms.get(place);
        let shape = waveform.map(|waveform| waveform.part.shape());
        matches!(shape, Some(Shape::Input { interpolation: Interpolation::Held, .. }))
    }
}

#[pymethods]
impl Sim {
    /// Moves on to a time, s, with inputs by their names; a linear one that is left out stays at its last value.
    fn advance(&self, py: Python<'_>, until: f64, inputs: Vec<(String, f64)>) -> PyResult<()> {
        let mut given = vec![None; self.inputs.len()];
        for (name, value) in inputs {
            let Some(place) = self.inputs.iter().position(|port| port.name == name) else {
                let known: Vec<&str> = self.inputs.iter().map(|port| port.name.as_str()).collect();
                let known =
                    if known.is_empty() { "this scenario has none".to_owned() } else { known.join(", ") };
                return Err(PyValueError::new_err(format!("{name:?} is no input; inputs: {known}")));
            };
            given[place] = Some(value);
        }
        py.detach(|| {
            let mut guard = self.standing();
            let (now, Standing { held, last }) = (guard.held.time(), &mut *guard);
            if until.is_nan() || until < now || until.is_infinite() {
                return Err(PyValueError::new_err(format!(
                    "expected a time from {now} s on, got {until} s: times are absolute"
                )));
            }
            for ((port, given), last) in self.inputs.iter().zip(given).zip(last) {
                let is_held = self.is_held(port.place);
                let fed = match given.or(last.filter(|_| !is_held && until > now)) {
                    None => continue,
                    Some(value) if is_held => held.hold(port.place, value),
                    Some(_) if until == now => {
                        let message = format!(
                            "{:?} is linear: expected a time after {now} s; times are absolute",
                            port.name
                        );
                        return Err(PyValueError::new_err(message));
                    }
                    Some(value) => held.lead(port.place, until, value),
                };
                fed.map_err(|error| {
                    let (place, name) = (format!("input {}", port.place), format!("input {:?}", port.name));
                    PyValueError::new_err(error.to_string().replacen(&place, &name, 1))
                })?;
                *last = given.or(*last);
            }
            let signals = Signals::new();
            let moved = held.advance(until, &mut Unrecorded(&signals));
            signals.take()?;
            moved.map_err(|error| {
                let raised = RunError::new_err(text(&error, error.advice()));
                let t = held.time();
                Python::attach(|py| {
                    // A failure to set an attribute leaves the text.
                    let _ = raised.value(py).setattr("t", t);
                });
                raised
            })
        })
    }

    /// Values of all channels, in their order.
    fn row<'p>(&self, py: Python<'p>) -> Bound<'p, PyArray1<f64>> {
        let row = py.detach(|| self.standing().held.row());
        row.into_pyarray(py)
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> f64 {
        py.detach(|| self.standing().held.time())
    }

    fn state<'p>(&self, py: Python<'p>) -> Bound<'p, PyBytes> {
        let bytes = py.detach(|| self.standing().held.to_bytes());
        PyBytes::new(py, &bytes)
    }

    fn restore(&self, py: Python<'_>, bytes: &[u8]) -> PyResult<()> {
        py.detach(|| {
            let restored = self.restored(bytes)?;
            let last = vec![None; self.inputs.len()];
            *self.standing() = Standing { held: restored, last };
            Ok(())
        })
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        py.detach(|| {
            let (bytes, last) = {
                let standing = self.standing();
                (standing.held.to_bytes(), standing.last.clone())
            };
            let copy = Self::of(&self.job, self.restored(&bytes)?);
            copy.standing().last = last;
            Ok(copy)
        })
    }

    /// Name with unit and unit of every channel.
    fn channels(&self, py: Python<'_>) -> Vec<(String, &'static str)> {
        let channels = py.detach(|| self.standing().held.channels());
        channels.into_iter().map(|channel| (channel.name, channel.unit)).collect()
    }

    /// Name, unit, smallest and largest value of every input.
    fn inputs(&self) -> Vec<(String, &'static str, (f64, f64))> {
        self.inputs.iter().map(|port| (port.name.clone(), port.unit, port.range)).collect()
    }
}
