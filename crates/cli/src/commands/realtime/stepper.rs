//! A stepper by its name.

use super::failure::Failure;
use stickslip_drive::{Model, Stepper};
use stickslip_scenario::quantity;

/// What may be lost of a stroke in a stroke where nothing is given.
const ACCURACY: f64 = 1e-3;
/// Tolerance where none is given: that of a scenario.
const TOLERANCE: f64 = 1e-8;
/// Longest step where none is given, as a share of the longest stable one.
const SHARE: f64 = 0.2;

/// Frames of the period, unless another one is asked for: as exact as the scenario's own frames, if it has any.
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

/// Reads `NAME` or `NAME:VALUE`; frames without a value have the accuracy given.
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
            // As a scenario may have it.
            if (1e-13..=1e-2).contains(&tolerance) { Ok(Stepper::Event { tolerance }) } else { Err(refuse()) }
        }
        "verlet" => fixed(|step| Stepper::Verlet { step }),
        "rk4" => fixed(|step| Stepper::Rk4 { step }),
        _ => Err(refuse()),
    }
}

/// The longest step that divides the frame and is no longer than the share.
fn divided(model: &Model, make: fn(f64) -> Stepper, period: f64) -> Option<f64> {
    let longest = SHARE * model.longest_step(make(1.0))?;
    (longest.is_finite() && longest > 0.0).then(|| period / (period / longest).ceil().max(1.0))
}
