//! Results of the driver electronics of piezo stacks.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::State;
use stickslip_piezo::Figures;
use stickslip_quantity::Real;

/// Results of a driver.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DriverSummary {
    /// energy that the source of the driver supplied, without deducting the energy that flowed back
    #[serde(rename = "drawn_J")]
    drawn: Real,
    /// largest |I| at the ends of time steps and after jumps. With a resistance or a bandwidth also within short time
    /// steps.
    #[serde(rename = "peak_current_A")]
    peak_current: Real,
    /// mean of |I|: capacitance C times total variation of the voltage, divided by the time
    #[serde(rename = "mean_current_A")]
    mean_current: Real,
    /// Fractions of the time at each limit.
    at_limit: Shares,
}

/// Fractions of the time at each limit.
#[derive(Debug, Serialize, JsonSchema)]
struct Shares {
    /// fraction of the time at the limit of the current into the stack
    current_up: Real,
    /// fraction of the time at the limit of the current out of the stack
    current_down: Real,
    /// fraction of the time in which the command is below the voltage window
    window_low: Real,
    /// fraction of the time in which the command is above the voltage window
    window_high: Real,
}

impl DriverSummary {
    /// Returns a sentence with the fractions of the time at each limit, or `None` if no limit was reached.
    pub(super) fn line(&self, name: &str) -> Option<String> {
        let Shares { current_up, current_down, window_low, window_high } = &self.at_limit;
        let [current, window] = [current_up.0 + current_down.0, window_low.0 + window_high.0];
        // A command that only touches an end of the voltage window is not clipped.
        let told = |share: f64, what: &str| {
            let percent = format!("{:.1} %", 100.0 * share);
            (percent != "0.0 %").then(|| format!("{percent} of the time {what}"))
        };
        let limits = [told(current, "at its current limit"), told(window, "at an end of its window")];
        let effect = match &limits {
            [Some(_), Some(_)] => "the stack lags behind its command, which the driver clips",
            [_, Some(_)] => "the driver clips its command",
            _ => "the stack lags behind its command",
        };
        let limits: Vec<String> = limits.into_iter().flatten().collect();
        (!limits.is_empty()).then(|| format!("the driver of {name} was {}: {effect}", limits.join(" and ")))
    }
}

/// Returns the results of all drivers at the end of a run.
pub(super) fn of(job: &Job, state: &State) -> Parts<DriverSummary> {
    let stacks = job.scenario.stacks.iter();
    let of = stacks.filter_map(|piezo| {
        let (spec, memory) = (piezo.driver?, state.block_memory(piezo.block?)?);
        let Figures { drawn, peak_current, mean_current, limited } = Figures::of(memory, &spec)?;
        let [current_up, current_down, window_low, window_high] = limited.map(Real);
        let summary = DriverSummary {
            drawn: Real(drawn),
            peak_current: Real(peak_current),
            mean_current: Real(mean_current),
            at_limit: Shares { current_up, current_down, window_low, window_high },
        };
        Some((piezo.name.clone(), summary))
    });
    Parts(of.collect())
}
