//! Springs of a contact with their forces, and words for the states of a contact.

use stickslip_contact::{ContactState, Interface, Memory, Spring, Springs};

/// A spring with its forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSpring {
    /// Position, stretch and slip state of the spring.
    pub spring: Spring,
    /// Normal force, N (4.23). The force is 0 for a spring that is not in contact.
    pub normal_force: f64,
    /// Tangential force, N (4.23).
    pub tangential_force: f64,
    /// Friction limit of the tangential force, N (4.22).
    pub limit: f64,
}

impl LoadedSpring {
    /// Returns the springs of `grid` in the present state of a contact, without springs outside of the profile.
    pub fn of(law: &Interface, memory: &Memory, grid: &Springs) -> Vec<Self> {
        let d = memory.apex().d;
        let springs = memory.springs(law, grid).filter(|spring| spring.height.is_finite());
        let loaded = |spring: Spring| {
            let normal_force = spring.normal_force(law, d);
            let tangential_force = spring.tangential_force(law);
            Self { spring, normal_force, tangential_force, limit: law.friction() * normal_force }
        };
        springs.map(loaded).collect()
    }
}

/// Returns the word for a contact state in `trace.csv`.
pub fn contact_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Open => "open",
        ContactState::Stick => "stick",
        ContactState::Partial => "partial",
        ContactState::Slip => "slip",
    }
}
