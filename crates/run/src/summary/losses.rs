//! What a step loses: how far the body falls back, and how much of the foot's travel is no step.

use super::period::Way;
use crate::job::Job;
use crate::outcome::Outcome;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::scene::Side;
use stickslip_measure::foot::Foot;
use stickslip_quantity::Real;

/// Two times are the same where they differ by less than this share of their sum.
const SAME: f64 = 1e-3;

/// What a step loses.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Losses {
    /// back-step as a share of the body's forward motion: back_step_m / (|step_m| + back_step_m); left out where the step is 0
    /// within its error
    #[serde(skip_serializing_if = "Option::is_none")]
    pub back_step: Option<Real>,
    /// back-step: the largest fall of x after a maximum within a period and its repetition, counted in the direction of the
    /// step, max x(t1) - x(t2) over t1 <= t2; without a step the peak-to-peak motion. The mean of the last periods
    #[serde(rename = "back_step_m")]
    pub back_step_length: Real,
    /// lost stroke: peak-to-peak travel of the foot over the last whole period, minus |step_m|; below 0 where the step exceeds
    /// it. Of the foot that the waveform of the figures moves, itself or by a stack; left out, with the reason in steps.why,
    /// without one such foot and where the waveform goes back as slowly as it goes forward
    #[serde(rename = "lost_stroke_m", skip_serializing_if = "Option::is_none")]
    pub lost_stroke: Option<Real>,
}

impl Losses {
    /// Those of a step that may be off by an error, that falls back so far on a foot of such a travel, m.
    pub(super) fn of([step, error]: [f64; 2], fall: f64, travel: Option<f64>) -> Self {
        let share = (step.abs() > error).then(|| Real(fall / (step.abs() + fall)));
        let lost_stroke = travel.map(|travel| Real(travel - step.abs()));
        Self { back_step: share, back_step_length: Real(fall), lost_stroke }
    }
}

/// How the foot moved in the last whole period.
#[derive(Debug, Clone, Copy)]
pub(super) struct FootMotion {
    /// Peak to peak, m.
    pub(super) travel: f64,
    /// How long the stack lengthens and shortens, s; none of a foot that follows its waveform.
    pub(super) own_times: Option<[f64; 2]>,
}

/// How the foot moves in a period, or why none is told. `ways` are those of the waveform, forth and back.
pub(super) fn foot(job: &Job, outcome: &Outcome, ways: [&Way; 2]) -> Result<FootMotion, &'static str> {
    let foot = Foot::of(job)
        .ok_or("it is defined for a drive with exactly one foot, moved by the waveform of `figures`")?;
    let [forth, back] = ways.map(|way| way.time.0);
    if (forth - back).abs() <= SAME * (forth + back) {
        return Err(
            "the waveform returns as slowly as it advances, so the step may exceed the travel of the foot",
        );
    }
    let Foot::Driven { body, stack } = foot else {
        let stroke = super::steps::stroke(job).ok_or("the waveform has no length")?;
        return Ok(FootMotion { travel: stroke, own_times: None });
    };
    let extent = outcome.tally.foot().ok_or("the motion of the foot was not recorded")?;
    // A voltage behind a driver tells it without the ringing of the foot.
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
