//! Results that are differentiated: numbers of a run's summary, channels at the end of the run, step length and
//! velocity of the periodic orbit.

use super::SensitivityError;
use crate::sweep::wanted::needs_rows;
use serde_json::Value;
use stickslip_drive::scene::Side;
use stickslip_quantity::names;
use stickslip_run::Job;
use stickslip_scenario::suggestion;

/// A result that is differentiated.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name: path of a number in `summary.json`, a channel such as `slider.x_m`, or `steady.step_m` or `steady.speed_m_s`.
    pub name: String,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Value for the unchanged scenario, SI.
    pub value: f64,
    /// Source of the value.
    pub(super) reading: Reading,
}

/// Source of a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    /// Summary of the run.
    Summary,
    /// Last row of the time histories.
    End,
    /// Step length of the periodic orbit.
    SteadyStep,
    /// Mean velocity of the periodic orbit.
    SteadySpeed,
}

/// Default results of a drive, and default results of each contact if there is no drive.
const DRIVE: [&str; 5] = [
    "steps.last_m",
    "steps.mean_speed_m_s",
    "steps.last_period.work.efficiency",
    "energy.friction_J",
    "energy.damping_J",
];
const LOOP: [&str; 3] = ["fretting.dissipated_J", "fretting.force_amplitude_N", "peak_fx_N"];
/// Results of the periodic orbit.
pub(super) const STEADY: [(&str, Reading); 2] =
    [("steady.step_m", Reading::SteadyStep), ("steady.speed_m_s", Reading::SteadySpeed)];

/// Parts of the summary that describe the execution of a run instead of its results.
const OF_RUNS: [&str; 8] =
    ["program", "stepper", "counts", "timing", "tables", "simulated_s", "warnings", "steady_after_periods"];
const OF_THE_RUN: &str = "describes the execution of the run";
const WHOLE: &str = "is a count";

impl Figure {
    /// Returns whether the result is computed from the rows of the time histories.
    pub(super) fn needs_rows(&self) -> bool {
        self.reading == Reading::Summary && needs_rows(&self.name)
    }
}

impl Reading {
    /// Returns whether the result comes from a run.
    pub(super) fn is_of_run(self) -> bool {
        matches!(self, Self::Summary | Self::End)
    }
}

/// Returns the source of a result of the periodic orbit, or `None` for other names.
pub(super) fn steady(name: &str) -> Option<Reading> {
    STEADY.into_iter().find(|(known, _)| *known == name).map(|(_, reading)| reading)
}

/// Finds source and value of a result in a run's summary and last row.
///
/// # Errors
/// Fails if the result does not exist or is not continuous.
pub(super) fn find(
    job: &Job,
    name: &str,
    summary: &Value,
    end: &dyn Fn(&str) -> Option<f64>,
) -> Result<(Reading, f64), SensitivityError> {
    let not_continuous = |why| Err(SensitivityError::NotContinuous { name: name.to_owned(), why });
    let top = name.split(['.', '[']).next().unwrap_or(name);
    let mut leaves = Vec::new();
    numbers(String::new(), summary, &mut leaves);
    match leaves.iter().find(|(known, _)| known == name) {
        Some(_) if OF_RUNS.contains(&top) => return not_continuous(OF_THE_RUN),
        Some((_, value)) if is_whole(value) => return not_continuous(WHOLE),
        Some((_, value)) => return Ok((Reading::Summary, value.as_f64().unwrap_or(f64::NAN))),
        None => {}
    }
    if let Some(value) = end(name) {
        return Ok((Reading::End, value));
    }
    let steadily = name.strip_prefix("steady_motion.").map(|rest| format!("steady.{rest}"));
    if steadily.is_some_and(|own| steady(&own).is_some()) {
        return Err(SensitivityError::NoFigure {
            name: name.to_owned(),
            help: Some(format!(
                "step and speed of the periodic orbit are \"{}\" and \"{}\"",
                STEADY[0].0, STEADY[1].0
            )),
        });
    }
    if stickslip_run::definitions()
        .iter()
        .any(|known| ["summary.json", "trace.csv"].iter().any(|file| known.defines(file, name)))
    {
        return Err(SensitivityError::NotHere { name: name.to_owned(), file: job.name.clone() });
    }
    let told = leaves
        .iter()
        .filter(|(known, value)| !is_whole(value) && !OF_RUNS.iter().any(|part| known.starts_with(part)));
    let channels = job.model.channels();
    let channels =
        channels.iter().skip(1).map(|channel| channel.name.as_str()).filter(|name| end(name).is_some());
    let known = told.map(|(name, _)| name.as_str()).chain(channels);
    let help = suggestion(name, known.chain(STEADY.iter().map(|(name, _)| *name)));
    Err(SensitivityError::NoFigure { name: name.to_owned(), help })
}

/// Returns the default results: steps and losses of a drive, otherwise dissipated energy and forces of contacts.
pub(super) fn by_default(job: &Job, summary: &Value) -> Vec<String> {
    let scene = &job.scenario.scene;
    let is_own = |c: usize| {
        let body = job.scenario.figures.body.map(Side::Body);
        body.is_none_or(|body| {
            scene.contacts.get(c).is_some_and(|contact| contact.part.between.contains(&body))
        })
    };
    let contacts = job.model.contacts().enumerate().filter(|(c, _)| is_own(*c)).map(|(_, (name, _))| name);
    let names: Vec<&str> = contacts.collect();
    let ringing = names.iter().map(|name| format!("steps.last_period.contacts.{name}.ringing_left"));
    let drive = DRIVE.map(str::to_owned).into_iter().chain(ringing);
    let loops = names.iter().flat_map(|name| LOOP.map(|figure| format!("contacts.{name}.{figure}")));
    let mut leaves = Vec::new();
    numbers(String::new(), summary, &mut leaves);
    let is_told = |name: &String| {
        leaves.iter().any(|(known, value)| known == name && value.as_f64().is_some_and(|value| value != 0.0))
    };
    let drive: Vec<String> = drive.filter(is_told).collect();
    // For a drive, steps and losses are more useful than results of the loops of its contacts.
    if drive.first().is_some_and(|name| name.starts_with("steps.")) {
        drive
    } else {
        loops.filter(is_told).collect()
    }
}

/// Returns the SI unit from the name of a result.
pub(super) fn unit(name: &str) -> &'static str {
    names::unit(name)
}

fn is_whole(value: &Value) -> bool {
    value.is_u64() || value.is_i64()
}

/// Collects the names and values of all numbers, such as `steps.steady.step_m`.
pub(super) fn numbers<'a>(name: String, here: &'a Value, found: &mut Vec<(String, &'a Value)>) {
    match here {
        Value::Object(entries) => {
            let dot = if name.is_empty() { "" } else { "." };
            entries.iter().for_each(|(key, inner)| numbers(format!("{name}{dot}{key}"), inner, found));
        }
        Value::Array(entries) => {
            entries.iter().enumerate().for_each(|(i, inner)| numbers(format!("{name}[{i}]"), inner, found));
        }
        Value::Number(_) => found.push((name, here)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn numbers_have_the_names_of_their_places() {
        let summary = json!({"a": {"b.c": {"d": 1.5}, "b": 2.5}, "e": [{"f": 3.5}, 4.5], "n": 3, "w": "x"});
        let mut all = Vec::new();
        numbers(String::new(), &summary, &mut all);
        all.sort_by(|a, b| a.0.cmp(&b.0));
        let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["a.b", "a.b.c.d", "e[0].f", "e[1]", "n"]);
        assert!(is_whole(all[4].1) && !is_whole(all[3].1));
    }
}
