//! Plausibility of drivers: time constants that determine the number of time steps.

use super::{Implausible, told};
use stickslip_drive::{Accuracy, Stepper};

/// Largest stable time step of the event-driven integrator, in time constants of a driver.
// The stability limit of DOP853 on the negative real axis is 6.4.
const STRIDE: f64 = 6.0;
/// Number of time steps above which a run takes some seconds.
const MANY: f64 = 1e6;

impl Implausible<'_> {
    /// Warns about current limits of reciprocal drivers without series resistance if the integrator does not locate events.
    ///
    /// The driver then switches between limited and unlimited operation at every time step.
    pub(super) fn chatter(&mut self, stepper: Stepper) {
        if stepper.locates_events() {
            return;
        }
        let scenario = &self.setting.scenario;
        for piezo in scenario.stacks.iter().filter(|piezo| piezo.is_reciprocal(&scenario.scene)) {
            let Some(spec) = &piezo.driver else { continue };
            if spec.current.is_some() && spec.resistance.is_none() {
                let path = format!("actuators.{}.driver.reciprocal", piezo.name);
                let message = "without events a reciprocal driver chatters at its current limit at any step size: its energy may be a third too large, that of dampers many times too large".to_owned();
                let help = "use the stepper `event`, or set the driver's resistance";
                self.find("driver_chatters", &path, message, help);
            }
        }
    }

    /// Warns about drivers whose time constant limits the time step by stability.
    pub(super) fn drivers(&mut self, stepper: Stepper) {
        let setting = self.setting;
        let duration = setting.scenario.plan.duration;
        for piezo in &setting.scenario.stacks {
            let (Some(spec), Some(_)) = (&piezo.driver, piezo.block) else { continue };
            let rate = spec.rate();
            let steps = match stepper.accuracy() {
                // Implicit methods need no small time steps for fast transients.
                Accuracy::Tolerance(_) if setting.model.is_stiff() => continue,
                Accuracy::Tolerance(_) => duration * rate / STRIDE,
                Accuracy::Frame { length, error } => {
                    duration / length * setting.model.substeps(length, error)
                }
                // A fixed time step is given by the user, and a step that is too long is an error.
                Accuracy::Step(_) => continue,
            };
            if rate == 0.0 || steps < MANY {
                continue;
            }
            let low = spec.low.is_some_and(|low| std::f64::consts::TAU * low.frequency >= rate);
            let key = if low { "bandwidth" } else { "resistance" };
            let time = told(rate.recip(), "s");
            let message = format!(
                "this driver settles within {time}, which every step has to resolve: about {steps:.0e} steps"
            );
            let help = "omit it (the voltage then follows without delay), or simulate a shorter time";
            self.find("stiff_driver", &format!("actuators.{}.driver.{key}", piezo.name), message, help);
        }
    }
}
