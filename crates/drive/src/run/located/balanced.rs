//! Quasi-static coordinates (without mass) in a run: loss of equilibrium, and positions as states.

use super::Located;
use crate::RunError;
use crate::equations::{Equations, Instant};
use crate::scene::Axis;
use crate::state::State;
use stickslip_stepper::Attempt;

/// Rounding error of a load at the located separation of a body, as a fraction of the largest load.
const PARTING: f64 = 1e-9;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Fails if a quasi-static coordinate has no equilibrium any more: all its contacts slip or are open.
    pub(super) fn check_balance(&self, state: &State) -> Result<(), RunError> {
        let (model, equations) = (self.setting.model, self.setting.plain(state));
        let at = Instant { t: state.t, y: &|i| state.y[i] };
        for b in 0..model.balanced.len() {
            let along = model.balanced[b].axis;
            let gone = |c: usize| match along {
                Axis::Z => state.modes[c].is_open(),
                _ => state.modes[c].has_given_way(&model.contacts[c]),
            };
            // A load that begins at 0 N has not pressed yet.
            let sets_out = || along == Axis::Z && equations.presses(b, &at, self.rounding_of(b));
            if let Some(forces) = equations.given_way(b, &at, gone).filter(|_| !sets_out()) {
                return Err(model.unbalanced(b, state.t, forces));
            }
        }
        Ok(())
    }

    /// Returns the latest time up to `to` (s) at which every quasi-static coordinate has an equilibrium under the full force law.
    ///
    /// Later no equilibrium position exists, and no contact law shows it. Loads and holding forces depend on time only.
    ///
    /// Fails if the result is at most `least` (s) ahead, because positions then change faster than any step resolves.
    pub(super) fn until_overloaded(&self, state: &State, to: f64, least: f64) -> Result<f64, RunError> {
        let (model, equations, from) = (self.setting.model, self.setting.plain(state), state.t);
        let over = |t: f64| equations.overloaded(t, &|i| state.y[i]);
        let tried = [from + 0.5 * (to - from), to];
        let Some(mut high) = tried.into_iter().find(|t| over(*t).is_some()) else { return Ok(to) };
        let mut low = from;
        loop {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                break;
            }
            if over(middle).is_some() { high = middle } else { low = middle }
        }
        match over(high) {
            Some((b, forces)) if low <= from => Err(model.unbalanced(b, from, forces)),
            Some((b, forces)) if low - from <= least => Err(model.unbalanced(b, high, forces)),
            _ => Ok(low),
        }
    }

    /// Returns the rounding error of a load when the last contact separates, N.
    fn rounding_of(&self, b: usize) -> f64 {
        let model = self.setting.model;
        let force = |(c, _): &(usize, f64)| {
            let contact = &model.contacts[*c];
            contact.count * contact.interface.normal_force(contact.natural.depth)
        };
        PARTING * model.balanced[b].contacts.iter().map(force).sum::<f64>()
    }

    /// Makes the position of a quasi-static coordinate a state when its first contact begins to grow in full stick.
    ///
    /// The initial value of this state is the current position.
    pub(super) fn carry(&self, state: &mut State, c: usize) {
        let model = self.setting.model;
        if !state.modes[c].grows() {
            return;
        }
        for balanced in model.balanced.iter().filter(|b| b.axis == Axis::X) {
            let joined = balanced.contacts.iter().find(|(own, _)| *own == c);
            let (Some((_, a)), Some(slot)) = (joined, balanced.slot) else { continue };
            let carried = |(other, _): &(usize, f64)| *other != c && state.modes[*other].grows();
            if balanced.contacts.iter().any(carried) {
                continue;
            }
            let at = Instant { t: state.t, y: &|i| state.y[i] };
            let rest = self.setting.plain(state).rest_along(c, &at);
            let place = a * (state.memories[c].apex().u - rest);
            state.y[self.setting.layout.balanced(slot)] = place;
        }
    }
}
