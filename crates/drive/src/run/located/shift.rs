//! Shift of the origins of coordinates that travel far.
//!
//! The displacement u of a contact is the difference between a growing position and a slip memory that moves along. Without a shift, u
//! would lose a digit with every tenfold of the distance. The origin therefore moves by powers of two, which rounds no sum. Slip memories
//! and force-law branches of the contacts on that coordinate move with the origin.

use crate::Model;
use crate::model::Free;
use crate::state::State;

/// Distance from the origin beyond which the origin moves, in natural lengths.
pub(super) const FAR: f64 = 1024.0;
/// Bit mask that keeps sign and exponent of a double.
const SIGN_AND_EXPONENT: u64 = 0xfff0_0000_0000_0000;

/// Moves the origins of coordinates that are more than [`FAR`] natural lengths away. Returns whether any origin has moved.
///
/// Only coordinates on which nothing but contacts depends have movable origins. The integrator must restart afterwards.
#[inline]
pub(super) fn shift(model: &Model, state: &mut State) -> bool {
    let is_far = |(free, x): (&Free, &f64)| free.travels && x.abs() > FAR * free.scale.0;
    if !model.free.iter().zip(&state.y).any(is_far) {
        return false;
    }
    for (i, free) in model.free.iter().enumerate() {
        if is_far((free, &state.y[i])) {
            shift_one(model, state, i);
        }
    }
    true
}

/// Moves one origin by the largest power of two up to the position, so that no sum is rounded.
#[inline(never)]
fn shift_one(model: &Model, state: &mut State, i: usize) {
    // Without its fraction a number is a power of two, so x - by and shift + by are exact.
    let by = f64::from_bits(state.y[i].to_bits() & SIGN_AND_EXPONENT);
    state.y[i] -= by;
    state.shifts[i] += by;
    for (c, contact) in model.contacts.iter().enumerate() {
        let along: f64 = contact.u.free.iter().filter(|(free, _)| *free == i).map(|(_, a)| a).sum();
        if along != 0.0 {
            state.shift_law(c, -along * by);
        }
    }
}
