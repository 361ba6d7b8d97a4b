//! Notes and JSON output of the evaluation of a measured record.

use super::{Evaluated, MISFIT, Measured, Stage};
use crate::{Real, quantity};
use serde_json::{Value, json};
use stickslip_measure::Interval;

/// Smallest drift per cycle, relative to the amplitude, and smallest lag, relative to the period, that are reported.
const LITTLE: f64 = 1e-4;
impl Evaluated {
    /// Returns all results as JSON.
    #[must_use]
    pub fn json(&self, measured: &Measured) -> Value {
        let of_stage = |stage: &Stage| {
            let [from, to] = stage.time;
            json!({
                "cycles": stage.cycles.len(),
                "from_s": from,
                "to_s": to,
                "regime": stage.regime,
                "results": stage.results(),
            })
        };
        let found = self.found.map(|found| {
            json!({
                "period_s": found.period,
                "lag_s": found.lag,
                "displacement_drift_m_s": found.displacement_drift,
                "force_drift_N_s": found.force_drift,
                "misfit": found.misfit,
            })
        });
        json!({
            "file": measured.file,
            "cycles": self.cycles.len(),
            "is_turned": measured.is_turned,
            "results": self.longest().map(Stage::results),
            "with_rig": self.with_rig.as_ref().map(|(whole, rig)| {
                json!({ "rig_stiffness_N_m": rig, "results": whole.results() })
            }),
            "signals": found,
            "record": self.account,
            "stages": self.stages.iter().map(of_stage).collect::<Vec<_>>(),
            "notes": self.notes(measured),
        })
    }

    /// Returns notes on assumptions, corrections and properties of the signals.
    #[must_use]
    pub fn notes(&self, measured: &Measured) -> Vec<String> {
        let mut notes = measured.notes.clone();
        if measured.is_turned {
            notes.push("the force opposes the motion; its sign is reversed".to_owned());
        }
        let [of_u, of_force] = self.spikes;
        if of_u + of_force > 0 {
            notes.push(format!("spikes left out: {of_u} of the displacement, {of_force} of the force"));
        }
        let Some(found) = self.found else {
            let lost = "the cycles have no common period: the intervals follow from the scatter of cycles, without lag";
            notes.push(lost.to_owned());
            return notes;
        };
        let time = if measured.has_time { "s" } else { "" };
        let is_there = |interval: &Interval| interval.low > 0.0 || interval.high < 0.0;
        let shown = |interval: &Interval, unit: &str| {
            let [value, half] =
                [interval.value, interval.half_width()].map(|value| quantity(Real(value), unit));
            format!("{value} \u{b1} {half}")
        };
        let drifts = [
            ("displacement", &found.displacement_drift, "m", found.displacement_amplitude),
            ("force", &found.force_drift, "N", found.force_amplitude),
        ];
        for (name, drift, unit, amplitude) in drifts {
            let [value, half] = [drift.value, drift.half_width()].map(|rate| rate * found.period);
            let own = Interval { value, low: value - half, high: value + half };
            if is_there(drift) && value.abs() > LITTLE * amplitude.value {
                notes.push(format!("drift of the {name}: {} per cycle (--correct drift)", shown(&own, unit)));
            }
        }
        if found.misfit >= MISFIT {
            let share = 100.0 * found.misfit;
            notes.push(format!(
            "the branches differ from those of an elastic contact at constant load by {share:.1} % of Q*: results are means over the cycles, and their intervals are approximate"
        ));
            return notes;
        }
        if is_there(&found.lag) && found.lag.value.abs() > LITTLE * found.period {
            let lag = if measured.has_time {
                shown(&found.lag, time)
            } else {
                format!("{:.2} \u{b1} {:.2} rows", found.lag.value, found.lag.half_width())
            };
            let shares = 100.0 * found.lag.value / found.period;
            notes.push(format!("the force is {lag} late, {shares:.2} % of a period (--correct lag)"));
        }
        if !found.is_sense_sure {
            notes.push("the rows do not determine whether the force drives or opposes the motion".to_owned());
        }
        if found.dissipated.low <= 0.0 {
            notes.push("the dissipated energy is not significantly above 0".to_owned());
        }
        notes
    }
}
