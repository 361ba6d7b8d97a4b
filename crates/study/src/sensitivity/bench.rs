//! Where the variants of a scenario are run, side by side.

use super::ladder::{self, Tried};
use super::{Missing, Quantity, Sample, Sensitivity, sample};
use crate::each::each;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_run::{Job, Watcher};
use stickslip_scenario::ScenarioError;

/// Most of the figure that it may change by where the scale of a quantity is looked for.
const LITTLE: f64 = 0.1;

/// A watcher who is asked and not told.
pub(super) struct Silent<'a>(pub(super) &'a dyn Watcher);

impl Watcher for Silent<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}

/// Where variants are run.
pub(super) struct Bench<'a> {
    pub(super) asked: &'a Sensitivity,
    /// Local error per step of the runs.
    pub(super) tolerance: f64,
    pub(super) cores: usize,
    pub(super) watcher: &'a (dyn Watcher + Sync),
    /// Whether figures may be made of rows: what variations tell of is made of moments and events.
    pub(super) has_rows: bool,
    pub(super) done: &'a AtomicUsize,
}

impl Bench<'_> {
    /// Runs variants of quantities, by their places; they come by quantity.
    pub(super) fn run(&self, scales: &[f64], variants: &[(usize, (f64, bool))]) -> Vec<Vec<Tried>> {
        let asked = self.asked;
        let tried = each(variants.len(), self.cores, |place| {
            let (q, (share, is_level)) = variants[place];
            let quantity = &asked.quantities[q];
            let value = quantity.value + share * scales[q];
            let sample = self.found(&(&quantity.path, value), || {
                sample::variant(&asked.job, &quantity.path, value, self.tolerance)
            });
            let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
            self.watcher.reached(done as f64);
            Tried { share, offset: value - quantity.value, is_level, sample }
        });
        let mut by_quantity: Vec<Vec<Tried>> = vec![Vec::new(); asked.quantities.len()];
        variants.iter().zip(tried).for_each(|((q, _), tried)| by_quantity[*q].push(tried));
        by_quantity
    }

    /// What a variant comes to, by the journal or by its run.
    fn found(
        &self,
        of: &impl Serialize,
        job: impl FnOnce() -> Result<Job, Missing>,
    ) -> Result<Sample, Missing> {
        let asked = self.asked;
        let run = || {
            if !self.watcher.goes_on() {
                return Err(Missing::NotRun);
            }
            let job = if self.has_rows { job()? } else { sample::without_rows(job()?) };
            Sample::of(&job, &asked.figures, self.tolerance, &Silent(self.watcher))
        };
        asked.journal.found(&(of, self.tolerance), run, |found| !matches!(found, Err(Missing::NotRun)))
    }

    /// The figures of the scenario as it stands, by this tolerance.
    pub(super) fn own(&self) -> Vec<Option<f64>> {
        let asked = self.asked;
        let refused = |error: ScenarioError| Missing::Refused(error.to_string());
        let sample = self.found(&"own", || {
            sample::ready(asked.job.scenario.clone(), &asked.job.name, self.tolerance).map_err(refused)
        });
        sample.map_or_else(|_| Vec::new(), |sample| sample.figures)
    }

    /// The scale of each quantity: its magnitude, or of one that is 0 the largest distance at which all goes on nearly as it does.
    pub(super) fn scales(&self) -> Vec<f64> {
        let quantities = &self.asked.quantities;
        let large = |quantity: &Quantity| match quantity.value {
            0.0 => ladder::large(&self.asked.job, quantity),
            value => value.abs(),
        };
        let mut scales: Vec<f64> = quantities.iter().map(large).collect();
        let zeros = quantities.iter().enumerate().filter(|(_, quantity)| quantity.value == 0.0);
        let variants: Vec<_> =
            zeros.flat_map(|(q, _)| ladder::probes().map(move |probe| (q, probe))).collect();
        for (q, probes) in self.run(&scales, &variants).into_iter().enumerate() {
            let little = probes.iter().find(|tried| self.is_little(tried));
            scales[q] *= little.or(probes.last()).map_or(1.0, |tried| tried.share);
        }
        scales
    }

    /// Whether the same happens, and figures change by little.
    fn is_little(&self, tried: &Tried) -> bool {
        let Ok(sample) = &tried.sample else { return false };
        let figures = self.asked.figures.iter().zip(&sample.figures);
        sample.happened == self.asked.happened
            && figures.into_iter().all(|(own, other)| {
                other.is_some_and(|other| (other - own.value).abs() <= LITTLE * own.value.abs())
            })
    }
}
