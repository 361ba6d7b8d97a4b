//! Simulation that is advanced step by step.

use crate::watch::{Signals, is_main, lock};
use crate::{RunError, text};
use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::{Arc, Mutex, MutexGuard};
use stickslip_drive::{Interpolation, Shape, Unrecorded};
use stickslip_run::{Held, Job, Port};

/// Simulation between two calls of `advance`. Calls from several threads are serialised.
#[pyclass(frozen, module = "stickslip._core")]
pub(crate) struct Sim {
    job: Arc<Job>,
    inputs: Vec<Port>,
    standing: Mutex<Standing>,
}

struct Standing {
    held: Held,
    /// Last value of each input and its end time, s.
    last: Vec<Option<(f64, f64)>>,
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

    fn standing(&self) -> PyResult<MutexGuard<'_, Standing>> {
        lock(&self.standing)
    }

    /// State as bytes, followed by the last values of the inputs.
    fn bytes(standing: &Standing) -> Vec<u8> {
        let mut bytes = standing.held.to_bytes();
        for last in &standing.last {
            let (value, until) = last.unwrap_or((f64::NAN, f64::NAN));
            bytes.extend(value.to_le_bytes().into_iter().chain(until.to_le_bytes()));
        }
        bytes
    }

    fn restored(&self, bytes: &[u8]) -> PyResult<Standing> {
        let (state, behind) = bytes.split_at(bytes.len().saturating_sub(16 * self.inputs.len()));
        let held = Held::from_bytes(Arc::clone(&self.job), state)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
        let last = behind.chunks(16).map(|pair| {
            let (value, until) = pair.split_at(pair.len().min(8));
            Some((number(value), number(until)))
                .filter(|(value, until)| value.is_finite() && until.is_finite())
        });
        let mut last: Vec<_> = last.collect();
        last.resize(self.inputs.len(), None);
        Ok(Standing { held, last })
    }

    /// Checks a value for an input; the error is the message.
    fn check(
        &self,
        port: &Port,
        given: Option<f64>,
        last: Option<(f64, f64)>,
        (now, until): (f64, f64),
    ) -> Result<(), String> {
        let Some(value) = given else { return Ok(()) };
        let (name, (low, high)) = (&port.name, port.range);
        if !(low..=high).contains(&value) {
            return Err(format!(
                "{name:?}: expected a value from {low} to {high} {}, got {value}",
                port.unit
            ));
        }
        if self.is_held(port.place) {
            return Ok(());
        }
        match last {
            _ if until == now => {
                Err(format!("{name:?} is linear: expected a time after {now} s; times are absolute"))
            }
            Some((known, end)) if end >= until && known != value => {
                Err(format!("{name:?} already has the value {known} until {end} s"))
            }
            _ => Ok(()),
        }
    }

    /// Whether an input is held until its next value instead of interpolated linearly.
    fn is_held(&self, place: usize) -> bool {
        let waveform = self.job.scenario.scene.waveforms.get(place);
        let shape = waveform.map(|waveform| waveform.part.shape());
        matches!(shape, Some(Shape::Input { interpolation: Interpolation::Held, .. }))
    }
}

#[pymethods]
impl Sim {
    /// Advances to a time in s, with values of inputs by name. A linear input without a value keeps its last value.
    fn advance(&self, py: Python<'_>, until: f64, inputs: Vec<(String, f64)>) -> PyResult<()> {
        let mut given = vec![None; self.inputs.len()];
        for (name, value) in inputs {
            let Some(place) = self.inputs.iter().position(|port| port.name == name) else {
                let known: Vec<&str> = self.inputs.iter().map(|port| port.name.as_str()).collect();
                let known =
                    if known.is_empty() { "this scenario has none".to_owned() } else { known.join(", ") };
                return Err(PyValueError::new_err(format!("{name:?} is not an input; inputs: {known}")));
            };
            given[place] = Some(value);
        }
        let is_main = is_main(py)?;
        py.detach(|| {
            let mut guard = self.standing()?;
            let (now, Standing { held, last }) = (guard.held.time(), &mut *guard);
            if until.is_nan() || until < now || until.is_infinite() {
                let message =
                    format!("expected a time of at least {now} s, got {until} s: times are absolute");
                return Err(PyValueError::new_err(message));
            }
            // All values are checked before any is set.
            for ((port, given), last) in self.inputs.iter().zip(&given).zip(&*last) {
                self.check(port, *given, *last, (now, until)).map_err(PyValueError::new_err)?;
            }
            for ((port, given), last) in self.inputs.iter().zip(given).zip(last) {
                let is_held = self.is_held(port.place);
                // A linear input without a value keeps its last one. If its piece already extends to the new time, it
                // stays unchanged.
                let open = !is_held && until > now && last.is_none_or(|(_, end)| end < until);
                let value = if is_held || open { given } else { None };
                let fed = match value.or(last.map(|(value, _)| value).filter(|_| open)) {
                    None => continue,
                    Some(value) if is_held => held.hold(port.place, value).map(|()| value),
                    Some(value) => held.lead(port.place, until, value).map(|()| value),
                };
                let value =
                    fed.map_err(|error| PyValueError::new_err(format!("{:?}: {error}", port.name)))?;
                *last = Some((value, until));
            }
            let signals = Signals::new(is_main);
            let moved = held.advance(until, &mut Unrecorded(&signals));
            signals.take()?;
            moved.map_err(|error| {
                let raised = RunError::new_err(text(&error, error.advice()));
                let t = held.time();
                Python::attach(|py| {
                    // If the attribute cannot be set, the message remains.
                    let _ = raised.value(py).setattr("t", t);
                });
                raised
            })
        })
    }

    /// Returns the values of all channels in their order.
    fn row<'p>(&self, py: Python<'p>) -> PyResult<Bound<'p, PyArray1<f64>>> {
        Ok(py.detach(|| self.standing().map(|standing| standing.held.row()))?.into_pyarray(py))
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        py.detach(|| Ok(self.standing()?.held.time()))
    }

    fn state<'p>(&self, py: Python<'p>) -> PyResult<Bound<'p, PyBytes>> {
        let bytes = py.detach(|| self.standing().map(|standing| Self::bytes(&standing)))?;
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
            let bytes = Self::bytes(&*self.standing()?);
            let Standing { held, last } = self.restored(&bytes)?;
            let copy = Self::of(&self.job, held);
            copy.standing()?.last = last;
            Ok(copy)
        })
    }

    /// Returns name with unit and unit of each channel.
    fn channels(&self, py: Python<'_>) -> PyResult<Vec<(String, &'static str)>> {
        let channels = py.detach(|| self.standing().map(|standing| standing.held.channels()))?;
        Ok(channels.into_iter().map(|channel| (channel.name, channel.unit)).collect())
    }

    /// Returns name, unit and range of each input.
    fn inputs(&self) -> Vec<(String, &'static str, (f64, f64))> {
        self.inputs.iter().map(|port| (port.name.clone(), port.unit, port.range)).collect()
    }
}
