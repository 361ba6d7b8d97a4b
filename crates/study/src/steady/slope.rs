//! By how much the step of a steady motion changes with numbers of the scenario.
//!
//! The fixed point moves with a number q as P(s, q) = s says, (1 - A) ds/dq = ∂P/∂q with the gradient A = ∂P/∂s, and the way w of a
//! period by dw/dq = ∂w/∂q + ∂w/∂s ds/dq. One variation of one period tells A, ∂P/∂q and both slopes of the way.

use super::newton::solve;
use super::{Endless, Steady};
use crate::interruptible::Interruptible;
use nalgebra::{DMatrix, DVector};
use stickslip_drive::scene::Axis;
use stickslip_drive::section::{Gradient, Section};
use stickslip_drive::{Limits, Model, Parameter, Plan, Run, Stepper, VariationError};
use stickslip_run::Job;

impl Steady {
    /// A number of the scenario by which the motion changes, told by jobs at -2, -1, 1 and 2 distances from its value; none where
    /// one of them has no such motion, or another period.
    pub(crate) fn parameter(&self, beside: [&Job; 4], distance: f64) -> Option<Parameter> {
        let model = |job: &Job| -> Option<Model> {
            let drive = Endless::of(job).ok()?;
            (drive.period == self.period && drive.begins == self.begins).then_some(drive.model)
        };
        let [a, b, c, d] = beside.map(model);
        Parameter::new(&self.model, [a?, b?, c?, d?], distance).ok()
    }

    /// By how much the step of a body changes with each of some numbers, m per unit of their distances. Whole families of motions,
    /// and such as depend on memories that are carried along, have no slopes: none then, and where the body makes no steps. The equations
    /// go in halves of the run's steps where these are asked for.
    ///
    /// # Errors
    ///
    /// What on the way has no derivative.
    pub(crate) fn step_slopes(
        &self,
        job: &Job,
        (parameters, is_halved): (&[Parameter], bool),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<Vec<f64>>, VariationError> {
        let Some(body) = job.scenario.figures.body else { return Ok(None) };
        if !self.carried.is_empty() || !self.shaken_down.is_empty() {
            return Ok(None);
        }
        let section = Section::new(&self.model, self.state.clone());
        let state = section.base().clone();
        let mut variation = section.variation((&state, parameters), self.tolerance)?;
        if is_halved {
            variation = variation.in_halves();
        }
        let limits = Limits { wall: None, ..job.scenario.plan.limits };
        let stepper = Stepper::Event { tolerance: self.tolerance };
        let plan = Plan { duration: f64::MAX, stepper, limits, every: None, until_steady: None };
        let Ok(mut run) = Run::new(&self.model, &plan, state.clone()) else { return Ok(None) };
        let mut record = Interruptible { record: &mut variation, goes_on };
        if run.advance(state.time() + self.period, &mut record).is_err() {
            return Ok(None);
        }
        run.stop(&mut ());
        variation.finish(run.state())?;
        let (image, _) = section.back(run.into_state());
        let found = section.difference(&image, &state).and_then(|_| section.gradient(&variation, &image));
        let of_body = |way: &[f64]| section.of_body(way, body, Axis::X);
        Ok(found.and_then(|gradient| slopes(&gradient, section.unknowns().len(), of_body)))
    }
}

/// dw/dq of each number of the scene, which come after those of the state.
fn slopes(gradient: &Gradient, count: usize, of_body: impl Fn(&[f64]) -> Option<f64>) -> Option<Vec<f64>> {
    let all = gradient.way.first()?.len();
    let way = |j: usize| of_body(&gradient.way.iter().map(|row| row[j]).collect::<Vec<_>>());
    let along = (0..all).map(way).collect::<Option<Vec<_>>>()?;
    let left = DMatrix::from_fn(count, count, |i, j| f64::from(u8::from(i == j)) - gradient.numbers[i][j]);
    let slope = |j: usize| {
        let moved = DVector::from_fn(count, |i, _| gradient.numbers[i][j]);
        let off = if count == 0 { moved } else { solve(left.clone(), &moved)? };
        Some(along[j] + off.iter().zip(&along).map(|(off, along)| off * along).sum::<f64>())
    };
    (count..all).map(slope).collect()
}
