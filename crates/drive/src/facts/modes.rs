//! Normal modes with all contacts stuck, over the range of the normal loads.

use super::{Setup, has_constant_load};
use crate::NormalMode;
use std::f64::consts::TAU;

/// Normal mode with all contacts stuck.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Frequency with the contact indentations of t = 0, Hz; 0 for a free motion.
    pub frequency: f64,
    /// Frequencies of the mode with this index at the smallest and the largest indentations, Hz; `None` if all normal loads are constant.
    pub range: Option<(f64, f64)>,
    /// Damping ratio as a fraction of critical damping.
    pub damping_ratio: f64,
    /// Name and displacement of each coordinate in the mode; the largest displacement is 1.
    pub shape: Vec<(String, f64)>,
}

/// Returns all normal modes by increasing frequency.
pub fn modes(setup: Setup<'_>) -> Vec<Mode> {
    let Setup { scene, model, start } = setup;
    let linearised = model.linearised(start, |d| d.start);
    // Under constant loads the three frequencies are equal.
    let varies = scene.contacts.iter().any(|contact| !has_constant_load(&contact.part));
    let frequencies =
        |modes: Vec<NormalMode>| -> Vec<f64> { modes.iter().map(|mode| mode.frequency / TAU).collect() };
    // Compared by order of frequency, not by shape.
    let least = frequencies(model.linearised(start, |d| d.least).modes());
    let most = frequencies(model.linearised(start, |d| d.most).modes());
    let names = linearised.coordinates();
    let mode = |(k, mode): (usize, NormalMode)| Mode {
        frequency: mode.frequency / TAU,
        range: least.get(k).zip(most.get(k)).filter(|_| varies).map(|(low, high)| (*low, *high)),
        damping_ratio: mode.damping_ratio,
        shape: names.iter().cloned().zip(mode.shape).collect(),
    };
    linearised.modes().into_iter().enumerate().map(mode).collect()
}
