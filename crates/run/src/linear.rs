//! A scenario as a linear system: small motions with all contacts stuck, from its waveforms to its coordinates.

use crate::job::Job;
use serde::Serialize;
use stickslip_drive::Indentations;
use stickslip_quantity::names;
use thiserror::Error;

/// ż = A z + B w, y = C z + D w.
///
/// With M ẍ + C₀ ẋ + K x = P w + Q ẇ the states are z = (x, ẋ - M⁻¹Q w), so that no rate of an input is needed, and the outputs
/// y = (x, ẋ).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StateSpace {
    /// Names of the states, such as `slider.x_m`; the second half are velocities without what the inputs' rates add.
    pub states: Vec<String>,
    /// Names of the inputs: waveforms, or free strokes of stacks behind a driver, with their unit.
    pub inputs: Vec<String>,
    /// Names of the outputs: displacements and velocities as in the trace.
    pub outputs: Vec<String>,
    /// System matrix, row by row.
    pub a: Vec<Vec<f64>>,
    /// Input matrix.
    pub b: Vec<Vec<f64>>,
    /// Output matrix.
    pub c: Vec<Vec<f64>>,
    /// Feedthrough.
    pub d: Vec<Vec<f64>>,
}

/// Why there is no linear system.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LinearError {
    /// Nothing moves freely.
    #[error("{0}: no coordinate is free, so there is nothing to linearise")]
    NothingFree(String),
    /// Coordinates without mass.
    #[error("{0}: it has balanced coordinates, without mass, which have no linear system of this form")]
    Balanced(String),
}

impl StateSpace {
    /// The linear system of a job about its start, with all contacts stuck, each at the indentation (m) that `depth` picks.
    ///
    /// # Errors
    /// A scenario without free coordinates, or with balanced ones.
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
        // What a rate of an input adds to a velocity.
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

/// Name of the channel of a coordinate such as `slider.x`, or of its rate.
fn channel(name: &str, rate: bool) -> String {
    let (body, axis) = name.rsplit_once('.').unwrap_or(("", name));
    let (v, unit) = (if rate { "v" } else { "" }, if axis == "pitch" { "rad" } else { "m" });
    format!("{body}.{v}{axis}_{unit}{}", if rate { "_s" } else { "" })
}
