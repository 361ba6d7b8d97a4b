//! What a model spares its runs.

use super::{Link, Model, Stroke};
use crate::contact::Press;

/// Parts of a scene that a model leaves out, by their places in the scene.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Spared {
    /// Springs between bodies at rest.
    pub springs: Vec<usize>,
    /// Actuators between bodies at rest whose stroke is constant.
    pub actuators: Vec<usize>,
    /// Loads that the guides of their bodies carry.
    pub loads: Vec<usize>,
    /// Waveforms that nothing follows: their corners end no steps.
    pub waveforms: Vec<usize>,
}

/// What sets the indentation of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressing {
    /// Nothing moves it: it is found once.
    Constant,
    /// It follows a waveform.
    Followed,
    /// It is solved from a waveform of the force or of the radius at every evaluation.
    Solved,
    /// The bodies' motion.
    Bodies,
}

impl Model {
    /// What of the scene no run will ever look at.
    pub fn spared(&self) -> &Spared {
        &self.spared
    }

    /// What sets the indentation of contact `index`.
    pub fn pressing(&self, index: usize) -> Option<Pressing> {
        Some(match self.contacts.get(index)?.press {
            Press::Constant { .. } => Pressing::Constant,
            Press::Indentation(_) => Pressing::Followed,
            Press::Force(_) | Press::Radius(_) => Pressing::Solved,
            Press::Coupled(_) => Pressing::Bodies,
        })
    }

    /// Whether the force of contact `index` is a state of its own while the contact grows in full stick.
    pub fn grows(&self, index: usize) -> bool {
        self.contacts.get(index).is_some_and(|contact| contact.slot.is_some() && contact.engine.branches())
    }

    /// The coordinates along the slide whose origin moves with them, by their bodies' names: nothing but contacts depends on
    /// where they are.
    pub fn travellers(&self) -> impl Iterator<Item = &str> {
        let travelling = self.free.iter().filter(|free| free.travels);
        travelling.map(|free| self.bodies[free.body].name.as_str())
    }
}

impl Link {
    /// Whether anything changes about it: between bodies at rest, at a constant stroke, it only is there.
    pub(crate) fn acts(&self) -> bool {
        let moves = !self.elongation.free.is_empty() || !self.elongation.driven.is_empty();
        moves || matches!(self.stroke, Stroke::Driven(_))
    }
}
