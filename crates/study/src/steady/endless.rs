//! Drive whose waveforms continue without end, and the common period of the waveforms.

use super::SteadyError;
use serde_json::Value;
use std::path::PathBuf;
use stickslip_drive::scene::{Named, Scene};
use stickslip_drive::{Model, Timing, Waveform};
use stickslip_run::Job;
use stickslip_scenario::Scenario;

/// Longest common period, as a multiple of the longest waveform period.
const MOST: u32 = 64;
/// Relative tolerance for an integer ratio of periods, which allows for rounding of the input.
const WHOLE: f64 = 1e-12;

/// Drive with endless waveforms.
pub(super) struct Endless {
    pub(super) model: Model,
    /// Initial state at t = 0.
    pub(super) start: stickslip_drive::State,
    /// Common period of all waveforms, s.
    pub(super) period: f64,
    /// Time after which all waveforms are periodic, s.
    pub(super) begins: f64,
}

impl Endless {
    /// Creates the drive with endless waveforms from a scenario.
    ///
    /// # Errors
    /// Fails if a calling program commands a waveform, a waveform has neither period nor end, there is no common
    /// period, or no coordinate is free.
    pub(super) fn of(job: &Job) -> Result<Self, SteadyError> {
        let mut scene = job.scenario.scene.clone();
        let idle = &job.model.spared().waveforms;
        let mut periods: Vec<(String, f64)> = Vec::new();
        let mut begins = 0.0_f64;
        for (w, Named { name, part }) in scene.waveforms.iter_mut().enumerate() {
            if idle.contains(&w) {
                continue;
            }
            if part.generator().is_some() || part.interpolation().is_some() {
                return Err(SteadyError::Commanded(name.clone()));
            }
            match part.period().filter(|_| repeats(job, w)) {
                Some(period) => {
                    *part = endless(part);
                    periods.push((name.clone(), period));
                    begins = begins.max(part.timing().delay);
                }
                None if part.window().1 == f64::INFINITY => return Err(SteadyError::Endless(name.clone())),
                None => begins = begins.max(part.window().1),
            }
        }
        let period = common(&periods)?;
        Self::build(job, &scene, period, begins)
    }

    fn build(job: &Job, scene: &Scene, period: f64, begins: f64) -> Result<Self, SteadyError> {
        let model = Model::new(scene)?;
        if model.is_walk() {
            return Err(SteadyError::NothingFree);
        }
        let start = model.start(&job.scenario.plan)?;
        Ok(Self { model, start, period, begins })
    }
}

/// Returns whether waveform `w` is periodic. A waveform of one cycle counts as finished, unless it is the waveform named in `figures`.
fn repeats(job: &Job, w: usize) -> bool {
    let Some(Named { part, .. }) = job.scenario.scene.waveforms.get(w) else { return false };
    let once =
        job.scenario.figures.waveform != Some(w) && part.timing().cycles.is_some_and(|cycles| cycles <= 1.0);
    part.period().is_some() && !once
}

/// Returns a runnable scenario of the same drive with endless waveforms. If the run would end before the time `start`, s, it is extended by
/// its duration.
pub(super) fn job(job: &Job, start: f64, folder: PathBuf) -> Result<Job, SteadyError> {
    // The resolved scenario can be read again without other files.
    let mut form: Value = serde_json::from_str(&job.resolved).unwrap_or_default();
    for (w, Named { name, .. }) in job.scenario.scene.waveforms.iter().enumerate() {
        let Some(Value::Object(shapes)) = form.pointer_mut("/waveforms").and_then(|all| all.get_mut(name))
        else {
            continue;
        };
        for shape in shapes.values_mut().filter(|_| repeats(job, w)).filter_map(Value::as_object_mut) {
            shape.shift_remove("cycles");
        }
    }
    let end = job.scenario.plan.duration;
    if let (true, Some(run)) = (end <= start, form.get_mut("run").and_then(Value::as_object_mut)) {
        run.shift_remove("cycles");
        run.insert("duration".to_owned(), Value::from(start + end));
    }
    let scenario = Scenario::from_str_alone(&form.to_string(), &job.name)?;
    Ok(Job::new(scenario, job.name.clone(), folder)?)
}

/// Returns the waveform without end.
fn endless(waveform: &Waveform) -> Waveform {
    let timing = Timing { cycles: None, ..*waveform.given() };
    Waveform::new(waveform.shape().clone(), timing).unwrap_or_else(|_| waveform.clone())
}

/// Returns the smallest common multiple of all periods.
fn common(periods: &[(String, f64)]) -> Result<f64, SteadyError> {
    let longest = periods.iter().max_by(|a, b| a.1.total_cmp(&b.1)).ok_or(SteadyError::NoPeriod)?;
    let fits = |count: u32, period: f64| {
        let ratio = f64::from(count) * longest.1 / period;
        (ratio - ratio.round()).abs() <= WHOLE * ratio
    };
    let all = |count: &u32| periods.iter().all(|(_, period)| fits(*count, *period));
    if let Some(count) = (1..=MOST).find(all) {
        return Ok(f64::from(count) * longest.1);
    }
    let other = periods.iter().find(|(_, period)| !(1..=MOST).any(|count| fits(count, *period)));
    let other = other.unwrap_or(longest);
    Err(SteadyError::Incommensurate {
        first: longest.0.clone(),
        second: other.0.clone(),
        periods: [longest.1, other.1],
        most: MOST,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(periods: &[f64]) -> Vec<(String, f64)> {
        periods.iter().enumerate().map(|(i, period)| (i.to_string(), *period)).collect()
    }

    #[test]
    fn the_common_period_is_the_least_common_multiple() {
        assert_eq!(common(&named(&[2e-3, 3e-3])).ok(), Some(6e-3));
        assert_eq!(common(&named(&[1e-3, 0.25e-3])).ok(), Some(1e-3));
        assert_eq!(common(&[]).err(), Some(SteadyError::NoPeriod));
    }

    #[test]
    fn periods_in_the_ratio_of_a_root_have_none() {
        let refused = common(&named(&[1.0, std::f64::consts::SQRT_2]));
        assert!(matches!(refused, Err(SteadyError::Incommensurate { .. })));
    }
}
