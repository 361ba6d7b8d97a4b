//! What the contacts commit of an accepted step: the only place where memories move.

use crate::RunError;
use crate::model::Model;
use crate::state::{Layout, State};
use stickslip_contact::Segment;

/// What the contacts commit.
pub(super) struct Ledger {
    /// Contacts, by their places, and the segments that lead them to the end of the step.
    pub(super) segments: Vec<(usize, Segment)>,
    pub(super) books: Books,
}

/// Where the memories of steady contacts are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Books {
    /// Where the state is.
    Current,
    /// At the last event.
    Behind,
}

impl Ledger {
    /// Room for a segment of every contact, and `more`.
    pub(super) fn new(model: &Model, more: usize) -> Self {
        Self { segments: Vec::with_capacity(model.contacts.len() + more), books: Books::Current }
    }

    /// All contacts move their memory to where the step ended, at time t, s.
    pub(super) fn commit(
        &self,
        (model, layout): (&Model, Layout),
        t: f64,
        state: &mut State,
    ) -> Result<(), RunError> {
        for &(c, segment) in &self.segments {
            let contact = &model.contacts[c];
            let friction = state.memories[c]
                .commit(&contact.law, segment)
                .map_err(|source| RunError::Contact { t, contact: contact.name.clone(), source })?;
            // Where the friction of a growing contact is an integral it is no work of its commits.
            if contact.slot.is_none() || layout.growing == 0 {
                state.friction[c] += contact.count * friction;
            }
            state.grew[c] = matches!(segment, Segment::Grown { .. });
        }
        Ok(())
    }
}
