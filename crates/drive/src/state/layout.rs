//! Where the components of a state lie.

use super::State;
use crate::Model;
use crate::model::Wired;

/// Places of the components: positions, velocities, forces of growing contacts, states of blocks, places of balanced
/// coordinates whose contacts grow; then the integrals on whose
/// value nothing depends: input work, dissipation, and for each growing contact elastic energy and friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Free coordinates.
    pub(crate) free: usize,
    /// Contacts whose force is a state while they grow; 0 in runs by chords.
    pub(crate) growing: usize,
    /// States of blocks.
    pub(crate) own: usize,
    /// Balanced coordinates that a state carries while their contacts grow.
    pub(crate) balanced: usize,
    /// Whether steps end where guards fall: not by chords.
    pub(crate) located: bool,
}

impl Layout {
    /// Number of components on which slopes depend.
    pub(crate) fn dimension(self) -> usize {
        2 * self.free + self.growing + self.own + self.balanced
    }
    /// The same with the integrals.
    pub(crate) fn total(self) -> usize {
        self.dimension() + 2 + 2 * self.growing
    }
    /// Place of the velocity of free coordinate `i`.
    pub(crate) fn velocity(self, i: usize) -> usize {
        self.free + i
    }
    /// Place of F_x of a growing contact, N, of one of its identical members.
    pub(crate) fn force(self, slot: usize) -> usize {
        2 * self.free + slot
    }
    /// Place of a state among those of all blocks.
    pub(crate) fn block(self, state: usize) -> usize {
        2 * self.free + self.growing + state
    }
    /// Place of a balanced coordinate while a contact of its own grows, m.
    pub(crate) fn balanced(self, slot: usize) -> usize {
        2 * self.free + self.growing + self.own + slot
    }
    /// Place of the work put in, J.
    pub(crate) fn input(self) -> usize {
        self.dimension()
    }
    /// Place of what dampers have taken, J.
    pub(crate) fn damping(self) -> usize {
        self.dimension() + 1
    }
    /// Place of the elastic energy of a growing contact, J, of one member.
    pub(crate) fn elastic(self, slot: usize) -> usize {
        self.dimension() + 2 + 2 * slot
    }
    /// Place of the friction work of a growing contact, J, of one member.
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
    /// The places of its components: without those of growing contacts after a run by chords.
    pub(crate) fn layout(&self, model: &Model) -> Layout {
        let layout = model.layout();
        let growing = if self.y.len() == layout.total() { layout.growing } else { 0 };
        Layout { growing, ..layout }
    }
}
