//! What the driver electronics of stacks have done.

use crate::job::Job;
use crate::parts::Parts;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_drive::State;
use stickslip_piezo::Figures;
use stickslip_quantity::Real;

/// What a driver has done.
#[derive(Debug, Serialize, JsonSchema)]
pub struct DriverSummary {
    /// energy that the driver's source gave wherever it gave any; what came back is not taken off
    #[serde(rename = "drawn_J")]
    drawn: Real,
    /// largest |I|, at the ends of steps, within short ones behind a resistance or a bandwidth, and after jumps
    #[serde(rename = "peak_current_A")]
    peak_current: Real,
    /// mean of |I|, C times the way of the voltage over the time
    #[serde(rename = "mean_current_A")]
    mean_current: Real,
    /// Shares of the time at each limit.
    at_limit: Shares,
}

/// Shares of the time at each limit.
#[derive(Debug, Serialize, JsonSchema)]
struct Shares {
    /// share of the time at the largest current into the stack
    current_up: Real,
    /// share of the time at the largest current out of it
    current_down: Real,
    /// share of the time with the command below the window
    window_low: Real,
    /// share of the time with the command above it
    window_high: Real,
}

impl DriverSummary {
    /// For how much of the run a limit held it back, where one did.
    pub(super) fn line(&self, name: &str) -> Option<String> {
        let Shares { current_up, current_down, window_low, window_high } = &self.at_limit;
        let [current, window] = [current_up.0 + current_down.0, window_low.0 + window_high.0];
        let told = |share: f64, what: &str| {
            (share > 0.0).then(|| format!("{:.1} % of the time {what}", 100.0 * share))
        };
        let limits = [told(current, "at its current limit"), told(window, "at an end of its window")];
        let limits: Vec<String> = limits.into_iter().flatten().collect();
        (!limits.is_empty()).then(|| {
            format!("the driver of {name} was {}: the stack lags behind its command", limits.join(" and "))
        })
    }
}

/// All drivers, at the end of a run.
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
