//! Waveforms that nothing follows.

use super::{Balanced, Binding, Body, Link, Load, Stroke, Wire, Wired};
use crate::Waveform;
use crate::contact::Contact;

/// Holds all waveforms still that nothing follows: their corners would end steps for nothing. Gives their places.
///
/// Followed is what a body, a stroke, a contact's load, a load or a block reads.
pub(super) fn hold_the_others(
    waveforms: &mut [Waveform],
    (bodies, blocks): (&[Body], &[Wired]),
    contacts: &[Contact],
    links: &[Link],
    (loads, balanced): (&[Load], &[Balanced]),
) -> Vec<usize> {
    let mut used = vec![false; waveforms.len()];
    let places = bodies.iter().flat_map(|body| body.bindings).filter_map(|place| match place {
        Binding::Driven(w) => Some(w),
        Binding::Held(_) | Binding::Free(_) => None,
    });
    let strokes = links.iter().filter_map(|link| match link.stroke {
        Stroke::Driven(w) => Some(w),
        Stroke::Constant(_) => None,
    });
    let pressing = contacts.iter().filter_map(|contact| contact.press.waveform());
    let balancing = balanced.iter().flat_map(|b| b.pull.loads.iter().map(|(w, _)| *w));
    let pulling = loads.iter().map(|load| load.waveform).chain(balancing);
    let read = blocks.iter().flat_map(|block| &block.wires).filter_map(|wire| match wire {
        Wire::Signal(w) => Some(*w),
        Wire::Length(_) => None,
    });
    let all = places.chain(strokes).chain(pressing).chain(pulling).chain(read);
    // Signals beyond the waveforms are blocks'.
    all.filter(|w| *w < used.len()).collect::<Vec<_>>().into_iter().for_each(|w| used[w] = true);
    let idle: Vec<usize> = (0..waveforms.len()).filter(|w| !used[*w]).collect();
    idle.iter().for_each(|w| waveforms[*w] = Waveform::held());
    idle
}
