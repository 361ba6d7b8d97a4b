//! Check that no damper acts on a length that jumps, because its impulse would be undefined.

use super::{Link, Measure, Signals, Stroke};
use crate::contact::Contact;
use crate::scene::Scene;
use crate::{Field, Part, SceneError, SceneFault};

/// Returns an error for a spring, actuator or contact with damping whose length jumps.
///
/// The error contains the first such part, in the order springs, actuators, contacts, and the waveform that jumps, also through blocks.
pub(super) fn check(
    scene: &Scene,
    links: &[Link],
    contacts: &[Contact],
    signals: Signals<'_>,
) -> Result<(), SceneError> {
    let jumps = |w: &usize| signals.has_jumps(*w);
    let driven = |length: &Measure| length.driven.iter().map(|(w, _)| *w).find(jumps);
    // For a block, the name is that of the waveform whose jumps the block passes on.
    let name = |signal: usize| match scene.waveform_of(signal) {
        Some(w) => scene.waveforms[w].name.clone(),
        None => scene.blocks[signal - scene.waveforms.len()].name.clone(),
    };
    let refused = |part: Part, w: usize| Err(SceneFault::DampedJump(name(w)).of(part, Field::Damping));
    for (i, link) in links.iter().enumerate().filter(|(_, link)| link.damping > 0.0) {
        let stroke = match link.stroke {
            Stroke::Driven(w) => Some(w).filter(jumps),
            Stroke::Constant(_) => None,
        };
        if let Some(w) = driven(&link.elongation).or(stroke) {
            // Springs come first.
            let part = match i.checked_sub(scene.springs.len()) {
                None => Part::Spring(i),
                Some(i) => Part::Actuator(i),
            };
            return refused(part, w);
        }
    }
    for (i, contact) in contacts.iter().enumerate().filter(|(_, contact)| contact.interface.damping() > 0.0) {
        if let Some(w) = driven(&contact.u) {
            return refused(Part::Contact(i), w);
        }
    }
    Ok(())
}
