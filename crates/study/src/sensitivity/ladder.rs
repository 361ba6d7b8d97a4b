//! Parameter values of the variants: a series of decreasing distances from the value in the scenario.

use super::quantity::Quantity;
use super::sample::{Happened, Missing, Sample};
use stickslip_run::Job;

/// A variant of the scenario with its results.
#[derive(Debug, Clone)]
pub(super) struct Tried {
    /// Nominal distance of the parameter, relative to its scale.
    pub(super) share: f64,
    /// Actual distance.
    pub(super) offset: f64,
    /// True if slopes use this variant; false if the variant only serves to measure noise.
    pub(super) is_level: bool,
    /// Results of the run.
    pub(super) sample: Result<Sample, Missing>,
}

impl Tried {
    /// Returns distance, value of the result with index `place`, and events.
    pub(super) fn figure(&self, place: usize) -> Result<(f64, f64, &Happened), Missing> {
        let Sample { figures, happened } = self.sample.as_ref().map_err(Clone::clone)?;
        let value = figures.get(place).copied().flatten().ok_or(Missing::Absent)?;
        Ok((self.offset, value, happened))
    }
}

/// Negative binary exponents of the relative distances, beginning with 0.8 %. Each distance is a quarter of the previous one.
const LEVELS: [i32; 7] = [7, 9, 11, 13, 15, 17, 19];
/// Number of largest distances whose runs are repeated at another tolerance.
const FARTHEST: usize = 3;
/// Negative binary exponents of the distances of the first two pairs of runs: 0.2 % and 0.05 %, then 0.003 % and 0.0008 %.
pub(super) const PAIRS: [[i32; 2]; 2] = [[9, 11], [15, 17]];
/// Further exponents if events change nearby; at the smallest distances noise leaves only a few significant digits.
const FINER: [i32; 5] = [21, 23, 25, 27, 29];
/// Negative binary exponent of the spacing of parameter values for the measurement of noise, and number of values on each side. The second
/// value is also used for slopes.
const NOISE: i32 = 20;
const BESIDE: i32 = 3;
/// Number of runs on one side whose events must agree.
const NEAREST: usize = 3;
/// Number of distances tried to find the scale of a parameter that is 0, and their ratio.
const PROBES: i32 = 10;
const SHRINK: f64 = 0.125;

/// Returns the relative distances for every parameter, each with the flag whether slopes use this distance.
pub(super) fn first() -> impl Iterator<Item = (f64, bool)> {
    let levels = LEVELS.into_iter().map(|power| (2.0_f64.powi(-power), true));
    let beside = (1..=BESIDE).filter(|k| *k != 2).map(|k| (f64::from(k) * 2.0_f64.powi(-NOISE), false));
    both(levels.chain(beside))
}

/// Returns the relative distances of two pairs of runs, the outer pair first.
pub(super) fn pairs(powers: [i32; 2]) -> impl Iterator<Item = (f64, bool)> {
    both(powers.into_iter().map(|power| (2.0_f64.powi(-power), true)))
}

/// Returns the largest distances on both sides, from which most slopes are computed.
pub(super) fn farthest() -> impl Iterator<Item = (f64, bool)> {
    both(LEVELS.into_iter().take(FARTHEST).map(|power| (2.0_f64.powi(-power), true)))
}

/// Returns the relative distances that have not been tried.
pub(super) fn further(tried: &[Tried]) -> impl Iterator<Item = (f64, bool)> + '_ {
    first().filter(|(share, _)| tried.iter().all(|tried| tried.share != *share))
}

/// Returns additional distances closer to the parameter value.
pub(super) fn finer() -> impl Iterator<Item = (f64, bool)> {
    both(FINER.into_iter().map(|power| (2.0_f64.powi(-power), true)))
}

/// Returns the relative distances at which the scale of a parameter that is 0 is searched for.
pub(super) fn probes() -> impl Iterator<Item = (f64, bool)> {
    (0..PROBES).map(|k| (SHRINK.powi(k), false))
}

fn both(shares: impl Iterator<Item = (f64, bool)>) -> impl Iterator<Item = (f64, bool)> {
    shares.flat_map(|(share, is_level)| [(-share, is_level), (share, is_level)])
}

/// Returns the variants on one side that slopes use, the largest distance first.
pub(super) fn levels(tried: &[Tried], sense: f64) -> Vec<&Tried> {
    let mut levels: Vec<&Tried> =
        tried.iter().filter(|tried| tried.is_level && sense * tried.offset > 0.0).collect();
    levels.sort_by(|a, b| b.offset.abs().total_cmp(&a.offset.abs()));
    levels
}

/// Returns the events close to the parameter value on one side, if the nearest runs agree.
pub(super) fn settled(tried: &[Tried], sense: f64) -> Option<&Happened> {
    let levels = levels(tried, sense);
    let mut nearest = levels.iter().rev().filter_map(|tried| tried.sample.as_ref().ok()).take(NEAREST);
    let first = &nearest.next()?.happened;
    nearest.all(|sample| sample.happened == *first).then_some(first)
}

/// Returns the values at equidistant neighbours. Returns `None` if a neighbour has no value.
pub(super) fn neighbours(
    tried: &[Tried],
    own: f64,
    value: impl Fn(&Tried) -> Option<f64>,
) -> Option<Vec<f64>> {
    let distance = 2.0_f64.powi(-NOISE);
    let at = |k: i32| match k {
        0 => Some(own),
        k => tried.iter().find(|tried| tried.share == f64::from(k) * distance).and_then(&value),
    };
    (-BESIDE..=BESIDE).map(at).collect()
}

/// Returns the initial scale of a parameter that is 0: a large value for its unit in this scenario.
pub(super) fn large(job: &Job, quantity: &Quantity) -> f64 {
    let contacts = (0..job.model.contacts().count()).map(|c| job.contact_scale(c));
    let most = |scales: &mut dyn Iterator<Item = f64>| scales.fold(0.0, f64::max);
    match quantity.unit {
        "m" => 1e3 * most(&mut contacts.map(|(length, _)| length)).max(1e-9),
        "N" => most(&mut contacts.map(|(_, force)| force)).max(1e-3),
        "s" => job.scenario.plan.duration,
        "N s/m" | "N/m" | "Pa" => 1e6,
        _ => 1.0,
    }
}
