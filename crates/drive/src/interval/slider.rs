//! Single slider whose contacts have closed-form forces.
//!
//! For one coordinate, the height of every slip front is linear in time and position. The acceleration is a constant plus one reduced force
//! M per contact in partial slip.

use stickslip_contact::Profile;

/// Constants of a single slider whose contacts have closed-form forces: acceleration a₀ + Σ a M(h_c) and input power P₀ + Σ P M(h_c),
/// summed over the contacts in partial slip.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Slider {
    /// a₀, m/s².
    pub(crate) acceleration: f64,
    /// P₀, W.
    pub(crate) power: f64,
}

/// Contribution of a contact in partial slip to the acceleration of a single slider.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull<'a> {
    /// Index among the contacts.
    pub(super) index: usize,
    pub(super) profile: &'a Profile,
    /// Coefficients of the slip-front height h_c = front + advance (t - start) + lean · x.
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
    /// Returns the reduced force M at the slip front, m².
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
