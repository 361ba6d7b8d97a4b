//! Gross slip of spring rows, as events for the record.
//!
//! Changes of single springs are no events, even if they end steps. Start and end of gross slip of a whole row are reported to the record;
//! the run does not use them. Under a varying normal force they are reported at their own times, under a constant normal force at the end
//! of the step.

use crate::contact::Contact;
use crate::event::{EventKind, Source};
use crate::model::Model;
use crate::state::State;
use stickslip_contact::{Memory, SpringRow, SpringState};

/// Spring rows of a run, each with its contact and whether it is in gross slip.
#[derive(Debug, Default)]
pub(in crate::run) struct Rows(Vec<(usize, bool)>);

impl Rows {
    /// Returns an empty list in the same storage.
    pub(super) fn renewed(mut self) -> Self {
        self.0.clear();
        self
    }

    /// Selects the spring rows of a model.
    pub(super) fn begin(&mut self, model: &Model) {
        self.0.clear();
        let rows = model.contacts.iter().filter(|contact| !contact.inert && !contact.engine.branches());
        self.0.extend(rows.map(|contact| (contact.place, false)));
    }

    /// Stores the slip states of all rows before a step.
    // Read from the state, because a continued run has no earlier step.
    pub(in crate::run) fn look(&mut self, model: &Model, state: &State) {
        self.0.iter_mut().for_each(|(c, slipping)| *slipping = slips(&model.contacts[*c], state));
    }

    /// Whether the model has spring rows.
    #[inline(always)]
    pub(in crate::run) fn any(&self) -> bool {
        !self.0.is_empty()
    }

    /// Returns the number of spring rows.
    pub(in crate::run) fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the event of row `k` in the step: start or end of gross slip.
    pub(in crate::run) fn news(
        &mut self,
        k: usize,
        model: &Model,
        state: &State,
    ) -> Option<(Source, EventKind)> {
        let (c, was) = self.0[k];
        let now = slips(&model.contacts[c], state);
        self.0[k].1 = now;
        // A row with two coefficients has events of its own.
        let kind = match (was, now) {
            _ if model.contacts[c].interface.kinetic().is_some() => return None,
            (false, true) => EventKind::GrossSlip,
            (true, false) if !state.modes[c].is_open() => EventKind::GrossSlipEnds,
            _ => return None,
        };
        Some((Source::Contact(c), kind))
    }

    /// Returns the kind under which an event is reported: for a reversal of a row in gross slip, the end of gross slip.
    pub(in crate::run) fn told(&mut self, source: Source, kind: EventKind) -> EventKind {
        let row = self.0.iter_mut().find(|(c, slips)| *slips && source == Source::Contact(*c));
        match (row, kind) {
            (Some((_, slips)), EventKind::Reversal) => {
                *slips = false;
                EventKind::GrossSlipEnds
            }
            _ => kind,
        }
    }
}

/// Whether every closed spring of the contact slips in the sliding direction.
fn slips(contact: &Contact, state: &State) -> bool {
    let law = &contact.interface;
    let mode = &state.modes[contact.place];
    match (mode.lull(), &state.memories[contact.place]) {
        (Some(lull), _) => lull.sense() != 0.0 && lull.stiffness(law) == 0.0,
        // At a reversal all springs are still at their limits.
        (None, Memory::Row(SpringRow { row, springs })) if mode.is_whole() => {
            match row.lowest(springs, law) {
                SpringState::SlipForward => mode.sense() >= 0.0,
                SpringState::SlipBackward => mode.sense() <= 0.0,
                SpringState::Open | SpringState::Stick => false,
            }
        }
        _ => false,
    }
}
