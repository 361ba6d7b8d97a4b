//! Inputs of the linearised equations of motion: M ẍ + C ẋ + K x = Σ (pᵥ v + qᵥ v̇) over the signals v.

use super::Indentations;
use crate::model::{Measure, Stroke};
use crate::{Model, State};
use nalgebra::DVector;

/// Signal that acts on the free coordinates of the linearised equations.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearInput {
    /// Index of the signal: waveforms first, then blocks.
    pub signal: usize,
    /// Coefficient p: force on each free coordinate per value of the signal.
    pub stiffness: DVector<f64>,
    /// Coefficient q: force on each free coordinate per rate of the signal.
    pub damping: DVector<f64>,
}

impl Model {
    /// Returns the signals that drive the linearised equations of [`Model::linearised`], with all contacts stuck at the indentation (m)
    /// that `depth` selects.
    ///
    /// These signals are prescribed motions of bodies, strokes of stacks, and loads; signals without effect are omitted. Indices after
    /// waveforms and blocks belong to quasi-static coordinates.
    #[must_use]
    pub fn linear_inputs(&self, state: &State, depth: impl Fn(&Indentations) -> f64) -> Vec<LinearInput> {
        let mut all: Vec<LinearInput> = Vec::new();
        if self.free.is_empty() {
            return all;
        }
        let mut add = |signal: usize, row: &[(usize, f64)], [value, rate]: [f64; 2]| {
            let place = all.iter().position(|input| input.signal == signal).unwrap_or_else(|| {
                let nothing = DVector::zeros(self.free.len());
                all.push(LinearInput { signal, stiffness: nothing.clone(), damping: nothing });
                all.len() - 1
            });
            for (i, share) in row {
                all[place].stiffness[*i] += share * value;
                all[place].damping[*i] += share * rate;
            }
        };
        let mut along = |measure: &Measure, stroke: Option<usize>, [k, c]: [f64; 2]| {
            for (signal, share) in &measure.driven {
                add(*signal, &measure.free, [-share * k, -share * c]);
            }
            stroke.into_iter().for_each(|signal| add(signal, &measure.free, [k, c]));
        };
        for link in &self.links {
            let stroke = if let Stroke::Driven(signal) = link.stroke { Some(signal) } else { None };
            along(&link.elongation, stroke, [link.stiffness, link.damping]);
        }
        for (c, contact) in self.contacts.iter().enumerate() {
            let d = self.indentations(state, c).map_or(0.0, |d| depth(&d));
            if !contact.inert {
                let stiffness = contact.count * contact.interface.stick_stiffness(d);
                along(&contact.u, None, [stiffness, contact.interface.viscosity(stiffness)]);
            }
            if let Some(normal) = contact.coupling() {
                along(normal, None, [contact.count * contact.interface.normal_stiffness(d), 0.0]);
            }
        }
        for load in &self.loads {
            add(load.waveform, &[(load.free, load.arm)], [1.0, 0.0]);
        }
        all.retain(|input| input.stiffness.amax() > 0.0 || input.damping.amax() > 0.0);
        all
    }
}
