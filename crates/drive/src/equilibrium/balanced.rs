//! Positions of quasi-static (massless, "balanced") coordinates at t = 0.
//!
//! At first, bodies and contacts are in the state that they would have without loads. Then all loads of t = 0 act, and every contact moves
//! on a straight path to equilibrium in zero time. The energy balance begins afterwards.

use crate::contact::Contact;
use crate::equations::{Equations, Instant};
use crate::model::Model;
use crate::scene::Axis;
use crate::state::State;
use crate::{Field, Part, SceneError, SceneFault};
use stickslip_contact::Segment;

impl Model {
    /// Moves bodies with quasi-static coordinates to their equilibrium at t = 0.
    ///
    /// Fails with [`SceneFault::Unbalanced`] if no force balances the loads.
    pub(super) fn balance_first(&self, state: &mut State) -> Result<(), SceneError> {
        if self.balanced.is_empty() {
            return Ok(());
        }
        let equations = Equations::on(self, state, self.layout());
        if let Some((b, [load, limit])) = equations.overloaded(0.0, &|i| state.y[i]) {
            let (part, axis) = (Part::Body(self.balanced[b].body), self.balanced[b].axis);
            return Err(SceneFault::Unbalanced { axis, load, limit }.of(part, Field::Coordinate(axis)));
        }
        let apex = |contact: &Contact| equations.motion(contact, 0.0, |i| state.y[i]).apex();
        let places: Vec<_> = self.contacts.iter().map(|c| c.balanced.then(|| apex(c))).collect();
        for ((contact, memory), place) in self.contacts.iter().zip(&mut state.memories).zip(places) {
            if let Some(to) = place {
                let refused =
                    |source| SceneFault::Settling(source).of(Part::Contact(contact.place), Field::Whole);
                memory.commit(&contact.interface, Segment::Jump(to)).map_err(refused)?;
            }
        }
        Ok(())
    }
}

impl Equations<'_> {
    /// Returns the first quasi-static coordinate whose load exceeds the limit force of its contacts, with load and limit, N.
    pub(crate) fn overloaded(&self, t: f64, y: &dyn Fn(usize) -> f64) -> Option<(usize, [f64; 2])> {
        let at = Instant { t, y };
        (0..self.model.balanced.len()).find_map(|b| {
            let [load, limit] = self.given_way(b, &at, |_| true)?;
            let holds = match self.model.balanced[b].axis {
                Axis::Z => self.presses(b, &at, 0.0),
                // At the limit itself the contacts slip.
                _ => load.abs() < limit || load == 0.0,
            };
            (!holds).then_some((b, [load, limit]))
        })
    }
}
