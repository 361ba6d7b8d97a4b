//! Number of rows and steps of a run.

use crate::{Accuracy, Model, Plan};

/// Distance at which a row or step counts as the end of the run, in row intervals or steps.
const SAME: f64 = 1e-9;

/// Returns the number of rows of the trace: grid points inside the run and both ends.
///
/// The number is an `f64` because it may exceed any integer type. Runs that end early have fewer rows.
pub fn rows(plan: &Plan) -> f64 {
    // The first and the last row exist for any interval.
    plan.every.map_or(2.0, |every| (plan.duration / every - SAME).ceil().max(1.0) + 1.0)
}

/// Returns the number of steps of a fixed-step stepper, of which the last may be shorter; `None` for other steppers.
pub fn fixed_steps(model: &Model, plan: &Plan) -> Option<f64> {
    match model.effective(plan.stepper).accuracy() {
        Accuracy::Step(step) => Some((plan.duration / step - SAME).ceil()),
        Accuracy::Frame { length, error } => {
            let step = length / model.substeps(length, error);
            Some((plan.duration / step - SAME).ceil())
        }
        Accuracy::Tolerance(_) => None,
    }
}
