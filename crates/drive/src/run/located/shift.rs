//! Coordinates that travel: counted from near by, so that a million periods cost no digit.
//!
//! u of a contact is the difference of a place that travels without end and of a memory that travels with it;
//! counted from the start it would lose a digit with every tenfold of the way. The origin moves along by
//! powers of two, so that no sum is rounded, and memories and branches of the contacts on that coordinate
//! with it. Steps of the benchmark drive stay constant to 2e-10 over a million periods, the last place of
//! what is written.

use crate::Model;
use crate::model::Free;
use crate::state::State;

/// A coordinate this many natural lengths away from its origin takes it along.
// Two thousand periods of P1 at 1e-9: an error of 4e-11 u_c; shifted at ten times the distance 5e-10.
pub(super) const FAR: f64 = 1024.0;
/// What is left of a double without its fraction.
const SIGN_AND_EXPONENT: u64 = 0xfff0_0000_0000_0000;

/// Moves the origins of coordinates that have travelled far. Due before a restart.
///
/// Far is 1 024 natural lengths of the coordinate; only one that counts against nothing but the other side of
/// its contacts travels. Tells whether any has been moved.
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

/// Moves one origin by the power of two next below the position: no sum is rounded.
#[inline(never)]
fn shift_one(model: &Model, state: &mut State, i: usize) {
    // Without its fraction a number is the power of two below it: x - by and shift + by are exact.
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
