//! Where a motion has no derivative: at turns that are as good as none, and at rest.

use super::parameter::Moment;
use super::{Variation, VariationError};
use crate::contact::{Contact, Mode};
use crate::equations::{Components, Equations};
use crate::state::State;
use stickslip_stepper::System;

impl Variation<'_> {
    /// Whether every edge that turned between two laws of one moment has turned for good: with an acceleration.
    pub(super) fn check_turns(&self, left: &State, state: &State) -> Result<(), VariationError> {
        // At a corner velocities jump, at a time that nothing moves.
        if left.pieces != state.pieces {
            return Ok(());
        }
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let turned = match (&left.modes[c], &state.modes[c]) {
                (Mode::Slip(before), Mode::Slip(after)) => before.sense() != after.sense(),
                _ => false,
            };
            // What no free coordinate moves turns at a time that nothing moves.
            if turned && !contact.u.free.is_empty() && self.stands(contact, state, f64::INFINITY) {
                return Err(VariationError::Grazes { contact: contact.name.clone(), t: state.t });
            }
        }
        Ok(())
    }

    /// Whether no contact rests that holds and numbers move: to either side it would answer with another stiffness.
    pub(super) fn check_rest(&self, state: &State) -> Result<(), VariationError> {
        let holds = |(c, contact): &(usize, &Contact)| {
            matches!(&state.modes[*c], Mode::Slip(branch) if !branch.is_gross())
                && !contact.inert
                && !contact.u.free.is_empty()
        };
        let mut holding = self.model.contacts.iter().enumerate().filter(holds);
        let stops =
            |contact: &Contact| self.stands(contact, state, self.tolerance) && self.moves(contact, state);
        match holding.find(|(_, contact)| stops(contact)) {
            Some((_, contact)) => Err(VariationError::Grazes { contact: contact.name.clone(), t: state.t }),
            None => Ok(()),
        }
    }

    /// Whether a number makes a contact slide: where all rest with it no stiffness is asked for.
    fn moves(&self, contact: &Contact, state: &State) -> bool {
        let slow = self.tolerance.sqrt() * contact.natural_velocity();
        let first = self.count() - self.parameters.len();
        (0..self.count()).any(|j| {
            let Some(column) = self.column(j) else { return true };
            let own: f64 = contact.u.free.iter().map(|(i, a)| a * column[self.layout.velocity(*i)]).sum();
            let number = j.checked_sub(first).map(|place| &self.parameters[place]);
            let shift = number.map_or(0.0, |number| number.shift(contact, Moment::of(self.model, state)).du);
            (own + shift).abs() > slow || (own + shift).is_nan()
        })
    }

    /// Whether a contact slides by less than `slow` and is about to by next to nothing, both in natural scales.
    ///
    /// A turn with the acceleration a is one for all motions nearer than a²: where these are within the tolerance it may as
    /// well be none.
    fn stands(&self, contact: &Contact, state: &State, slow: f64) -> bool {
        let eq = Equations::on(self.model, state, self.layout, false);
        let (mut slopes, at) = (vec![0.0; self.layout.total()], |i: usize| state.y[i]);
        eq.slopes(state.t, &state.y, &mut slopes);
        let pull = eq
            .acceleration(&contact.u, &Components { t: state.t, y: at }, |i| slopes[self.layout.velocity(i)]);
        let speed = contact.natural_velocity();
        eq.motion(contact, state.t, at).du.abs() <= slow * speed
            && pull.abs() <= self.tolerance.sqrt() * speed * contact.natural.frequency
    }
}
