//! Transfer of a state to another model of the same structure.

use super::legs::take_over;
use super::{Section, Unknown};
use crate::equations::Equations;
use crate::state::Counts;
use crate::{Model, State};

impl Section<'_> {
    /// Returns a state at this section as a state of model `to` at time t (s), with section coordinates changed by the amounts `by`. Free
    /// coordinates, velocities, states of blocks and the form of slip memories are kept. Prescribed motions are those of `to`.
    ///
    /// The energy balance is that of the original state. None if the models differ in structure, if a contact is closed in one model only,
    /// or if no slip memory has the changed coordinates.
    #[must_use]
    pub fn elsewhere(&self, state: &State, by: &[f64], to: &Model, t: f64) -> Option<State> {
        let (from, layout) = (self.model, to.layout());
        if !to.is_alike(from) {
            return None;
        }
        let mut before = state.clone();
        before.come_back(from);
        before.carry_over(from, layout);
        (before.underway, before.counts) = (None, Counts::default());
        before.tally.clear(to.contacts.len());
        let mut taken = before.clone();
        taken.t = t;
        for (piece, waveform) in taken.pieces.iter_mut().zip(&to.waveforms) {
            if waveform.generator().is_none() && waveform.interpolation().is_none() {
                *piece = waveform.piece_at(t);
            }
        }
        for (unknown, by) in self.unknowns.iter().zip(by) {
            match *unknown {
                Unknown::Place(i) => taken.y[i] += by,
                Unknown::Speed(i) => taken.y[layout.velocity(i)] += by,
                Unknown::Own(k) => taken.y[layout.block(k)] += by,
                Unknown::Height(..) | Unknown::Slope(..) => {}
            }
        }
        for (c, contact) in to.contacts.iter().enumerate() {
            let other = &from.contacts[c];
            let was = Equations::on(from, &before, layout).motion(other, before.t, |i| before.y[i]);
            let is = Equations::on(to, &taken, layout).motion(contact, t, |i| taken.y[i]);
            let numbers = self.unknowns.iter().zip(by).map(|(unknown, by)| (*unknown, *by));
            if (is.d > 0.0) != (was.d > 0.0) {
                return None;
            }
            let gone = (is.d - was.d, is.u - was.u);
            taken.memories[c] = take_over((contact, other), &before.memories[c], gone, numbers)?;
            taken.renew_law(to, c, gone.1);
        }
        Some(taken)
    }
}

impl Model {
    /// Whether the states of both models have the same structure.
    pub(crate) fn is_alike(&self, other: &Self) -> bool {
        let form = |model: &Self| {
            let blocks: Vec<usize> = model.blocks.iter().map(|block| block.count()).collect();
            let waveforms = model.waveforms.len();
            (model.free.len(), model.contacts.len(), model.growing, model.balanced.len(), blocks, waveforms)
        };
        form(self) == form(other)
    }
}
