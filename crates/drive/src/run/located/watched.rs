//! Event functions that can end an interval.

use super::watch::Fallen;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::interval::Closed;
use stickslip_contact::Guard;

/// Event function of a component.
///
/// The event function of a contact with a closed-form force is linear in the state. For another contact it is a function of the contact's
/// motion; a block defines its own event functions.
#[derive(Clone, Copy)]
pub(super) enum Watched<'e> {
    Closed(&'e Closed<'e>, Guard),
    Contact(usize, &'e Contact, Guard),
    Block(usize, usize),
}

impl<'e> Watched<'e> {
    /// Calls `act` for the event functions of all components that can end the step.
    ///
    /// Contacts with closed-form forces are included only if their index is in `near`.
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

    /// Returns the component and the event function as a [`Fallen`], which identifies a zero crossing.
    pub(super) fn fallen(self) -> Fallen {
        match self {
            Self::Closed(steady, guard) => Fallen::Contact(steady.index, guard),
            Self::Contact(index, _, guard) => Fallen::Contact(index, guard),
            Self::Block(k, guard) => Fallen::Block(k, guard),
        }
    }

    /// Whether the function inside a step does not follow from values and rates at both ends of the step.
    pub(super) fn is_sampled(self) -> bool {
        match self {
            Self::Closed(..) => false,
            Self::Contact(_, contact, _) => contact.press.waveform().is_some(),
            Self::Block(..) => true,
        }
    }
}
