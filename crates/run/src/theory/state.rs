//! Springs of a contact with what they carry, and the word for its state.

use stickslip_contact::{ContactState, Interface, Memory, Spring, Springs};

/// A spring and what it carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSpring {
    /// Where it is and what it does.
    pub spring: Spring,
    /// Normal force, N (4.23); 0 where it does not touch.
    pub normal_force: f64,
    /// Tangential force, N (4.23).
    pub tangential_force: f64,
    /// The most that it can be, μ times the normal force, N (4.22).
    pub limit: f64,
}

impl LoadedSpring {
    /// The springs of `grid` in a contact as it stands; none where g is beyond the profile.
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

/// Word for the state of a contact: that of its code in `trace.csv`.
pub fn contact_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Open => "open",
        ContactState::Stick => "stick",
        ContactState::Partial => "partial",
        ContactState::Slip => "slip",
    }
}
