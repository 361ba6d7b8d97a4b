//! Single slider with contacts of closed form.
//!
//! With one coordinate the height of every slip front is linear in time and position. An acceleration is a constant plus one M
//! per contact in partial slip.

use stickslip_contact::Profile;

/// Single slider with contacts of closed form. Its acceleration is a₀ + Σ a M(h_c) and its input power P₀ + Σ P M(h_c), over the
/// contacts in partial slip.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Slider {
    /// a₀, m/s².
    pub(crate) acceleration: f64,
    /// P₀, W.
    pub(crate) power: f64,
}

/// Contribution of a contact in partial slip to a single slider.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull<'a> {
    /// Index among the contacts.
    pub(super) index: usize,
    pub(super) profile: &'a Profile,
    /// Coefficients of h_c = front + advance (t - start) + lean · x.
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
    /// Returns M at the slip front, m².
    #[inline(always)]
    pub(crate) fn reduced_force(&self, t: f64, x: f64) -> f64 {
        self.profile.reduced_force(self.height(t, x))
    }

    /// Returns the height of the slip front, m.
    #[inline(always)]
    pub(super) fn height(&self, t: f64, x: f64) -> f64 {
        (self.front + self.advance * (t - self.start)) + self.lean * x
    }
}
