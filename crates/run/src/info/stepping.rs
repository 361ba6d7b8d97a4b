//! Time integration, and the stability limits of fixed time steps.

use crate::job::Job;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::Stepper;
use stickslip_quantity::Real;

/// Time integration of a run, and the stability limits of fixed time steps.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Stepping {
    /// name of the time integrator that the run uses
    pub stepper: &'static str,
    /// tolerance of the time integrator: local error per time step relative to the natural scales of the contacts.
    /// Absent for fixed time steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Real>,
    /// fixed time step; with `frames`, the longest one. Absent for adaptive time integrators.
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    pub step: Option<Real>,
    /// duration of a frame. Absent without `frames`.
    #[serde(rename = "frame_s", skip_serializing_if = "Option::is_none")]
    pub frame: Option<Real>,
    /// number of time steps in a frame, without those added at corners and contact events. Absent without `frames`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub substeps: Option<Real>,
    /// simulated time of a complete run
    #[serde(rename = "duration_s")]
    pub duration: Real,
    /// largest relative change of the step length at which run.until_steady ends the run. Absent without this key.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub until_steady: Option<Real>,
    /// stability limit of the time step of velocity Verlet: 2/ω of the fastest mode with all contacts in full stick at
    /// their largest indentations, or RC of a driver. Absent without a limit.
    #[serde(rename = "longest_verlet_step_s", skip_serializing_if = "Option::is_none")]
    pub longest_verlet: Option<Real>,
    /// stability limit of the time step of the classical Runge–Kutta method: 2√2/ω (without damping) of the fastest
    /// mode, or 2.785·RC of a driver. Absent without a limit.
    #[serde(rename = "longest_rk4_step_s", skip_serializing_if = "Option::is_none")]
    pub longest_rk4: Option<Real>,
}

impl Stepping {
    /// Returns the time integration of a job.
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
