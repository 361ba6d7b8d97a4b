//! At which values of a quantity its scenario is run.

use super::quantity::Quantity;
use super::sample::{Happened, Missing, Sample};
use stickslip_run::Job;

/// A variant of the scenario.
#[derive(Debug, Clone)]
pub(super) struct Tried {
    /// How far away the quantity is meant to be, as a share of its scale.
    pub(super) share: f64,
    /// How far it is.
    pub(super) offset: f64,
    /// Whether slopes are taken from it, and not noise alone.
    pub(super) is_level: bool,
    /// What it came to.
    pub(super) sample: Result<Sample, Missing>,
}

impl Tried {
    /// How far away it is, one of its figures, and what happens.
    pub(super) fn figure(&self, place: usize) -> Result<(f64, f64, &Happened), Missing> {
        let Sample { figures, happened } = self.sample.as_ref().map_err(Clone::clone)?;
        let value = figures.get(place).copied().flatten().ok_or(Missing::Absent)?;
        Ok((self.offset, value, happened))
    }
}

/// Powers of two of the levels: from 0.8 % inwards each a quarter of the one before.
const LEVELS: [i32; 7] = [7, 9, 11, 13, 15, 17, 19];
/// How many levels are the farthest.
const FARTHEST: usize = 3;
/// Powers of two of the distances of two pairs of runs that are tried before all others: 0.2 % and a quarter of it, then 0.003 %.
pub(super) const PAIRS: [[i32; 2]; 2] = [[9, 11], [15, 17]];
/// The same where something else happens as near as these: to where noise leaves a few digits.
const FINER: [i32; 5] = [21, 23, 25, 27, 29];
/// A power of two of distances between values that noise is measured of, and how many of them to a side: the second is a level.
const NOISE: i32 = 20;
const BESIDE: i32 = 3;
/// How many runs on a side must agree about what happens there.
const NEAREST: usize = 3;
/// How many distances are tried for a quantity that is 0, and the share of one in the one before.
const PROBES: i32 = 10;
const SHRINK: f64 = 0.125;

/// The shares that every quantity is tried at, and whether they are levels.
pub(super) fn first() -> impl Iterator<Item = (f64, bool)> {
    let levels = LEVELS.into_iter().map(|power| (2.0_f64.powi(-power), true));
    let beside = (1..=BESIDE).filter(|k| *k != 2).map(|k| (f64::from(k) * 2.0_f64.powi(-NOISE), false));
    both(levels.chain(beside))
}

/// Two pairs of levels, the outer one first.
pub(super) fn pairs(powers: [i32; 2]) -> impl Iterator<Item = (f64, bool)> {
    both(powers.into_iter().map(|power| (2.0_f64.powi(-power), true)))
}

/// The farthest of them, on both sides, which slopes are most often made of.
pub(super) fn farthest() -> impl Iterator<Item = (f64, bool)> {
    both(LEVELS.into_iter().take(FARTHEST).map(|power| (2.0_f64.powi(-power), true)))
}

/// Those that have not been tried.
pub(super) fn further(tried: &[Tried]) -> impl Iterator<Item = (f64, bool)> + '_ {
    first().filter(|(share, _)| tried.iter().all(|tried| tried.share != *share))
}

/// Those that follow where these are too far away.
pub(super) fn finer() -> impl Iterator<Item = (f64, bool)> {
    both(FINER.into_iter().map(|power| (2.0_f64.powi(-power), true)))
}

/// The shares at which the scale of a quantity is looked for that has none of its own.
pub(super) fn probes() -> impl Iterator<Item = (f64, bool)> {
    (0..PROBES).map(|k| (SHRINK.powi(k), false))
}

fn both(shares: impl Iterator<Item = (f64, bool)>) -> impl Iterator<Item = (f64, bool)> {
    shares.flat_map(|(share, is_level)| [(-share, is_level), (share, is_level)])
}

/// The levels on one side, the outermost first.
pub(super) fn levels(tried: &[Tried], sense: f64) -> Vec<&Tried> {
    let mut levels: Vec<&Tried> =
        tried.iter().filter(|tried| tried.is_level && sense * tried.offset > 0.0).collect();
    levels.sort_by(|a, b| b.offset.abs().total_cmp(&a.offset.abs()));
    levels
}

/// What happens close to the value on one side, where the nearest runs agree about it.
pub(super) fn settled(tried: &[Tried], sense: f64) -> Option<&Happened> {
    let levels = levels(tried, sense);
    let mut nearest = levels.iter().rev().filter_map(|tried| tried.sample.as_ref().ok()).take(NEAREST);
    let first = &nearest.next()?.happened;
    nearest.all(|sample| sample.happened == *first).then_some(first)
}

/// Neighbours at equal distances, for the neighbours at equal distances; none where something else happens at one of them.
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

/// Where a quantity that is 0 is looked for a scale: what is large for its unit in this scene.
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
