//! How many steps a frame takes.

use super::Linearised;
use crate::contact::Contact;
use crate::{Model, Stepper, Waveform};
use nalgebra::ComplexField;
use std::f64::consts::FRAC_PI_2;

/// The step, in 1/ω of the fastest swing, over the root of what may be lost of a stroke in a stroke.
const STRIDE: f64 = 9.0;
/// The same where the normal of a contact moves: it goes by one chord a step between its kinks.
const MOVING: f64 = 2.0;
/// Part of the longest stable step that is taken: what damps fast needs no accuracy, but must not ring.
const STABLE: f64 = 0.5;
/// 1 over the first term that a step of order 4 leaves of an exponential.
const TRUNCATION: f64 = 120.0;

impl Model {
    /// Steps that a frame of a length (s) takes to lose no more than `accuracy` of a stroke in a stroke: a whole number.
    ///
    /// Kinks of a contact's law inside a step (loops that close, turning points) cost a method of any order a local error of
    /// (ωh)², ω the fastest swing with all contacts stuck and as deep as they get, or the fastest wave of a waveform:
    /// h = 9 √accuracy/ω, at most half the longest stable step. Where the normal of a contact moves every step costs as much, by the area
    /// between its chord and the path: h = 2 √accuracy/ω. States of blocks go smoothly from corner to corner, and bodies settle on
    /// damped contacts: there a step of the method loses (|λ|h)⁵/120 of what settles: h = (120 accuracy)^{1/5}/|λ|, λ the largest of
    /// their eigenvalues.
    pub fn substeps(&self, length: f64, accuracy: f64) -> f64 {
        let parts = self.parts(|d| d.most);
        let swing = parts.iter().map(Linearised::highest_frequency).fold(0.0, f64::max);
        let of_blocks = self.block_eigenvalues().iter().map(|rate| rate.modulus()).fold(0.0, f64::max);
        // What other dampers make of bodies is gone before it counts, but where a contact slips its damping is another.
        let is_damped = self.contacts.iter().any(Contact::is_damped);
        let settling = if is_damped { of_blocks.max(self.paces().fading) } else { of_blocks };
        let stable = self.longest_step(Stepper::Frames { length, accuracy }).unwrap_or(f64::INFINITY);
        let quarter = self.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
        let fastest = swing.max(FRAC_PI_2 / quarter);
        let smooth = math::powf(TRUNCATION * accuracy, 0.2) / settling;
        let stride = if self.has_moving_normals() { MOVING } else { STRIDE };
        let step = (stride * accuracy.sqrt() / fastest).min(STABLE * stable).min(smooth);
        (length / step).ceil().max(1.0)
    }

    /// Whether the normal of a contact moves.
    pub(crate) fn has_moving_normals(&self) -> bool {
        self.contacts.iter().any(|contact| !contact.is_constant() && !contact.is_never_pressed())
    }
}
