//! How much a run to its end has of rows and steps.

use crate::{Accuracy, Model, Plan};

/// A row or a step this near to the end of the run, in intervals, is the last one.
const SAME: f64 = 1e-9;

/// Rows of the trace: the grid strictly inside the run, and both its ends.
///
/// A number and no integer: what is asked for may be more than one holds. An early end leaves out the rest.
pub fn rows(plan: &Plan) -> f64 {
    // The first and the last row are written whatever the interval.
    plan.every.map_or(2.0, |every| (plan.duration / every - SAME).ceil().max(1.0) + 1.0)
}

/// Steps of a stepper at fixed step; none of the others.
///
/// The last one may be shorter.
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
