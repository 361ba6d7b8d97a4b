//! Parts of a [`Scene`](crate::Scene) that a model omits because they have no effect.

use super::{Link, Model, Stroke};
use crate::contact::Press;

/// Indices of parts of a [`Scene`](crate::Scene) without effect.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Spared {
    /// Springs between bodies that never move.
    pub springs: Vec<usize>,
    /// Actuators with constant stroke between bodies that never move.
    pub actuators: Vec<usize>,
    /// Loads on bodies that cannot move, so that guides carry them.
    pub loads: Vec<usize>,
    /// Waveforms that no part follows; their corners do not end steps.
    pub waveforms: Vec<usize>,
}

/// Source of a contact's indentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressing {
    /// Constant.
    Constant,
    /// Waveform of the indentation.
    Followed,
    /// Waveform of force or radius, which every evaluation converts to an indentation.
    Solved,
    /// Motion of the bodies.
    Bodies,
}

impl Model {
    /// Returns the parts of the description that have no effect.
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

    /// Returns whether the force of contact `index` is a state during growth in full stick.
    pub fn grows(&self, index: usize) -> bool {
        self.contacts.get(index).is_some_and(|contact| contact.slot.is_some() && contact.engine.branches())
    }

    /// Returns the names of bodies whose origin of x moves with them, because only contacts depend on their position.
    pub fn travellers(&self) -> impl Iterator<Item = &str> {
        let travelling = self.free.iter().filter(|free| free.travels);
        travelling.map(|free| self.bodies[free.body].name.as_str())
    }
}

impl Link {
    /// Returns whether the link can exert a varying force, because its ends or its stroke move.
    pub(crate) fn acts(&self) -> bool {
        let moves = !self.elongation.free.is_empty() || !self.elongation.driven.is_empty();
        moves || matches!(self.stroke, Stroke::Driven(_))
    }
}
