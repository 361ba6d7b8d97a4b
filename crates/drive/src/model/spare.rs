//! What a model spares its runs.

use super::{Contact, Link, Model, Stroke};

impl Model {
    /// The coordinates along the slide whose origin moves with them, by their bodies' names: nothing but contacts depends on
    /// where they are.
    pub fn travellers(&self) -> impl Iterator<Item = &str> {
        let travelling = self.free.iter().filter(|free| free.travels);
        travelling.map(|free| self.bodies[free.body].name.as_str())
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
