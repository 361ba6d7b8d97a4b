//! The quantities of a drive.

use crate::job::Job;
use crate::outcome::Outcome;
use crate::periods::Periods;
use crate::real::Real;
use serde::Serialize;
use stickslip_analysis::Steps;
use stickslip_drive::scene::Freedom;

/// Steps of the body named in `figures`, over the whole periods of the waveform named there.
#[derive(Debug, Serialize)]
pub struct DriveSummary {
    body: String,
    waveform: String,
    #[serde(rename = "period_s")]
    period: Real,
    /// Length of every step.
    #[serde(rename = "lengths_m")]
    lengths: Vec<Real>,
    /// What the steps settled to.
    pub steady: Steady,
    /// First period, from 0, from which every step stays near the steady one; none: it has not settled.
    #[serde(skip_serializing_if = "Option::is_none")]
    settled_from: Option<usize>,
    /// Net travel over time, m/s.
    #[serde(rename = "mean_speed_m_s")]
    pub mean_speed: Real,
    #[serde(rename = "net_travel_m")]
    net_travel: Real,
    /// Ends of periods without a row or an event, where the position was interpolated by the cubic of positions and
    /// velocities; at the others it is exact.
    interpolated_ends: usize,
}

/// Over the last half of the periods.
#[derive(Debug, Serialize)]
pub struct Steady {
    periods: usize,
    /// Mean length of a step, m.
    #[serde(rename = "step_m")]
    pub step: Real,
    /// Standard deviation of the step.
    #[serde(rename = "repeatability_m", skip_serializing_if = "Option::is_none")]
    pub repeatability: Option<Real>,
    /// Share of the forward stroke lost in the flyback and after.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub back_step: Option<Real>,
}

/// Periods after which a run ended before its time without a fault.
pub(super) fn steady_after(job: &Job, outcome: &Outcome) -> Option<usize> {
    let plan = &job.scenario.plan;
    let asked = plan.until_steady.filter(|_| outcome.error.is_none())?;
    let end = Some(outcome.state.time()).filter(|end| *end < plan.duration)?;
    let waveform = job.scenario.scene.waveforms.get(asked.waveform)?;
    Periods::until(&waveform.part, end).map(|periods| periods.count)
}

/// The steps of a run; none, with a note where that needs one, if there are no whole periods or no free body.
pub(super) fn of(job: &Job, outcome: &Outcome, notes: &mut Vec<String>) -> Option<DriveSummary> {
    let (scene, figures) = (&job.scenario.scene, job.scenario.figures);
    let body = scene.bodies.get(figures.body?)?;
    let waveform = scene.waveforms.get(figures.waveform?)?;
    let period = waveform.part.period()?;
    if body.part.x.freedom != Freedom::Free {
        return None;
    }
    let Some(periods) = Periods::until(&waveform.part, outcome.state.time()) else {
        notes.push(format!(
            "no steps: the run is shorter than a period of {period} s of \"{}\"",
            waveform.name
        ));
        return None;
    };
    let series = &outcome.kept.series;
    let [x, v] = ["x_m", "vx_m_s"].map(|quantity| series.column(&body.name, quantity));
    let motion = periods.motion(series.time(), x, v);
    match Steps::of_record(&motion.t, &motion.x, period) {
        Ok(steps) => Some(summary(&steps, &body.name, &waveform.name, (period, motion.interpolated))),
        Err(error) => {
            notes.push(format!("no steps: {error}"));
            None
        }
    }
}

fn summary(steps: &Steps, body: &str, waveform: &str, (period, interpolated): (f64, usize)) -> DriveSummary {
    DriveSummary {
        body: body.to_owned(),
        waveform: waveform.to_owned(),
        period: Real(period),
        lengths: steps.periods.iter().map(|p| Real(p.length)).collect(),
        steady: Steady {
            periods: steps.steady.periods,
            step: Real(steps.steady.step),
            repeatability: steps.steady.repeatability.map(Real),
            back_step: steps.steady.back_step.map(Real),
        },
        settled_from: steps.settled_from,
        mean_speed: Real(steps.mean_speed),
        net_travel: Real(steps.net_travel),
        interpolated_ends: interpolated,
    }
}
