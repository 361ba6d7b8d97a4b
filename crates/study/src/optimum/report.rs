//! What is written of an optimum.

use super::shape::Drawing;
use super::{Best, Optimum};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;
use stickslip_quantity::{Real, quantity};
use stickslip_run::program;
use stickslip_scenario::Shaped;

/// Shares of the optimum whose ranges are given.
const SHARES: [f64; 2] = [0.001, 0.01];
/// A limit counts as reached from this share of it on.
const REACHED: f64 = 0.999;

/// What `optimum.json` holds.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Report {
    /// name of the scenario
    pub scenario: String,
    /// SHA-256 of the resolved scenario
    pub scenario_sha256: String,
    /// name and version of the program
    pub program: String,
    /// the result that is optimised
    pub result: String,
    /// `maximum` or `minimum`
    pub goal: &'static str,
    /// the optimum
    pub best: Optimal,
    /// the result at the optimum, by the factor of the period; one entry where the worst of period ± 1 % is not asked for
    pub periods: Vec<AtPeriod>,
    /// what limits the optimum: bounds and limits of the driver that it lies at
    pub limits: Vec<String>,
    /// how fast the result falls beside the optimum, by number
    pub flatness: Vec<Flat>,
    /// all local searches
    pub starts: Vec<Start>,
    /// points that were evaluated, each at all factors of the period
    pub evaluations: usize,
    /// of these, points without a result; they count as the worst value
    pub failed: usize,
    /// the waveform of the optimum
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waveform: Option<Played>,
}

/// An optimum.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Optimal {
    /// the result: the worst of the period ± 1 % where that is asked for
    pub value: Real,
    /// options `--set` of `stickslip run` and `stickslip steady` that make the scenario of the optimum
    pub set: Vec<String>,
}

/// A result at a factor of the period.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct AtPeriod {
    /// factor by which all periods are multiplied
    pub factor: Real,
    /// the result
    pub value: Real,
}

/// The range of a number in which the result is near the optimum.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Flat {
    /// path of the number, or coordinate of the waveform
    pub number: String,
    /// its SI unit; empty for a coordinate of a waveform, from 0 to 1
    pub unit: &'static str,
    /// its value at the optimum
    pub best: Real,
    /// range in which the result is within 0.1 % of the optimum, from sections along the number; null where the bound ends it
    pub within_0_1_percent: [Option<Real>; 2],
    /// the same within 1 %
    pub within_1_percent: [Option<Real>; 2],
}

/// A local search.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Start {
    /// result where it began
    pub from: Real,
    /// result where it ended
    pub to: Real,
    /// points that it asked for
    pub evaluations: usize,
    /// where it ended
    pub set: Vec<String>,
}

/// A waveform as a generator plays it.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct Played {
    /// SI unit of its values
    pub unit: &'static str,
    /// period, s
    pub period_s: Real,
    /// least and largest value
    pub range: [Real; 2],
    /// largest rates down and up, values per second
    pub rates: [Real; 2],
}

impl Optimum {
    /// What a search has found, in words and numbers.
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

    /// The bounds and limits at which an optimum lies.
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

    /// One period of the waveform for a generator: time, value, and value over the gain of the amplifier, at a sample rate that is adjusted to
    /// a whole number of samples per period. None where the study has no waveform.
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
    /// The waveform as a scenario has it, to be pasted; none where the study has no waveform.
    #[must_use]
    pub fn waveform(&self, best: &Best) -> Option<String> {
        let (drawing, period) = self.space.drawing(&best.point)?;
        Some(format!("{:#}\n", drawing.form(period)))
    }
}

/// Samples of a period where no rate is given.
const SAMPLES: usize = 1000;
/// Most samples of a period.
const MOST_SAMPLES: f64 = 1e7;

/// The limits of a driver that a waveform reaches.
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
            limits.push(format!("the waveform {sense} as fast as the current allows, {limit:.4e} V/s"));
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
