//! Drivers so fast that the steps of a run are theirs.

use super::{Implausible, told};
use stickslip_drive::{Accuracy, Stepper};

/// Times in which a driver settles that a step of the event stepper takes, by its stability.
// DOP853 ends at 6.4. The stage of docs/piezo.md behind 1 mΩ, which its 2 A hold for 29 % of the time, took one per 6.3 in the rest,
// 157 617 in 10 ms for what takes 1 566 without a resistance, and 1 570 041 behind 0.1 mΩ, before both were stepped over.
const STRIDE: f64 = 6.0;
/// Steps from which on a run is longer than one waits for without a word: some seconds.
const MANY: f64 = 1e6;

impl Implausible<'_> {
    /// Limits of current that the charge of strain meets, under a stepper whose steps do not end there: it goes into the limit and out
    /// of it from step to step, however short they are.
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

    /// Drivers that follow so fast that stability, not what is to be seen, makes the steps.
    pub(super) fn drivers(&mut self, stepper: Stepper) {
        let setting = self.setting;
        let duration = setting.scenario.plan.duration;
        for piezo in &setting.scenario.stacks {
            let (Some(spec), Some(_)) = (&piezo.driver, piezo.block) else { continue };
            let rate = spec.rate();
            let steps = match stepper.accuracy() {
                // Implicit steps go over what settles.
                Accuracy::Tolerance(_) if setting.model.is_stiff() => continue,
                Accuracy::Tolerance(_) => duration * rate / STRIDE,
                Accuracy::Frame { length, error } => {
                    duration / length * setting.model.substeps(length, error)
                }
                // As given; one that is too long is refused.
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
