//! Integrators by name.

use super::failure::Failure;
use stickslip_drive::{Model, Stepper};
use stickslip_scenario::quantity;

/// Default accuracy of frames: error per stroke, relative to the stroke.
const ACCURACY: f64 = 1e-3;
/// Default tolerance, equal to that of a scenario.
const TOLERANCE: f64 = 1e-8;
/// Default time step as a fraction of the longest stable one.
const SHARE: f64 = 0.2;

/// Returns the requested integrator. The default are frames of the given period, with the accuracy of the scenario's
/// own frames if it has any.
pub(super) fn chosen(
    asked: Option<&str>,
    own: Stepper,
    model: &Model,
    period: f64,
) -> Result<Stepper, Failure> {
    let accuracy = match own {
        Stepper::Frames { accuracy, .. } => accuracy,
        _ => ACCURACY,
    };
    asked.map_or(Ok(Stepper::Frames { length: period, accuracy }), |text| {
        stepper(text, accuracy, model, period)
    })
}

/// Reads `NAME` or `NAME:VALUE`. `accuracy` is the default for frames.
fn stepper(text: &str, accuracy: f64, model: &Model, period: f64) -> Result<Stepper, Failure> {
    let (name, value) = text.split_once(':').map_or((text, None), |(name, value)| (name, Some(value)));
    let refuse = || Failure::Stepper(text.to_owned());
    let fixed = |make: fn(f64) -> Stepper| {
        let step = match value {
            Some(value) => quantity(value.trim_matches('"'), "s").map_err(|_| refuse())?,
            None => divided(model, make, period).ok_or_else(|| Failure::NoStep(name.to_owned()))?,
        };
        Ok(make(step))
    };
    match name {
        "frames" => {
            let accuracy = value.map_or(Ok(accuracy), |value| value.parse().map_err(|_| refuse()))?;
            let is_known = (1e-9..=1e-1).contains(&accuracy);
            if is_known { Ok(Stepper::Frames { length: period, accuracy }) } else { Err(refuse()) }
        }
        "event" => {
            let tolerance = value.map_or(Ok(TOLERANCE), |value| value.parse().map_err(|_| refuse()))?;
            // Same range as in a scenario.
            if (1e-13..=1e-2).contains(&tolerance) { Ok(Stepper::Event { tolerance }) } else { Err(refuse()) }
        }
        "verlet" => fixed(|step| Stepper::Verlet { step }),
        "rk4" => fixed(|step| Stepper::Rk4 { step }),
        _ => Err(refuse()),
    }
}

/// Returns the longest time step that divides the frame and is below the default fraction of the stable one.
fn divided(model: &Model, make: fn(f64) -> Stepper, period: f64) -> Option<f64> {
    let longest = SHARE * model.longest_step(make(1.0))?;
    (longest.is_finite() && longest > 0.0).then(|| period / (period / longest).ceil().max(1.0))
}
