//! The guards that can end an interval.

use super::watch::Fallen;
use crate::contact::{Contact, Guard};
use crate::equations::Equations;
use crate::interval::Closed;

/// A guard that is watched: of a contact of closed form a straight function of the state, of any other one a function of its motion,
/// of a block whatever that says.
#[derive(Clone, Copy)]
pub(super) enum Watched<'e> {
    Closed(&'e Closed<'e>, Guard),
    Contact(usize, &'e Contact, Guard),
    Block(usize, usize),
}

impl<'e> Watched<'e> {
    /// Does something with the guards of all components that can end the step: of contacts of closed form those at the places `near`.
    #[inline(always)]
    pub(super) fn each(eq: &Equations<'e>, near: &[usize], mut act: impl FnMut(Self)) {
        let Some(interval) = eq.interval else { return };
        for &place in near {
            let steady = &interval.closed[place];
            steady.guards.iter().for_each(|guard| act(Self::Closed(steady, *guard)));
        }
        for index in interval.open_form() {
            let contact = &eq.model.contacts[index];
            for &guard in Guard::of(contact, &eq.modes[index]) {
                act(Self::Contact(index, contact, guard));
            }
        }
        for (k, wired) in eq.model.blocks.iter().enumerate() {
            for &guard in wired.block().guards(&eq.blocks[k].law) {
                act(Self::Block(k, guard));
            }
        }
    }

    /// What falls with it.
    pub(super) fn fallen(self) -> Fallen {
        match self {
            Self::Closed(steady, guard) => Fallen::Contact(steady.index, guard),
            Self::Contact(index, _, guard) => Fallen::Contact(index, guard),
            Self::Block(k, guard) => Fallen::Block(k, guard),
        }
    }

    /// Whether its course inside a step is no polynomial of low degree that its rates at both ends would tell.
    pub(super) fn is_sampled(self) -> bool {
        match self {
            Self::Closed(..) => false,
            Self::Contact(_, contact, _) => contact.press.waveform().is_some(),
            Self::Block(..) => true,
        }
    }
}
