//! Losses of a step: back-step and lost stroke.

use super::period::Way;
use crate::job::Job;
use crate::outcome::Outcome;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::scene::Side;
use stickslip_measure::foot::Foot;
use stickslip_quantity::Real;

/// Two durations count as equal if their difference is below this fraction of their sum.
const SAME: f64 = 1e-3;

/// Losses of a step.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Losses {
    /// relative back-step: back_step_m / (|step_m| + back_step_m). Absent if the step length is 0 within its error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub back_step: Option<Real>,
    /// back-step: largest displacement of the body against the direction of the step within a period and its
    /// repetition. For a step along +x: max x(t1) - x(t2) over t1 <= t2. Without a step: peak-to-peak motion. In
    /// `steady`, the mean of the last periods.
    #[serde(rename = "back_step_m")]
    pub back_step_length: Real,
    /// lost stroke: peak-to-peak travel of the foot in the last whole period minus |step_m|. Below 0 if the step is
    /// longer. Absent if the waveform named in `figures` does not move exactly one foot, or if flyback and forward
    /// stroke last equally long. Then steps.why has the reason.
    #[serde(rename = "lost_stroke_m", skip_serializing_if = "Option::is_none")]
    pub lost_stroke: Option<Real>,
}

impl Losses {
    /// Returns the losses of a step with its error, from the back-step `fall` and the travel of the foot, all in m.
    pub(super) fn of([step, error]: [f64; 2], fall: f64, travel: Option<f64>) -> Self {
        let share = (step.abs() > error).then(|| Real(fall / (step.abs() + fall)));
        let lost_stroke = travel.map(|travel| Real(travel - step.abs()));
        Self { back_step: share, back_step_length: Real(fall), lost_stroke }
    }
}

/// Motion of the foot in the last whole period.
#[derive(Debug, Clone, Copy)]
pub(super) struct FootMotion {
    /// Peak-to-peak travel, m.
    pub(super) travel: f64,
    /// Durations of extension and retraction of the stack, s. `None` if the foot follows its waveform directly.
    pub(super) own_times: Option<[f64; 2]>,
}

/// Returns the motion of the foot in the last whole period, or the reason why it is unknown. `ways` are forward and return stroke of the
/// waveform.
pub(super) fn foot(job: &Job, outcome: &Outcome, ways: [&Way; 2]) -> Result<FootMotion, &'static str> {
    let foot = Foot::of(job)
        .ok_or("it is defined only for a drive with one foot that follows the waveform of `figures`")?;
    let [forth, back] = ways.map(|way| way.time.0);
    if (forth - back).abs() <= SAME * (forth + back) {
        return Err(
            "the waveform returns as slowly as it advances, so the step may exceed the travel of the foot",
        );
    }
    let Foot::Driven { body, stack } = foot else {
        let stroke = super::steps::stroke(job).ok_or("the waveform is not a length")?;
        return Ok(FootMotion { travel: stroke, own_times: None });
    };
    let extent = outcome.tally.foot().ok_or("the motion of the foot was not recorded")?;
    // The voltage behind a driver has no ringing of the foot.
    let (leads, is_mirrored) = match outcome.tally.voltage() {
        Some(voltage) => (voltage, false),
        None => (
            extent,
            job.scenario.scene.actuators.get(stack).is_none_or(|it| it.part.between[1] != Side::Body(body)),
        ),
    };
    let up = (leads.most[1] - leads.least[1]).rem_euclid(forth + back);
    let times = [up, forth + back - up];
    let own_times = if is_mirrored { [times[1], times[0]] } else { times };
    Ok(FootMotion { travel: extent.width(), own_times: Some(own_times) })
}
