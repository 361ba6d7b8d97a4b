//! Stored energy, whose change gives the work of a waveform jump.

use crate::contact::Contact;
use crate::equations::Equations;
use crate::record;
use crate::state::State;
use stickslip_contact::Memory;

/// Returns the energy of contacts, springs and actuators at the committed state, J, without that of a prescribed normal load.
pub(super) fn stored(eq: &Equations<'_>, state: &State) -> f64 {
    let energy = |(contact, memory): (&Contact, &Memory)| {
        let apex = memory.apex();
        // The work of a prescribed load equals its stored energy, which follows from the current indentation.
        let normal = match contact.coupling() {
            Some(_) if contact.normal_damping > 0.0 => eq.normal_energy(contact, state.t, |i| state.y[i]),
            Some(_) => contact.interface.normal_energy(apex.d),
            None => 0.0,
        };
        contact.count * (normal + memory.preview(&contact.interface, apex).elastic)
    };
    let contacts = eq.model.contacts.iter().zip(&state.memories).map(energy);
    let links = eq.model.links.iter().map(|l| record::link_energy(eq, l, state.t, &|i| state.y[i]));
    contacts.sum::<f64>() + links.sum::<f64>()
}
