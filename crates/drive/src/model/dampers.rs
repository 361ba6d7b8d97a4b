//! A damper has no answer to a jump in no time: its impulse would be a matter of definition.

use super::{Contact, Link, Measure, Stroke};
use crate::scene::Scene;
use crate::{SceneError, Waveform};

/// Refuses dampers of links and contacts whose length jumps.
pub(super) fn check(
    scene: &Scene,
    links: &[Link],
    contacts: &[Contact],
    waveforms: &[Waveform],
) -> Result<(), SceneError> {
    let jumps = |w: &usize| waveforms[*w].has_jumps();
    let driven = |length: &Measure| length.driven.iter().map(|(w, _)| *w).find(jumps);
    let refused = |part: String, w: usize| {
        let message = format!("a damper cannot follow the jumps of waveform `{}`", scene.waveforms[w].name);
        Err(SceneError::new(format!("{part}.damping"), message).help("give the waveform a flyback above 0"))
    };
    for (i, link) in links.iter().enumerate().filter(|(_, link)| link.damping > 0.0) {
        let stroke = match link.stroke {
            Stroke::Driven(w) => Some(w).filter(jumps),
            Stroke::Constant(_) => None,
        };
        if let Some(w) = driven(&link.elongation).or(stroke) {
            let part = match scene.springs.get(i) {
                Some(spring) => format!("springs.{}", spring.name),
                None => format!("actuators.{}", scene.actuators[i - scene.springs.len()].name),
            };
            return refused(part, w);
        }
    }
    for contact in contacts.iter().filter(|contact| contact.damping > 0.0) {
        if let Some(w) = driven(&contact.u) {
            return refused(format!("contacts.{}", contact.name), w);
        }
    }
    Ok(())
}
