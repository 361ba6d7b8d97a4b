//! Number of time steps in a frame (control interval) of a real-time simulation.

use super::Reach;
use crate::contact::Contact;
use crate::{Model, Waveform};
use nalgebra::ComplexField;
use std::f64::consts::FRAC_PI_2;

/// Step ωh divided by the square root of the accuracy, for constant normal loads.
const STRIDE: f64 = 9.0;
/// Step ωh divided by the square root of the accuracy, for varying normal loads: kinks then limit the accuracy of every step.
const MOVING: f64 = 3.0;
/// Fraction of the longest stable step that is used.
const STABLE: f64 = 0.5;
/// Inverse coefficient of the local error of a fourth-order step for an exponential.
const TRUNCATION: f64 = 120.0;

impl Model {
    /// Returns the number of steps in a frame of a length (s) for an error of `accuracy` per stroke, relative to the stroke; an integer.
    ///
    /// The time step h is the smallest of these:
    ///
    /// * h = 9 √accuracy/ω, because kinks of a contact's law inside a step cause a local error of (ωh)². With varying normal loads h = 3
    ///   √accuracy/ω.
    /// * Half the longest stable time step.
    /// * h = (120 accuracy)^{1/5}/|λ|, for states of blocks and bodies on damped contacts, with the largest eigenvalue λ. The local error
    ///   of a step is (|λ|h)⁵/120.
    ///
    /// ω is the highest natural angular frequency in full stick at the largest depths, or the highest angular frequency of a waveform, if
    /// larger.
    pub fn substeps(&self, length: f64, accuracy: f64) -> f64 {
        let (swing, stable) = self.frequency_and_limit(Reach::RK4);
        let of_blocks = self.block_eigenvalues().iter().map(|rate| rate.modulus()).fold(0.0, f64::max);
        // Motions with other dampers have decayed, but slip changes the damping of a contact.
        let is_damped = self.contacts.iter().any(Contact::is_damped);
        let settling = if is_damped { of_blocks.max(self.paces().fading) } else { of_blocks };
        let quarter = self.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
        let fastest = swing.max(FRAC_PI_2 / quarter);
        let smooth = math::powf(TRUNCATION * accuracy, 0.2) / settling;
        let stride = if self.has_moving_normals() { MOVING } else { STRIDE };
        let step = (stride * accuracy.sqrt() / fastest).min(STABLE * stable).min(smooth);
        (length / step).ceil().max(1.0)
    }

    /// Returns whether the normal load of any contact varies.
    pub(crate) fn has_moving_normals(&self) -> bool {
        self.contacts.iter().any(|contact| !contact.is_constant() && !contact.is_never_pressed())
    }
}
