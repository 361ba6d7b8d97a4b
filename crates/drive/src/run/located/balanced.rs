//! Coordinates without mass in a run: when nothing balances them any more, and when their places are states.

use super::Located;
use crate::RunError;
use crate::contact::Mode;
use crate::equations::{Equations, Instant};
use crate::scene::Axis;
use crate::state::State;
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Fails where nothing balances a coordinate any more: all that acts along it slips, or has parted.
    pub(super) fn check_balance(&self, state: &State) -> Result<(), RunError> {
        let (model, equations) = (self.setting.model, self.setting.plain(state));
        let at = Instant { t: state.t, y: &|i| state.y[i] };
        for b in 0..model.balanced.len() {
            let along = model.balanced[b].axis;
            let gone = |c: usize| match along {
                Axis::Z => state.modes[c] == Mode::Open,
                _ => state.modes[c].has_given_way(&model.contacts[c]),
            };
            if let Some(forces) = equations.given_way(b, &at, gone) {
                return Err(model.unbalanced(b, state.t, forces));
            }
        }
        Ok(())
    }

    /// The place of a balanced coordinate becomes a state where the first of its contacts grows: it begins where that stands.
    pub(super) fn carry(&self, state: &mut State, c: usize) {
        let model = self.setting.model;
        if state.modes[c] != Mode::Grow {
            return;
        }
        for balanced in model.balanced.iter().filter(|b| b.axis == Axis::X) {
            let joined = balanced.contacts.iter().find(|(own, _)| *own == c);
            let (Some((_, a)), Some(slot)) = (joined, balanced.slot) else { continue };
            let carried = |(other, _): &(usize, f64)| *other != c && state.modes[*other] == Mode::Grow;
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
