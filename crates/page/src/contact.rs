//! The inside of a contact as numbers: springs, stresses and the memory curve.

use stickslip_contact::{Apex, Fields, Interface, Memory, Segment, SpringState, Springs};
use stickslip_drive::state_code;
use stickslip_run::theory::LoadedSpring;

/// Number of springs of a contact that is computed by its memory curve, and largest number of springs shown of a row.
const SPRINGS: usize = 101;
const MOST_SPRINGS: usize = 401;
/// Number of radii of the stresses.
const RADII: usize = 61;
/// Extent of springs and stresses, relative to the largest contact radius.
const BEYOND: f64 = 1.25;

/// Positions at which a contact is shown.
pub(crate) struct Frame {
    reach: f64,
    springs: Option<Springs>,
}

impl Frame {
    /// Creates the positions for a largest indentation, m.
    pub(crate) fn new(law: &Interface, depth: f64) -> Self {
        let reach = BEYOND * law.profile().radius(depth);
        Self { reach, springs: Springs::new(law.profile(), SPRINGS, 2.0 * reach).ok() }
    }

    /// Returns the inside of a contact: 15 numbers (time, d, u, F_N, F_x, a, c, state, elastic energy of the tangential deformation,
    /// friction work, μ, κ, and the numbers of springs, radii and breakpoints), then for each spring x, length, stretch, state, normal and
    /// tangential force, for each radius r, p, τ, u and state, and for each breakpoint of the memory curve h and p.
    pub(crate) fn inside(&self, law: &Interface, memory: &Memory, [t, work]: [f64; 2]) -> Vec<f64> {
        let apex = memory.apex();
        let now = memory.preview(law, apex);
        let mut springs = match (&self.springs, memory) {
            (_, Memory::Row(row)) => LoadedSpring::of(law, memory, &row.springs),
            (Some(grid), _) => LoadedSpring::of(law, memory, grid),
            (None, _) => Vec::new(),
        };
        let every = springs.len().div_ceil(MOST_SPRINGS).max(1);
        springs = springs.into_iter().step_by(every).collect();
        let fields = Fields::of(law, memory).filter(|_| self.reach > 0.0);
        let radii = (0..RADII).map(|k| self.reach * (k as f64 + 0.5) / RADII as f64);
        let fields: Vec<_> = fields.iter().flat_map(|fields| radii.clone().map(|r| fields.at(r))).collect();
        let knots: Vec<(f64, f64)> = match memory {
            Memory::Curve(curve) => curve.knots().collect(),
            Memory::Row(_) => Vec::new(),
        };
        let radius = law.profile().radius(apex.d);
        let forces = [law.normal_force(apex.d), now.force];
        let mut numbers = vec![t, apex.d, apex.u, forces[0], forces[1], radius, now.stick_radius];
        numbers.extend([state_code(now.state), now.elastic, work, law.friction(), law.stick_slope()]);
        numbers.extend([springs.len(), fields.len(), knots.len()].map(|count| count as f64));
        for LoadedSpring { spring, normal_force, tangential_force, .. } in springs {
            let state = state_of(spring.state);
            numbers.extend([spring.x, spring.length, spring.stretch, state, normal_force, tangential_force]);
        }
        for field in fields {
            numbers.extend([field.r, field.pressure, field.shear, field.displacement, state_of(field.state)]);
        }
        numbers.extend(knots.into_iter().flat_map(|(h, p)| [h, p]));
        numbers
    }
}

/// Returns the number of a state: 0 open, 1 stick, 2 and 3 slip forwards and backwards.
fn state_of(state: SpringState) -> f64 {
    match state {
        SpringState::Open => 0.0,
        SpringState::Stick => 1.0,
        SpringState::SlipForward => 2.0,
        SpringState::SlipBackward => 3.0,
    }
}

/// A contact that is moved by hand, without bodies.
pub(crate) struct Hand {
    law: Interface,
    memory: Memory,
    frame: Frame,
    /// Friction work so far, J.
    work: f64,
}

impl Hand {
    /// Takes an untouched contact. `depth` is the largest indentation that is shown, m.
    pub(crate) fn new(law: &Interface, depth: f64) -> Self {
        let memory = stickslip_contact::Engine::Curve.memory(law, Apex::default());
        Self { law: law.clone(), memory, frame: Frame::new(law, depth), work: 0.0 }
    }

    /// Moves the contact on a straight path to the indentation d and the displacement u, m.
    ///
    /// # Errors
    /// The contact cannot be moved there, for instance because it would leave its profile.
    pub(crate) fn press(&mut self, d: f64, u: f64) -> Result<(), String> {
        if !(d.is_finite() && u.is_finite()) {
            return Err("expected finite lengths".to_owned());
        }
        let done = self.memory.commit(&self.law, Segment::Straight(Apex { d, u }));
        self.work += done.map_err(|error| error.to_string())?;
        Ok(())
    }

    /// Returns the inside of the contact.
    pub(crate) fn inside(&self) -> Vec<f64> {
        self.frame.inside(&self.law, &self.memory, [0.0, self.work])
    }
}
