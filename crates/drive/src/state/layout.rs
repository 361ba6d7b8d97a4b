//! Order of the components of a state.

use super::State;
use crate::Model;
use crate::model::Wired;

/// Order of the components: positions, velocities, forces of contacts growing in full stick, states of blocks, balanced coordinates.
/// Integrals follow: input work, dissipation, and for each growing contact elastic energy and friction work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Number of free coordinates.
    pub(crate) free: usize,
    /// Number of contacts whose force is a state while they grow in full stick; 0 for fixed steps and the reference method.
    pub(crate) growing: usize,
    /// Number of states of blocks.
    pub(crate) own: usize,
    /// Number of balanced coordinates that may be states.
    pub(crate) balanced: usize,
    /// Whether steps end at zero crossings of event functions.
    pub(crate) located: bool,
}

impl Layout {
    /// Returns the number of components on which the time derivatives depend.
    pub(crate) fn dimension(self) -> usize {
        2 * self.free + self.growing + self.own + self.balanced
    }
    /// Returns the number of all components, including integrals.
    pub(crate) fn total(self) -> usize {
        self.dimension() + 2 + 2 * self.growing
    }
    /// Returns the index of the velocity of free coordinate `i`.
    pub(crate) fn velocity(self, i: usize) -> usize {
        self.free + i
    }
    /// Returns the index of the tangential force of one of the identical contacts, N, while they grow in full stick.
    pub(crate) fn force(self, slot: usize) -> usize {
        2 * self.free + slot
    }
    /// Returns the index of a state of a block.
    pub(crate) fn block(self, state: usize) -> usize {
        2 * self.free + self.growing + state
    }
    /// Returns the index of a balanced coordinate that is a state, m.
    pub(crate) fn balanced(self, slot: usize) -> usize {
        2 * self.free + self.growing + self.own + slot
    }
    /// Returns the index of the input work, J.
    pub(crate) fn input(self) -> usize {
        self.dimension()
    }
    /// Returns the index of the damping work, J.
    pub(crate) fn damping(self) -> usize {
        self.dimension() + 1
    }
    /// Returns the index of the elastic energy of one of the identical contacts, J, while they grow in full stick.
    pub(crate) fn elastic(self, slot: usize) -> usize {
        self.dimension() + 2 + 2 * slot
    }
    /// Returns the index of the friction work of one of the identical contacts, J, while they grow in full stick.
    pub(crate) fn friction(self, slot: usize) -> usize {
        self.dimension() + 3 + 2 * slot
    }
}

impl Model {
    pub(crate) fn layout(&self) -> Layout {
        Layout {
            free: self.free.len(),
            growing: self.growing,
            own: self.blocks.iter().map(Wired::count).sum(),
            balanced: self.balanced.iter().filter(|b| b.slot.is_some()).count(),
            located: true,
        }
    }
}

impl State {
    /// Returns the layout of the state. After a run without event location it contains no forces of growing contacts.
    pub(crate) fn layout(&self, model: &Model) -> Layout {
        let layout = model.layout();
        let growing = if self.y.len() == layout.total() { layout.growing } else { 0 };
        Layout { growing, ..layout }
    }
}
