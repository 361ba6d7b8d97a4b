//! How time is stepped, and what fixed steps could be.

use serde::Serialize;
use stickslip_drive::Stepper;
use stickslip_results::{Job, Real};

/// How time is stepped, and what fixed steps could be.
#[derive(Debug, Serialize)]
pub(super) struct Stepping {
    pub(super) stepper: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tolerance: Option<Real>,
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    pub(super) step: Option<Real>,
    #[serde(rename = "duration_s")]
    pub(super) duration: Real,
    /// Largest change of a step, relative, at which the run ends earlier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) until_steady: Option<Real>,
    /// Longest stable steps with all contacts stuck and as deep as they get; none where nothing swings.
    #[serde(rename = "longest_verlet_step_s", skip_serializing_if = "Option::is_none")]
    pub(super) longest_verlet: Option<Real>,
    #[serde(rename = "longest_rk4_step_s", skip_serializing_if = "Option::is_none")]
    pub(super) longest_rk4: Option<Real>,
}

impl Stepping {
    pub(super) fn of(job: &Job) -> Self {
        let (stepper, word, value) = job.stepper();
        let value_if = |wanted| (word == wanted).then_some(Real(value));
        let longest = |stepper| job.model.longest_step(stepper).filter(|step| step.is_finite()).map(Real);
        Self {
            stepper,
            tolerance: value_if("tolerance"),
            step: value_if("step_s"),
            duration: Real(job.scenario.plan.duration),
            until_steady: job.scenario.plan.until_steady.map(|asked| Real(asked.change)),
            longest_verlet: longest(Stepper::Verlet { step: 0.0 }),
            longest_rk4: longest(Stepper::Rk4 { step: 0.0 }),
        }
    }
}
