//! The constants of a drive, checked and assembled.
//!
//! [`Model::new`] is the only way from a scene to a model: whatever can be wrong with a scene is refused
//! there, with the part and the field, so that a run has nothing left to refuse but motion itself. A model
//! never changes; runs borrow it, and any number of them may at once. Lengths between bodies are linear forms
//! of the coordinates ([`Measure`]) with constant coefficients: rotations are small.

mod balanced;
mod block;
mod build;
mod check;
mod contact;
mod dampers;
mod held;
mod measure;
mod reach;
mod scale;
mod spare;
mod used;

pub(crate) use balanced::{Balanced, Pull};
pub(crate) use block::{BlockState, MOST as MOST_OF_A_BLOCK, Signals, Wire, Wired};
pub(crate) use build::Scaffold;
pub(crate) use measure::{Measure, Terms};
pub use spare::{Pressing, Spared};

use crate::Waveform;
use crate::contact::{Contact, Press};
use crate::scene::Axis;
use stickslip_contact::Interface;

/// Least scale of work, in parts of that of the largest contact.
// Works go with the square of a friction coefficient, as force and u_c both do. Of a body on two lists of heights, one with a
// friction of 1e-6 and the other of 0.46, the smaller work was some 1e-12 of the larger: a tolerance of 1e-8 asked for works far below
// their rounding, and runs stopped. With 1e-6 they end, but take detours at 1e-10; with 1e-4 they take none.
const LEAST_WORK: f64 = 1e-4;

/// A checked scene as constants: what evaluation needs and nothing else.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// In the scene's order; those that nothing follows are held still.
    pub(crate) waveforms: Vec<Waveform>,
    pub(crate) bodies: Vec<Body>,
    /// Free coordinates, body by body, x, z and pitch.
    pub(crate) free: Vec<Free>,
    /// In the scene's order.
    pub(crate) contacts: Vec<Contact>,
    pub(crate) blocks: Vec<Wired>,
    /// Coordinates without mass, body by body, x and z.
    pub(crate) balanced: Vec<Balanced>,
    /// Springs, then actuators, of those that act.
    pub(crate) links: Vec<Link>,
    /// Those that vary; constant ones are in the force of their coordinate.
    pub(crate) loads: Vec<Load>,
    /// Number of contacts whose force is a state while they grow.
    pub(crate) growing: usize,
    /// Whether a run starts in static equilibrium.
    pub(crate) equilibrium: bool,
    /// What of the scene no run will ever look at.
    pub(crate) spared: Spared,
    /// How far ahead and back rates of balanced coordinates are compared for their own rate, s.
    pub(crate) moment: f64,
    /// Largest |λ|, 1/s, of the motions e^{λt} with all contacts stuck and as deep as they get.
    pub(crate) fastest: f64,
    /// Whether something settles so much faster than all else goes on that explicit steps would only follow it.
    pub(crate) stiff: bool,
}

/// What a coordinate is bound to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Binding {
    /// Stays here, m or rad.
    Held(f64),
    /// A free coordinate.
    Free(usize),
    /// Follows a waveform.
    Driven(usize),
}

/// A body under its name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Body {
    pub(crate) name: String,
    /// What its x, z and pitch are bound to.
    pub(crate) bindings: [Binding; 3],
}

/// A free coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Free {
    pub(crate) body: usize,
    pub(crate) axis: Axis,
    /// Mass, kg, or moment of inertia, kg m².
    pub(crate) mass: f64,
    /// Its inverse.
    pub(crate) mobility: f64,
    /// Gravity and constant loads, N or N m.
    pub(crate) force: f64,
    /// Where it starts and how fast.
    pub(crate) start: (f64, f64),
    /// Whether it only ever counts against another place of its contacts, so that its origin may move with it.
    pub(crate) travels: bool,
    /// Natural scales of position and velocity, m and m/s or rad and rad/s.
    pub(crate) scale: (f64, f64),
}

/// Natural scales of a contact at the deepest indentation that its scene names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NaturalScale {
    /// u_c, m.
    pub displacement: f64,
    /// μF_N, N.
    pub force: f64,
    /// u_c ω, m/s, ω the angular frequency of the stiffest body it touches; of the drive where none is free.
    pub velocity: f64,
}

/// Spring, damper or actuator: force on the second body k(s-e) + c(ṡ-ė) + preload, e the displacement of its end on the
/// second body less that on the first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    /// e, m.
    pub(crate) elongation: Measure,
    /// k, N/m.
    pub(crate) stiffness: f64,
    /// c, N s/m.
    pub(crate) damping: f64,
    /// N; pushes the ends apart where it is positive.
    pub(crate) preload: f64,
    /// s, m.
    pub(crate) stroke: Stroke,
}

/// Free stroke of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stroke {
    Constant(f64),
    Driven(usize),
}

/// A load that varies in time, on a free coordinate: arm times the waveform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Load {
    pub(crate) free: usize,
    /// 1, or m where a force turns.
    pub(crate) arm: f64,
    pub(crate) waveform: usize,
}

impl Model {
    /// Of no scene yet.
    pub(crate) fn blank() -> Self {
        Self {
            waveforms: Vec::new(),
            bodies: Vec::new(),
            free: Vec::new(),
            contacts: Vec::new(),
            blocks: Vec::new(),
            balanced: Vec::new(),
            links: Vec::new(),
            loads: Vec::new(),
            growing: 0,
            equilibrium: false,
            spared: Spared::default(),
            moment: 0.0,
            fastest: 0.0,
            stiff: false,
        }
    }

    /// Names of the bodies, in the scene's order.
    pub fn bodies(&self) -> impl Iterator<Item = &str> {
        self.bodies.iter().map(|b| b.name.as_str())
    }

    /// Names and laws of the contacts, in the scene's order.
    pub fn contacts(&self) -> impl Iterator<Item = (&str, &Interface)> {
        self.contacts.iter().map(|c| (c.name.as_str(), &c.interface))
    }

    /// Whether any waveform jumps: within a jump contacts give way without an event of their own.
    #[must_use]
    pub fn jumps(&self) -> bool {
        self.waveforms.iter().any(Waveform::has_jumps)
    }

    /// Gross-slip displacement u_c (m) and normal force of one contact (N) of contact `index` at t = 0.
    pub fn contact_scale(&self, index: usize) -> Option<(f64, f64)> {
        let contact = self.contacts.get(index)?;
        let d = self.indentation(contact);
        Some((contact.interface.gross_slip_displacement(d), contact.interface.normal_force(d)))
    }

    /// Largest width 2a of contact `index`, m; 0 for one that is never pressed.
    pub fn contact_width(&self, index: usize) -> Option<f64> {
        let deepest = self.indentations(&self.rest(), index)?.most;
        self.contacts.get(index).map(|contact| 2.0 * contact.interface.profile().radius(deepest))
    }

    /// Angular frequency of small oscillations with this contact stuck, rad/s; natural scale of its events.
    pub fn contact_frequency(&self, index: usize) -> Option<f64> {
        self.contacts.get(index).map(|c| c.natural.frequency)
    }

    /// Natural scales of contact `index`, one of its identical members: what the stepper's tolerance is relative to.
    pub fn contact_natural(&self, index: usize) -> Option<NaturalScale> {
        self.contacts.get(index).map(|c| NaturalScale {
            displacement: c.natural.displacement,
            force: c.friction_limit(),
            velocity: c.natural_velocity(),
        })
    }

    /// Natural scale of work, J: μF_N u_c of the smallest contact, and no less than [`LEAST_WORK`] of the largest.
    ///
    /// Where no contact has friction, the largest mv² of a free coordinate at its natural speed, or what balanced coordinates
    /// store; 1 J where that is nothing, too.
    pub(crate) fn work_scale(&self) -> f64 {
        let works = || self.contacts.iter().map(Contact::natural_work);
        let smallest = works().filter(|w| *w > 0.0).fold(f64::INFINITY, f64::min);
        if smallest.is_finite() {
            let largest = works().fold(0.0, f64::max);
            return smallest.max(LEAST_WORK * largest);
        }
        let swing = self.free.iter().map(|free| free.mass * free.scale.1 * free.scale.1).fold(0.0, f64::max);
        if swing.is_normal() { swing } else { self.stored_scale().unwrap_or(1.0) }
    }

    /// Work of gravity and constant loads on the way to the positions `x` from 0, J.
    pub(crate) fn lifted(&self, x: impl Fn(usize) -> f64) -> f64 {
        self.free.iter().enumerate().map(|(i, free)| free.force * x(i)).sum()
    }

    /// Indentation of a contact at t = 0, m, with the free coordinates where they start.
    pub(crate) fn indentation(&self, contact: &Contact) -> f64 {
        let first = |w: usize| self.signals().first(w);
        match &contact.press {
            Press::Constant { d, .. } => *d,
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => contact.pressed(first(*w), None).0,
            Press::Coupled(measure) => measure.value(|i| self.free[i].start.0, |w| first(w).value),
        }
    }
}
