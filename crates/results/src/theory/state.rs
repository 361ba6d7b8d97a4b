//! Springs of a contact with what they carry, and words for states.

use stickslip_contact::{ContactState, Interface, Memory, SpringState, Springs};

/// A spring and what it carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSpring {
    /// Position x, m.
    pub x: f64,
    /// Length Δx, m.
    pub length: f64,
    /// Height g(x), m.
    pub g: f64,
    /// Normal line load `q_z` = E\*(d-g), N/m (4.24); 0 where it does not touch.
    pub normal: f64,
    /// Tangential line load `q_x` = G\* times the stretch, N/m.
    pub tangential: f64,
    /// The most that it can be, μ `q_z`, N/m (4.22).
    pub limit: f64,
    /// Stretch u - p, m.
    pub stretch: f64,
    /// What it does.
    pub state: SpringState,
}

impl LoadedSpring {
    /// The springs of `grid`, which is `span` (m) wide, in a contact as it stands; none where g is beyond the profile.
    pub fn of(law: &Interface, memory: &Memory, grid: &Springs, span: f64) -> Vec<Self> {
        let d = memory.apex().d;
        // They lie side by side: each ends as far beyond its middle as it begins before it.
        let mut edge = -0.5 * span;
        let springs = memory.springs(law, grid).zip(grid.heights_by_position()).map(|(spring, g)| {
            let length = 2.0 * (spring.x - edge);
            edge += length;
            let normal = law.normal_modulus() * (d - g).max(0.0);
            Self {
                x: spring.x,
                length,
                g,
                normal,
                tangential: law.tangential_modulus() * spring.stretch,
                limit: law.friction() * normal,
                stretch: spring.stretch,
                state: spring.state,
            }
        });
        springs.filter(|spring| spring.g.is_finite()).collect()
    }
}

/// Word for the state of a spring, as in `springs.csv`.
pub fn spring_word(state: SpringState) -> &'static str {
    match state {
        SpringState::Open => "open",
        SpringState::Stick => "stick",
        SpringState::SlipForward => "slip+",
        SpringState::SlipBackward => "slip-",
    }
}

/// Word for the state of a contact, as in `trace.csv`.
pub fn contact_word(state: ContactState) -> &'static str {
    match state {
        ContactState::Open => "open",
        ContactState::Stick => "stick",
        ContactState::Partial => "partial",
        ContactState::Slip => "slip",
    }
}
