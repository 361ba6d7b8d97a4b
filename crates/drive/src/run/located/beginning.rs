//! Where an interval between two events begins.
//!
//! After most events only the contacts that fired have another law, and the interval takes up those; after a corner, a moved
//! origin and events of blocks it is made anew.

use super::Located;
use super::watch::Fallen;
use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::state::{Grip, State};
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// What is known until the next event: forms of contacts, the method, and whether anything holds.
    pub(super) fn begin_interval(&mut self, state: &mut State) {
        self.interval.begin(self.setting.model, state);
        self.count_interval(state);
    }

    /// The same where nothing but the laws of the contacts that fired has changed; false, with nothing done, where it has.
    pub(super) fn renew_interval(&mut self, state: &mut State) -> bool {
        let of_contact = |fallen: &Fallen| matches!(fallen, Fallen::Contact(..));
        let contacts = self.watch.fired.iter().filter_map(|fallen| match fallen {
            Fallen::Contact(c, _) => Some(*c),
            Fallen::Block(..) => None,
        });
        let renews = self.watch.fired.iter().all(of_contact)
            && self.interval.renew(self.setting.model, state, contacts);
        if renews {
            self.count_interval(state);
        }
        renews
    }

    /// Nothing is under way in it yet.
    fn count_interval(&mut self, state: &mut State) {
        self.takeoff = None;
        self.interval.count(&mut state.tally);
        let (model, modes) = (self.setting.model, &state.modes);
        let presses =
            |(mode, contact): (&Mode, &Contact)| *mode != Mode::Open && contact.coupling().is_some();
        // Without contacts, and while all of them slip, links and bodies on what they press swing on: their steps must damp all the same.
        let holds = modes.iter().any(Mode::holds)
            || modes.is_empty()
            || !model.links.is_empty()
            || modes.iter().zip(&model.contacts).any(presses);
        self.motion.pace.gait.grip = if holds { Grip::Sticks } else { Grip::Slips };
    }
}
