//! Slopes by five-point differences of separate runs, with other distances than the program's and another tolerance.

use crate::prepared;
use serde_json::Value;
use std::error::Error;
use std::path::{Path, PathBuf};
use stickslip_drive::Stepper;
use stickslip_run::{Job, Summary};
use stickslip_scenario::Scenario;
use stickslip_study::sensitivity::{Asked, Sensitivity};
use stickslip_study::steady::{self, Options};

/// Tolerance of the runs.
const OWN: f64 = 1e-13;
/// Distances of the five-point differences relative to the parameter; the program uses none of them.
const STEPS: [f64; 6] = [3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// Result of the periodic orbit; it is requested alone.
pub(crate) const STEADY: &str = "steady.step_m";
/// Overrides.
pub(crate) type Set = Vec<(String, String)>;

pub(crate) fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.json"))
}

/// Random numbers from 0 to 1 (Knuth's MMIX generator).
pub(crate) struct Drawn(pub(crate) u64);

impl Drawn {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// Returns results of the file with overrides: the step length of the periodic orbit, or numbers of the summary and
/// channels at the end of a run.
fn figures(file: &Path, set: &Set, names: &[String]) -> Result<Vec<f64>, Box<dyn Error>> {
    let set: Vec<(&str, &str)> = set.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
    let mut scenario = Scenario::load_with(file, &set)?;
    scenario.plan.stepper = Stepper::Event { tolerance: OWN };
    scenario.plots.clear();
    let job = Job::new(scenario, "own".to_owned(), PathBuf::new())?;
    if names == [STEADY] {
        let found = steady::find(&job, &Options { tolerance: OWN, ..Options::default() })?;
        return Ok(vec![found.step.ok_or("a step")?]);
    }
    let outcome = job.run(&());
    let summary = serde_json::to_value(Summary::new(&job, &outcome))?;
    let figure = |name: &String| {
        let pointer = format!("/{}", name.replace('.', "/"));
        let number = summary.pointer(&pointer).and_then(Value::as_f64);
        let end = || outcome.kept.series.named(name).last().copied();
        number.or_else(end).ok_or_else(|| format!("{name} of {set:?}"))
    };
    Ok(names.iter().map(figure).collect::<Result<_, _>>()?)
}

/// Returns the slopes of results with their uncertainties. Each is the middle one of the three distances between which it changes least.
pub(crate) fn slopes(
    file: &Path,
    set: &Set,
    (path, value): (&str, f64),
    names: &[String],
) -> Result<Vec<(f64, f64)>, Box<dyn Error>> {
    let mut by_step = Vec::new();
    for step in STEPS.map(|share| share * value) {
        let at = |k: f64| {
            let mut set = set.clone();
            set.retain(|(other, _)| other != path);
            set.push((path.to_owned(), format!("{:e}", value + k * step)));
            figures(file, &set, names)
        };
        let [a, b, c, d] = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
        let slope = |f: usize| (a[f] - 8.0 * b[f] + 8.0 * c[f] - d[f]) / (12.0 * step);
        by_step.push((0..names.len()).map(slope).collect::<Vec<f64>>());
    }
    // A single slope may agree with its neighbour by accident.
    let best = |f: usize| {
        let threes = by_step.windows(3).map(|three| {
            let [before, own, after] = [0, 1, 2].map(|k| three[k][f]);
            (own, (own - before).abs().max((after - own).abs()))
        });
        threes.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((f64::NAN, f64::INFINITY))
    };
    Ok((0..names.len()).map(best).collect())
}

/// Returns overrides of a scenario with `count` parameters changed by up to 10 %.
pub(crate) fn moved(
    (file, asked): (&Path, &Asked),
    end: (&str, &str),
    count: usize,
    drawn: &mut Drawn,
) -> Result<Set, Box<dyn Error>> {
    let mut set = vec![(end.0.to_owned(), end.1.to_owned())];
    let plain = Sensitivity::new(prepared(file, &set)?, asked, &())?;
    for _ in 0..count {
        let quantity = &plain.quantities[drawn.below(plain.quantities.len())];
        // Related waveforms keep their common period.
        if quantity.unit != "s" && quantity.unit != "Hz" && quantity.unit != "rad" {
            set.retain(|(path, _)| *path != quantity.path);
            set.push((quantity.path.clone(), format!("{:e}", quantity.value * (0.9 + 0.2 * drawn.next()))));
        }
    }
    Ok(set)
}

/// Returns `count` different parameters of a scenario.
pub(crate) fn chosen(
    (file, set): (&Path, &Set),
    asked: &Asked,
    count: usize,
    drawn: &mut Drawn,
) -> Result<Vec<String>, Box<dyn Error>> {
    let all = Sensitivity::new(prepared(file, set)?, asked, &())?.quantities;
    let mut to: Vec<String> = Vec::new();
    while to.len() < count.min(all.len()) {
        let path = &all[drawn.below(all.len())].path;
        if !to.contains(path) {
            to.push(path.clone());
        }
    }
    Ok(to)
}
