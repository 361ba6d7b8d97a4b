//! Waveforms that nothing follows.

use super::{Body, Contact, Link, Load, Place, Stroke};
use crate::Waveform;

/// Holds all waveforms still that nothing follows: their corners would end steps for nothing. Gives their places.
pub(super) fn hold_the_others(
    waveforms: &mut [Waveform],
    bodies: &[Body],
    contacts: &[Contact],
    links: &[Link],
    loads: &[Load],
) -> Vec<usize> {
    let mut used = vec![false; waveforms.len()];
    let places = bodies.iter().flat_map(|body| body.places).filter_map(|place| match place {
        Place::Driven(w) => Some(w),
        Place::Held(_) | Place::Free(_) => None,
    });
    let strokes = links.iter().filter_map(|link| match link.stroke {
        Stroke::Driven(w) => Some(w),
        Stroke::Constant(_) => None,
    });
    let pressing = contacts.iter().filter_map(|contact| contact.press.waveform());
    let pulling = loads.iter().map(|load| load.waveform);
    places.chain(strokes).chain(pressing).chain(pulling).for_each(|w| used[w] = true);
    let idle: Vec<usize> = (0..waveforms.len()).filter(|w| !used[*w]).collect();
    idle.iter().for_each(|w| waveforms[*w] = Waveform::held());
    idle
}
