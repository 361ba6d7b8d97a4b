//! Linear state-space model of a scenario with all contacts in full stick.

use crate::job::Job;
use serde::Serialize;
use stickslip_drive::Indentations;
use stickslip_quantity::names;
use thiserror::Error;

/// State-space model ż = A z + B w, y = C z + D w.
///
/// The equations of motion are M ẍ + C₀ ẋ + K x = P w + Q ẇ. With the states z = (x, ẋ - M⁻¹Q w), the input rates ẇ do not occur in the
/// model. The outputs are y = (x, ẋ).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StateSpace {
    /// Names of the states, such as `slider.x_m`. The second half of the states are velocities minus M⁻¹Q w.
    pub states: Vec<String>,
    /// Names of the inputs with units: waveforms, or free strokes of stacks with a driver.
    pub inputs: Vec<String>,
    /// Names of the outputs: displacements and velocities as in the trace.
    pub outputs: Vec<String>,
    /// System matrix A, row by row.
    pub a: Vec<Vec<f64>>,
    /// Input matrix B.
    pub b: Vec<Vec<f64>>,
    /// Output matrix C.
    pub c: Vec<Vec<f64>>,
    /// Feedthrough matrix D.
    pub d: Vec<Vec<f64>>,
}

/// Error: a scenario has no linear model.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LinearError {
    /// No coordinate is free.
    #[error("{0}: no coordinate is free, so there is no linear system")]
    NothingFree(String),
    /// Some coordinates have no mass.
    #[error("{0}: balanced coordinates have no mass, so there is no linear system of this form")]
    Balanced(String),
}

impl StateSpace {
    /// Returns the linear model of a job about its initial state, with all contacts in full stick.
    ///
    /// `depth` selects the indentation of each contact, m.
    ///
    /// # Errors
    /// No coordinate is free, or some coordinates are balanced.
    pub fn of(job: &Job, depth: impl Fn(&Indentations) -> f64 + Copy) -> Result<Self, LinearError> {
        let (scene, model) = (&job.scenario.scene, &job.model);
        let motions = model.linearised(&job.start, depth);
        let (n, mass) = (motions.coordinates().len(), motions.mass());
        if n == 0 {
            return Err(LinearError::NothingFree(job.name.clone()));
        }
        let driving = model.linear_inputs(&job.start, depth);
        let signals = scene.waveforms.len() + scene.blocks.len();
        if driving.iter().any(|input| input.signal >= signals) {
            return Err(LinearError::Balanced(job.name.clone()));
        }
        let name = |signal: usize| match signal.checked_sub(scene.waveforms.len()) {
            None => names::with_unit(&scene.waveforms[signal].name, scene.waveform_unit(signal)),
            Some(block) => names::with_unit(&scene.blocks[block].name, "m"),
        };
        let coordinates = motions.coordinates().iter();
        let outputs: Vec<String> = coordinates
            .clone()
            .map(|x| channel(x, false))
            .chain(coordinates.map(|x| channel(x, true)))
            .collect();
        let over = |matrix: &dyn Fn(usize, usize) -> f64, i: usize, j: usize| -matrix(i, j) / mass[i];
        let (stiffness, damping) = (motions.stiffness(), motions.damping());
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let square = |of: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
            (0..2 * n).map(|i| (0..2 * n).map(|j| of(i, j)).collect()).collect()
        };
        let a = square(&|i, j| match (i < n, j < n) {
            (true, _) => unit(i + n, j),
            (false, true) => over(&|i, j| stiffness[(i, j)], i - n, j),
            (false, false) => over(&|i, j| damping[(i, j)], i - n, j - n),
        });
        // Element (i, w) of M⁻¹Q: contribution of an input rate to an acceleration.
        let kick = |i: usize, w: usize| driving[w].damping[i] / mass[i];
        let inputs = 0..driving.len();
        let b = (0..2 * n).map(|i| {
            let value = |w: usize| match i.checked_sub(n) {
                None => kick(i, w),
                Some(i) => {
                    let damped: f64 = (0..n).map(|j| damping[(i, j)] * kick(j, w)).sum();
                    (driving[w].stiffness[i] - damped) / mass[i]
                }
            };
            inputs.clone().map(value).collect()
        });
        let d = (0..2 * n).map(|i| {
            let value = |w: usize| i.checked_sub(n).map_or(0.0, |i| kick(i, w));
            inputs.clone().map(value).collect()
        });
        Ok(Self {
            states: outputs.clone(),
            inputs: driving.iter().map(|input| name(input.signal)).collect(),
            outputs,
            a,
            b: b.collect(),
            c: square(&unit),
            d: d.collect(),
        })
    }
}

/// Returns the channel name of a coordinate such as `slider.x`, or of its velocity.
fn channel(name: &str, rate: bool) -> String {
    let (body, axis) = name.rsplit_once('.').unwrap_or(("", name));
    let (v, unit) = (if rate { "v" } else { "" }, if axis == "pitch" { "rad" } else { "m" });
    format!("{body}.{v}{axis}_{unit}{}", if rate { "_s" } else { "" })
}
