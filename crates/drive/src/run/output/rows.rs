//! Rows of springs that come to slip as a whole, or to stick again.
//!
//! Steps end at changes of single springs, or at none, and no such change is an event. That the last spring gives way is told to the
//! record all the same; the run does not know of it. Under a normal that moves it is told at its moment, under a constant one at the end
//! of the step in which it comes.

use crate::contact::{Contact, Mode};
use crate::event::{EventKind, Source};
use crate::model::Model;
use crate::state::State;
use stickslip_contact::{Memory, SpringRow, SpringState};

/// The rows of a run, and whether each of them slips as a whole.
#[derive(Debug, Default)]
pub(in crate::run) struct Rows(Vec<(usize, bool)>);

impl Rows {
    /// The same room with nothing to watch.
    pub(super) fn renewed(mut self) -> Self {
        self.0.clear();
        self
    }

    /// Watches the rows of a model.
    pub(super) fn begin(&mut self, model: &Model) {
        self.0.clear();
        let rows = model.contacts.iter().filter(|contact| !contact.inert && !contact.engine.branches());
        self.0.extend(rows.map(|contact| (contact.place, false)));
    }

    /// Looks at them before a step.
    // And not only after the one before: a run that is taken up here knows no more than the state.
    pub(in crate::run) fn look(&mut self, model: &Model, state: &State) {
        self.0.iter_mut().for_each(|(c, slipping)| *slipping = slips(&model.contacts[*c], state));
    }

    /// Whether there are any.
    #[inline(always)]
    pub(in crate::run) fn any(&self) -> bool {
        !self.0.is_empty()
    }

    /// How many there are.
    pub(in crate::run) fn count(&self) -> usize {
        self.0.len()
    }

    /// What the row at place `k` has come to in the step.
    pub(in crate::run) fn news(
        &mut self,
        k: usize,
        model: &Model,
        state: &State,
    ) -> Option<(Source, EventKind)> {
        let (c, was) = self.0[k];
        let now = slips(&model.contacts[c], state);
        self.0[k].1 = now;
        let kind = match (was, now) {
            (false, true) => EventKind::GrossSlip,
            (true, false) if state.modes[c] != Mode::Open => EventKind::GrossSlipEnds,
            _ => return None,
        };
        Some((Source::Contact(c), kind))
    }

    /// What an event in the step is called of a row that slips as a whole until then.
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

/// Whether every spring that touches slips in the sense in which the row is led.
fn slips(contact: &Contact, state: &State) -> bool {
    let law = &contact.interface;
    match (&state.modes[contact.place], &state.memories[contact.place]) {
        (Mode::Lull { lull, .. }, _) => lull.sense() != 0.0 && lull.stiffness(law) == 0.0,
        // Where it turns all are at their limits still.
        (Mode::Whole { sense }, Memory::Row(SpringRow { row, springs })) => match row.lowest(springs, law) {
            SpringState::SlipForward => *sense >= 0.0,
            SpringState::SlipBackward => *sense <= 0.0,
            SpringState::Open | SpringState::Stick => false,
        },
        _ => false,
    }
}
