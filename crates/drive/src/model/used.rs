//! Unused waveforms.

use super::{Binding, Model, Stroke, Wire};
use crate::Waveform;

/// Replaces unused waveforms by constants, so that their corners do not end steps, and records their indices. `used` is scratch memory.
///
/// Bodies, strokes, normal loads, external loads and blocks use waveforms.
pub(super) fn hold_the_others(model: &mut Model, used: &mut Vec<bool>) {
    used.clear();
    used.resize(model.waveforms.len(), false);
    let places = model.bodies.iter().flat_map(|body| body.bindings).filter_map(|place| match place {
        Binding::Driven(w) => Some(w),
        Binding::Held(_) | Binding::Free(_) => None,
    });
    let strokes = model.links.iter().filter_map(|link| match link.stroke {
        Stroke::Driven(w) => Some(w),
        Stroke::Constant(_) => None,
    });
    let pressing = model.contacts.iter().filter_map(|contact| contact.press.waveform());
    let balancing = model.balanced.iter().flat_map(|b| b.pull.loads.iter().map(|(w, _)| *w));
    let pulling = model.loads.iter().map(|load| load.waveform).chain(balancing);
    let read = model.blocks.iter().flat_map(|block| &block.wires).filter_map(|wire| match wire {
        Wire::Signal(w) => Some(*w),
        Wire::Length(_) => None,
    });
    let all = places.chain(strokes).chain(pressing).chain(pulling).chain(read);
    for w in all {
        // Signals after the waveforms belong to blocks.
        if let Some(used) = used.get_mut(w) {
            *used = true;
        }
    }
    for w in (0..used.len()).filter(|w| !used[*w]) {
        model.waveforms[w] = Waveform::held();
        model.spared.waveforms.push(w);
    }
}
