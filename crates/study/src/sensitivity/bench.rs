//! Parallel runs of variants of a scenario.

use super::ladder::{self, Tried};
use super::{Missing, Quantity, Sample, Sensitivity, sample};
use crate::each::each;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_run::{Job, Watcher};
use stickslip_scenario::ScenarioError;

/// Largest relative change of a result at the scale of a parameter whose value is 0.
const LITTLE: f64 = 0.1;

/// Watcher that can interrupt, but receives no progress.
pub(super) struct Silent<'a>(pub(super) &'a dyn Watcher);

impl Watcher for Silent<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}

/// Settings for runs of variants, with a tolerance and a number of threads.
pub(super) struct Bench<'a> {
    pub(super) asked: &'a Sensitivity,
    /// Tolerance of the local error per time step.
    pub(super) tolerance: f64,
    pub(super) cores: usize,
    pub(super) watcher: &'a (dyn Watcher + Sync),
    /// True if a result, such as a peak load, needs rows of the time histories. Other results need only the last row and events.
    pub(super) has_rows: bool,
    pub(super) done: &'a AtomicUsize,
}

impl Bench<'_> {
    /// Runs variants, given by index of the parameter, relative distance and level flag. Returns the results grouped by parameter.
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

    /// Returns the results of a variant from the journal or from a run.
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

    /// Returns the results of the unchanged scenario at the tolerance of these runs.
    pub(super) fn own(&self) -> Vec<Option<f64>> {
        let asked = self.asked;
        let refused = |error: ScenarioError| Missing::Refused(error.to_string());
        let sample = self.found(&"own", || {
            sample::ready(asked.job.scenario.clone(), &asked.job.name, self.tolerance).map_err(refused)
        });
        sample.map_or_else(|_| Vec::new(), |sample| sample.figures)
    }

    /// Returns the scale of each parameter: its absolute value. The scale of a parameter that is 0 is the largest distance with the same
    /// events and nearly the same results.
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

    /// Returns whether a variant has the same events as the unchanged scenario and little change in the results.
    fn is_little(&self, tried: &Tried) -> bool {
        let Ok(sample) = &tried.sample else { return false };
        let figures = self.asked.figures.iter().zip(&sample.figures);
        sample.happened == self.asked.happened
            && figures.into_iter().all(|(own, other)| {
                other.is_some_and(|other| (other - own.value).abs() <= LITTLE * own.value.abs())
            })
    }
}
