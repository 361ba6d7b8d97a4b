//! Report of an optimum.

use super::shape::Drawing;
use super::{Best, Optimum};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;
use stickslip_quantity::{Real, quantity};
use stickslip_run::program;
use stickslip_scenario::Shaped;

/// Relative distances from the optimum for which ranges are reported.
const SHARES: [f64; 2] = [0.001, 0.01];
/// Fraction of a rate limit from which on a rate counts as limited.
const REACHED: f64 = 0.999;

/// Content of `optimum.json`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    pub scenario: String,
    /// SHA-256 of the complete scenario, with all defaults and --set values
    pub scenario_sha256: String,
    /// name and version of the program
    pub program: String,
    /// name of the optimised result
    pub result: String,
    /// goal of the search: `maximum` or `minimum`
    pub goal: &'static str,
    /// Optimum.
    pub best: Optimal,
    /// Result at the optimum for each factor of the period. One entry unless the study requests the worst case of
    /// period ± 1 %.
    pub periods: Vec<AtPeriod>,
    /// bounds and driver limits at which the optimum lies
    pub limits: Vec<String>,
    /// Flatness of the optimum along each number.
    pub flatness: Vec<Flat>,
    /// All local searches.
    pub starts: Vec<Start>,
    /// number of evaluated points, each with all factors of the period
    pub evaluations: usize,
    /// number of evaluated points without a result. They count as the worst value.
    pub failed: usize,
    /// Waveform of the optimum.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waveform: Option<Played>,
}

/// Optimum.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Optimal {
    /// value of the result at the optimum. If the study requests the worst case, the worst value for period ± 1 %.
    pub value: Real,
    /// arguments of `--set` that change the scenario to the optimum
    pub set: Vec<String>,
}

/// Result for one factor of the period.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct AtPeriod {
    /// factor by which all periods are multiplied
    pub factor: Real,
    /// value of the result at the optimum, with all periods multiplied by factor
    pub value: Real,
}

/// Range of a number in which the result is close to the optimum.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Flat {
    /// path of the varied number, or name of the coordinate of the waveform
    pub number: String,
    /// SI unit of the number, empty for a coordinate of a waveform, which ranges from 0 to 1
    pub unit: &'static str,
    /// value of the number at the optimum
    pub best: Real,
    /// range of the number in which the result is within 0.1 % of the optimum, with all other numbers at the optimum.
    /// null if the range extends to the bound.
    pub within_0_1_percent: [Option<Real>; 2],
    /// range of the number in which the result is within 1 % of the optimum, with all other numbers at the optimum.
    /// null if the range extends to the bound.
    pub within_1_percent: [Option<Real>; 2],
}

/// Local search.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Start {
    /// value of the result at the start of a local search
    pub from: Real,
    /// value of the result at the end of a local search
    pub to: Real,
    /// number of points that a local search evaluated
    pub evaluations: usize,
    /// arguments of `--set` that change the scenario to the end of a local search
    pub set: Vec<String>,
}

/// Waveform for a generator.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Played {
    /// SI unit of the values of the optimal waveform
    pub unit: &'static str,
    /// period of the optimal waveform
    pub period_s: Real,
    /// smallest and largest value of the optimal waveform
    pub range: [Real; 2],
    /// largest falling and rising rate of the optimal waveform, in its unit per second
    pub rates: [Real; 2],
}

impl Optimum {
    /// Returns the report of a search.
    #[must_use]
    pub fn report(&self, best: &Best) -> Report {
        let sign = self.sign();
        let worst = best.values.iter().map(|value| sign * value).fold(f64::INFINITY, f64::min);
        let periods = self.stretches.iter().zip(&best.values);
        Report {
            scenario: self.job.name.clone(),
            scenario_sha256: self.job.hash.clone(),
            program: format!("{} {}", program::NAME, program::VERSION),
            result: self.goal.result.clone(),
            goal: if self.goal.is_maximum { "maximum" } else { "minimum" },
            best: Optimal { value: Real(sign * worst), set: self.set(&best.point) },
            periods: periods
                .map(|(factor, value)| AtPeriod { factor: Real(*factor), value: Real(*value) })
                .collect(),
            limits: self.limits(best),
            flatness: best.sections.iter().map(flat).collect(),
            starts: best
                .locals
                .iter()
                .map(|local| Start {
                    from: Real(sign * local.from.1),
                    to: Real(sign * local.to.1),
                    evaluations: local.evaluations,
                    set: self.set(&local.to.0),
                })
                .collect(),
            evaluations: best.counts.0,
            failed: best.counts.1,
            waveform: self.played(best),
        }
    }

    fn set(&self, point: &[f64]) -> Vec<String> {
        self.space.overrides(point, 1.0).into_iter().map(|(path, value)| format!("{path}={value}")).collect()
    }

    fn played(&self, best: &Best) -> Option<Played> {
        let (drawing, period) = self.space.drawing(&best.point)?;
        let unit = self.space.shaped()?.unit;
        Some(Played {
            unit,
            period_s: Real(period),
            range: drawing.range().map(Real),
            rates: drawing.rates(period).map(Real),
        })
    }

    /// Returns the bounds and limits at which an optimum lies.
    fn limits(&self, best: &Best) -> Vec<String> {
        let mut limits = Vec::new();
        for (section, (.., [low, high])) in best.sections.iter().zip(self.space.numbers()) {
            let shown = |value: f64| match section.unit {
                "" => value.to_string(),
                unit => quantity(Real(value), unit),
            };
            let ends = section.at_bound.into_iter().zip([("lower", low), ("upper", high)]);
            let reached = ends.filter(|(is_reached, _)| *is_reached);
            limits.extend(reached.map(|(_, (end, bound))| {
                format!("{} is at its {end} bound, {}", section.name, shown(bound))
            }));
        }
        if let (Some(shaped), Some((drawing, period))) =
            (self.space.shaped(), self.space.drawing(&best.point))
        {
            limits.extend(of_driver(shaped, &drawing, period));
        }
        if limits.is_empty() {
            limits.push("no bound: the optimum lies inside all ranges".to_owned());
        }
        limits
    }

    /// Returns one period of the optimal waveform as a table for a generator: time, value, and value divided by the gain of the amplifier.
    /// The sample rate is adjusted to a whole number of samples per period. Returns `None` if the study has no waveform.
    #[must_use]
    pub fn samples(&self, best: &Best, rate: Option<f64>, gain: f64) -> Option<String> {
        let (drawing, period) = self.space.drawing(&best.point)?;
        let unit = self.space.shaped()?.unit;
        let count = rate.map_or(SAMPLES, |rate| (rate * period).round().clamp(2.0, MOST_SAMPLES) as usize);
        let mut text = format!("time [s],value [{unit}],generator [{unit}]\n");
        for i in 0..count {
            let share = i as f64 / count as f64;
            let value = drawing.value(share);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:?},{value:?},{:?}", period * share, value / gain);
        }
        Some(text)
    }
}

impl Optimum {
    /// Returns the optimal waveform in the form of a scenario file, or `None` if the study has no waveform.
    #[must_use]
    pub fn waveform(&self, best: &Best) -> Option<String> {
        let (drawing, period) = self.space.drawing(&best.point)?;
        Some(format!("{:#}\n", drawing.form(period)))
    }
}

/// Default number of samples per period.
const SAMPLES: usize = 1000;
/// Largest number of samples per period.
const MOST_SAMPLES: f64 = 1e7;

/// Returns the limits of a driver that a waveform reaches.
fn of_driver(shaped: &Shaped, drawing: &Drawing, period: f64) -> Vec<String> {
    let ([low, high], [least, most]) = (shaped.window, drawing.range());
    let mut limits = Vec::new();
    let ends = [("lower", low, least - low), ("upper", high, high - most)];
    for (end, bound, room) in ends {
        if room <= (1.0 - REACHED) * (high - low) {
            limits.push(format!("the waveform reaches the {end} end of the window, {bound} {}", shaped.unit));
        }
    }
    let rates = shaped.slew.map(|slew| slew.into_iter().zip(drawing.rates(period)));
    for ((limit, rate), sense) in rates.into_iter().flatten().zip(["falls", "rises"]) {
        if rate >= REACHED * limit {
            limits.push(format!("the waveform {sense} at the rate limit of the current, {limit:.4e} V/s"));
        }
    }
    limits
}

fn flat(section: &super::Section) -> Flat {
    let [near, wide] = SHARES.map(|share| section.range(share).map(|end| end.map(Real)));
    Flat {
        number: section.name.clone(),
        unit: section.unit,
        best: Real(section.best),
        within_0_1_percent: near,
        within_1_percent: wide,
    }
}
