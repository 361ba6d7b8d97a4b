//! Rest: what rounding leaves of it must neither ring nor grow.

use super::Run;
use crate::equations::Equations;
use crate::model::Free;
use crate::state::State;
use stickslip_stepper::{Attempt, End};

/// Velocities this small, relative to the natural ones, are rounding: some hundred of their last places.
const REST: f64 = 1e-13;
/// Largest product of step and rate at rest. Long steps multiply rounding by their many large coefficients.
const REST_REACH: f64 = 1.0;

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// Longest step from here, s. Where something holds, a swing below the tolerance must die away instead of being
    /// nursed up to it, and one of the size of rounding must not be fed by more of it.
    pub(super) fn longest_now(&self) -> f64 {
        if !self.holds {
            return self.longest;
        }
        let reach = if self.rests { REST_REACH } else { self.solver.stability_limit() };
        self.longest.min(reach / self.model.fastest)
    }

    /// Whether all that is free is at rest but for rounding: velocities that some step has left, and accelerations that
    /// will not make more of them.
    pub(super) fn is_at_rest(&self, state: &State) -> bool {
        let velocity = |i: usize| self.layout.velocity(i);
        let still = |(i, free): (usize, &Free)| {
            let ((length, speed), pull) = (free.scale, self.solver.slope(velocity(i), End::Start));
            state.y[velocity(i)].abs() <= REST * speed && pull.abs() * length <= REST * speed * speed
        };
        self.model.free.iter().enumerate().all(still)
    }

    /// Takes away what rounding has left of the velocities: it would add up over a long rest.
    pub(super) fn stop(&mut self, state: &mut State) {
        let velocities = self.layout.free..2 * self.layout.free;
        if state.y[velocities.clone()].iter().any(|v| *v != 0.0) {
            state.y[velocities].fill(0.0);
            self.restart(state);
        }
    }
}
