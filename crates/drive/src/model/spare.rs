//! Parts of a [`Scene`](crate::Scene) that a model omits.

use super::{Link, Model, Stroke};
use crate::contact::Press;

/// Indices of parts of a [`Scene`](crate::Scene) without effect.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Spared {
    /// Springs between bodies at rest.
    pub springs: Vec<usize>,
    /// Actuators between bodies at rest with constant stroke.
    pub actuators: Vec<usize>,
    /// Loads that guides of bodies carry.
    pub loads: Vec<usize>,
    /// Waveforms that nothing follows; their corners do not end steps.
    pub waveforms: Vec<usize>,
}

/// Source of a contact's indentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressing {
    /// Constant.
    Constant,
    /// Waveform of the indentation.
    Followed,
    /// Waveform of force or radius, converted at every evaluation.
    Solved,
    /// Motion of the bodies.
    Bodies,
}

impl Model {
    /// Returns the parts without effect.
    pub fn spared(&self) -> &Spared {
        &self.spared
    }

    /// Returns the source of the indentation of contact `index`.
    pub fn pressing(&self, index: usize) -> Option<Pressing> {
        Some(match self.contacts.get(index)?.press {
            Press::Constant { .. } => Pressing::Constant,
            Press::Indentation(_) => Pressing::Followed,
            Press::Force(_) | Press::Radius(_) => Pressing::Solved,
            Press::Coupled(_) => Pressing::Bodies,
        })
    }

    /// Whether the force of contact `index` is a state during growth in full stick.
    pub fn grows(&self, index: usize) -> bool {
        self.contacts.get(index).is_some_and(|contact| contact.slot.is_some() && contact.engine.branches())
    }

    /// Returns the names of bodies whose origin along the slide moves with them, because only contacts depend on their position.
    pub fn travellers(&self) -> impl Iterator<Item = &str> {
        let travelling = self.free.iter().filter(|free| free.travels);
        travelling.map(|free| self.bodies[free.body].name.as_str())
    }
}

impl Link {
    /// Whether it can exert a varying force: its ends or its stroke move.
    pub(crate) fn acts(&self) -> bool {
        let moves = !self.elongation.free.is_empty() || !self.elongation.driven.is_empty();
        moves || matches!(self.stroke, Stroke::Driven(_))
    }
}
