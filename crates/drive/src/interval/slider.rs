//! A single slider among contacts of closed form.
//!
//! With one coordinate every height of a slip front is a straight function of time and place, so that an acceleration is a
//! constant and one M per contact in partial slip: no loop over coordinates, no measure, no memory is left.

use stickslip_contact::Profile;

/// A single slider among contacts of closed form: its acceleration is a₀ + Σ a M(h_c) and the power put in P₀ + Σ P M(h_c), over
/// the contacts in partial slip.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Slider {
    /// a₀, m/s².
    pub(crate) acceleration: f64,
    /// P₀, W.
    pub(crate) power: f64,
}

/// What a contact in partial slip adds to a single slider. Kept so that as little as can be waits for the position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull<'a> {
    /// Its place among the contacts.
    pub(super) index: usize,
    pub(super) profile: &'a Profile,
    /// h_c = front + advance (t - start) + lean · x.
    pub(super) front: f64,
    pub(super) advance: f64,
    pub(super) start: f64,
    pub(super) lean: f64,
    /// a, 1/(m s²).
    pub(crate) acceleration: f64,
    /// P, W/m².
    pub(crate) power: f64,
}

impl Pull<'_> {
    /// M at the slip front, m².
    #[inline(always)]
    pub(crate) fn reduced_force(&self, t: f64, x: f64) -> f64 {
        self.profile.reduced_force(self.height(t, x))
    }

    /// Height of the slip front, m.
    #[inline(always)]
    pub(super) fn height(&self, t: f64, x: f64) -> f64 {
        (self.front + self.advance * (t - self.start)) + self.lean * x
    }
}
