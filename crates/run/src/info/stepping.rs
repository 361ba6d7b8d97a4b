//! How time is stepped, and what fixed steps could be.

use crate::job::Job;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Stepper;
use stickslip_quantity::Real;

/// How time is stepped, and what fixed steps could be.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Stepping {
    /// the stepper that the run takes
    pub stepper: &'static str,
    /// its tolerance: local error per step, relative to the scales of the contacts
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Real>,
    /// its step, where that is fixed; the longest of a frame
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    pub step: Option<Real>,
    /// length of a frame, of the stepper `frames`
    #[serde(rename = "frame_s", skip_serializing_if = "Option::is_none")]
    pub frame: Option<Real>,
    /// time steps of a frame, without those added at corners and contact events
    #[serde(skip_serializing_if = "Option::is_none")]
    pub substeps: Option<Real>,
    /// simulated time
    #[serde(rename = "duration_s")]
    pub duration: Real,
    /// largest relative change of a step at which the run ends earlier
    #[serde(skip_serializing_if = "Option::is_none")]
    pub until_steady: Option<Real>,
    /// longest stable step of velocity Verlet: 2/ω of the fastest mode with all contacts stuck and as deep as they get, or RC
    /// of a driver
    #[serde(rename = "longest_verlet_step_s", skip_serializing_if = "Option::is_none")]
    pub longest_verlet: Option<Real>,
    /// the same of the classical Runge–Kutta method: 2√2/ω without damping, or 2.785·RC
    #[serde(rename = "longest_rk4_step_s", skip_serializing_if = "Option::is_none")]
    pub longest_rk4: Option<Real>,
}

impl Stepping {
    /// That of a job.
    pub fn of(job: &Job) -> Self {
        let (stepper, word, value) = job.stepper();
        let value_if = |wanted| (word == wanted).then_some(Real(value));
        let frame = match job.model.effective(job.scenario.plan.stepper) {
            Stepper::Frames { length, accuracy } => Some((length, accuracy)),
            _ => None,
        };
        let longest = |stepper| job.model.longest_step(stepper).filter(|step| step.is_finite()).map(Real);
        Self {
            stepper,
            tolerance: value_if("tolerance"),
            step: value_if("step_s"),
            frame: frame.map(|(length, _)| Real(length)),
            substeps: frame.map(|(length, accuracy)| Real(job.model.substeps(length, accuracy))),
            duration: Real(job.scenario.plan.duration),
            until_steady: job.scenario.plan.until_steady.map(|asked| Real(asked.change)),
            longest_verlet: longest(Stepper::Verlet { step: 0.0 }),
            longest_rk4: longest(Stepper::Rk4 { step: 0.0 }),
        }
    }
}
