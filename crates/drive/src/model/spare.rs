//! What a model spares its runs.

use super::{Contact, Link, Model, Stroke};

impl Model {
    /// The coordinates along the slide whose origin moves with them, by their bodies' names: nothing but contacts depends on
    /// where they are.
    pub fn travellers(&self) -> impl Iterator<Item = &str> {
        let travelling = self.free.iter().filter(|free| free.travels);
        travelling.map(|free| self.bodies[free.body].name.as_str())
    }

    /// Whether the stepper `event` may take the Nyström method, for no force depends on a velocity: no damper, no load whose
    /// power does, no contact that grows along a curved path.
    pub fn is_conservative(&self) -> bool {
        let undamped = self.links.iter().all(|link| link.damping == 0.0);
        let unbraked = self.contacts.iter().all(|contact| contact.damping == 0.0);
        undamped && unbraked && self.loads.is_empty() && self.growing == 0 && !self.free.is_empty()
    }

    /// Whether the stepper `event` takes no steps between events: a single slider swings in closed form among paraboloids
    /// under constant load that straight waveforms drag. Others are stepped through their partial slip.
    pub fn swings(&self) -> bool {
        let is_straight = |w: usize| self.waveforms[w].resolution() == f64::INFINITY;
        let has_form = |contact: &&Contact| {
            let is_curve = contact.engine.branches() && contact.law.profile().exponent() == Some(2.0);
            is_curve && contact.is_constant() && contact.u.driven.iter().all(|(w, _)| is_straight(*w))
        };
        let mut pressed = self.contacts.iter().filter(|contact| !contact.is_never_pressed());
        let is_single = self.free.len() == 1 && self.links.is_empty() && pressed.clone().next().is_some();
        self.is_conservative() && is_single && pressed.all(|contact| has_form(&contact))
    }
}

impl Contact {
    /// Whether nothing will ever press it.
    pub(crate) fn is_never_pressed(&self) -> bool {
        self.natural.depth == 0.0
    }
}

impl Link {
    /// Whether anything changes about it: between bodies at rest, at a constant stroke, it only is there.
    pub(crate) fn acts(&self) -> bool {
        let moves = !self.elongation.free.is_empty() || !self.elongation.driven.is_empty();
        moves || matches!(self.stroke, Stroke::Driven(_))
    }
}
