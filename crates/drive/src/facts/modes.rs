//! Normal modes with all contacts stuck, over the range of the loads.

use super::{Setup, has_constant_load};
use crate::NormalMode;
use std::f64::consts::TAU;

/// A normal mode with all contacts stuck.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// With all contacts as deep as at t = 0, Hz; 0: nothing holds this motion.
    pub frequency: f64,
    /// Frequencies, Hz, of the mode of this place with all contacts at their smallest and largest indentation; none where
    /// all loads are constant.
    pub range: Option<(f64, f64)>,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// Displacement of each coordinate by its name, the largest 1.
    pub shape: Vec<(String, f64)>,
}

/// All normal modes, by rising frequency.
pub fn modes(setup: Setup<'_>) -> Vec<Mode> {
    let Setup { scene, model, start } = setup;
    let linearised = model.linearised(start, |d| d.start);
    // Under constant loads all three are one: told once.
    let varies = scene.contacts.iter().any(|contact| !has_constant_load(&contact.part));
    let frequencies =
        |modes: Vec<NormalMode>| -> Vec<f64> { modes.iter().map(|mode| mode.frequency / TAU).collect() };
    // By place and not by shape: modes that change places with the load are told in order of their frequency.
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
