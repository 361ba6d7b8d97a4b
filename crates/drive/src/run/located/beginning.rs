//! Start of an interval between two events.
//!
//! After most events, only contacts with a zero crossing have a new law, and the interval is updated for these contacts. After a corner, a
//! moved origin or a block event the interval is built again.

use super::Located;
use super::watch::Fallen;
use crate::contact::Contact;
use crate::equations::Equations;
use crate::state::{Grip, State};
use stickslip_contact::Law;
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Builds the interval until the next event: closed forms of contacts, integration method, and whether any contact sticks.
    pub(super) fn begin_interval(&mut self, state: &mut State) {
        self.interval.begin(self.setting.model, state);
        self.count_interval(state);
    }

    /// Updates the interval if only laws of contacts have changed. Otherwise returns false and does nothing.
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

    /// Counts the interval, ends any closed-form step and determines whether any contact sticks.
    fn count_interval(&mut self, state: &mut State) {
        self.takeoff = None;
        self.interval.count(&mut state.tally);
        let (model, modes) = (self.setting.model, &state.modes);
        let presses = |(law, contact): (&Law, &Contact)| !law.is_open() && contact.coupling().is_some();
        // Links and bodies that press contacts oscillate also during slip, so the stability limit applies to their steps.
        let holds = modes.iter().any(Law::holds)
            || modes.is_empty()
            || !model.links.is_empty()
            || modes.iter().zip(&model.contacts).any(presses);
        self.motion.pace.gait.grip = if holds { Grip::Sticks } else { Grip::Slips };
    }
}
