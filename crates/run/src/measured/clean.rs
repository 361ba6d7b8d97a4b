//! Corrections of a measured record: spikes, time lag, drift and compliance of the rig.

use std::borrow::Cow;
use stickslip_measure::{Interval, SteadyLoop, noise};

/// Minimum height of a spike: in standard deviations of the noise, and relative to the usual difference of consecutive values.
const SPIKE: [f64; 2] = [10.0, 6.0];
/// Quantile of the differences of consecutive values that is used as the usual difference.
const USUAL: f64 = 0.9;

/// Effects that are corrected on request.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Correct {
    /// Time lag of the force.
    pub lag: bool,
    /// Drift of displacement and force.
    pub drift: bool,
}

/// Test rig in series with the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rig {
    /// Known stiffness of the rig, N/m.
    Stiffness(f64),
    /// Known tangent stiffness of the contact at the reversals, N/m. Any additional compliance is attributed to the rig.
    Contact(f64),
}

impl Rig {
    /// Returns the compliance of the rig, m/N, from a measured tangent stiffness of rig and contact together.
    pub(super) fn compliance(self, whole: Interval) -> Interval {
        match self {
            Self::Stiffness(stiffness) => {
                let value = 1.0 / stiffness;
                Interval { value, low: value, high: value }
            }
            Self::Contact(contact) => {
                let rig = |whole: f64| 1.0 / whole - 1.0 / contact;
                Interval { value: rig(whole.value), low: rig(whole.high), high: rig(whole.low) }
            }
        }
    }
}

/// Values that are used for the corrections.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Correction {
    /// Time lag of the force, s.
    lag: f64,
    /// Drift rates of the displacement and of the force, per second.
    drift: [f64; 2],
    /// Compliance of the rig, m/N.
    pub(super) compliance: f64,
}

impl Correction {
    pub(super) fn of(steady: &SteadyLoop, correct: Correct) -> Self {
        let drift = [steady.displacement_drift.value, steady.force_drift.value];
        Self {
            lag: if correct.lag { steady.lag.value } else { 0.0 },
            drift: if correct.drift { drift } else { [0.0; 2] },
            compliance: 0.0,
        }
    }
}

/// Returns the corrected displacements and forces, and the numbers of removed spikes.
pub(super) fn clean<'a>(
    t: &[f64],
    u: &'a [f64],
    force: &'a [f64],
    correction: &Correction,
) -> (Cow<'a, [f64]>, Cow<'a, [f64]>, [usize; 2]) {
    let ((mut u, first), (mut force, second)) = (without_spikes(u), without_spikes(force));
    let start = t.first().copied().unwrap_or(0.0);
    for (values, drift) in [(&mut u, correction.drift[0]), (&mut force, correction.drift[1])] {
        if drift != 0.0 {
            values.to_mut().iter_mut().zip(t).for_each(|(value, t)| *value -= drift * (t - start));
        }
    }
    if correction.lag != 0.0 {
        force = Cow::Owned(earlier(t, &force, correction.lag));
    }
    if correction.compliance != 0.0 {
        u.to_mut().iter_mut().zip(force.iter()).for_each(|(u, force)| *u -= correction.compliance * force);
    }
    (u, force, [first, second])
}

/// Returns the values at the times t + lag by linear interpolation. Before the first and after the last time, values are constant.
fn earlier(t: &[f64], values: &[f64], lag: f64) -> Vec<f64> {
    let at = |time: f64| {
        let after = t.partition_point(|t| *t < time).clamp(1, t.len() - 1);
        let (from, to) = (t[after - 1], t[after]);
        let share = if to > from { ((time - from) / (to - from)).clamp(0.0, 1.0) } else { 1.0 };
        values[after - 1] + share * (values[after] - values[after - 1])
    };
    if t.len() < 2 { values.to_vec() } else { t.iter().map(|t| at(t + lag)).collect() }
}

/// Replaces spikes of single rows by the mean of their neighbours. Returns the number of spikes.
fn without_spikes(values: &[f64]) -> (Cow<'_, [f64]>, usize) {
    let mut steps: Vec<f64> = values.windows(2).map(|two| (two[1] - two[0]).abs()).collect();
    if steps.len() < 8 {
        return (Cow::Borrowed(values), 0);
    }
    let usual = (USUAL * steps.len() as f64) as usize;
    let usual = *steps.select_nth_unstable_by(usual, f64::total_cmp).1;
    let least = (SPIKE[0] * noise(values)).max(SPIKE[1] * usual);
    let is_spike = |three: &[f64]| {
        let (up, down) = (three[1] - three[0], three[1] - three[2]);
        up * down > 0.0 && up.abs().min(down.abs()) > least && (three[2] - three[0]).abs() < 0.5 * up.abs()
    };
    let places: Vec<usize> = (1..values.len() - 1).filter(|i| is_spike(&values[i - 1..=i + 1])).collect();
    if places.is_empty() {
        return (Cow::Borrowed(values), 0);
    }
    let mut clean = values.to_vec();
    places.iter().for_each(|i| clean[*i] = 0.5 * (values[i - 1] + values[i + 1]));
    (Cow::Owned(clean), places.len())
}
