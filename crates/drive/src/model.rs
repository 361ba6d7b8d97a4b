//! Model of a drive: constants, checked and assembled from a [`Scene`](crate::Scene).
//!
//! [`Model::new`] checks a [`Scene`](crate::Scene) completely and reports errors by part and field. Later, a run can fail only because of
//! its motion. A model never changes and may be shared by many runs. Rotations are small, so displacements between bodies are linear forms
//! of the coordinates ([`Measure`]).

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

/// Smallest natural scale of work, relative to that of the contact with the largest work.
// Work is proportional to the square of the friction coefficient; without this limit, tolerances of nearly frictionless contacts would be
// below rounding.
const LEAST_WORK: f64 = 1e-4;

/// Model of a drive, made from a valid [`Scene`](crate::Scene); it contains constants only.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Waveforms in the order of the [`Scene`](crate::Scene); unused ones are constant.
    pub(crate) waveforms: Vec<Waveform>,
    pub(crate) bodies: Vec<Body>,
    /// Free coordinates by body, in the order x, z, pitch.
    pub(crate) free: Vec<Free>,
    /// Contacts in the order of the [`Scene`](crate::Scene).
    pub(crate) contacts: Vec<Contact>,
    pub(crate) blocks: Vec<Wired>,
    /// Quasi-static ("balanced") coordinates by body, in the order x, z.
    pub(crate) balanced: Vec<Balanced>,
    /// Springs and then actuators that can exert a varying force.
    pub(crate) links: Vec<Link>,
    /// Loads that vary in time; constant loads are in the force of their coordinate.
    pub(crate) loads: Vec<Load>,
    /// Number of contacts whose force is a state during growth in full stick.
    pub(crate) growing: usize,
    /// Whether a run starts in static equilibrium.
    pub(crate) equilibrium: bool,
    /// Parts of the [`Scene`](crate::Scene) without effect, which the model omits.
    pub(crate) spared: Spared,
    /// Time step of the numerical derivative for quasi-static coordinates, s.
    pub(crate) moment: f64,
    /// Largest |λ| of the motions e^{λt} with all contacts stuck at their largest indentation, 1/s.
    pub(crate) fastest: f64,
    /// Whether the model is stiff, so that implicit steps are used.
    pub(crate) stiff: bool,
}

/// Type of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Binding {
    /// Coordinate that is fixed at this position, m or rad.
    Held(f64),
    /// Free coordinate by index.
    Free(usize),
    /// Coordinate that follows a signal, given by its index.
    Driven(usize),
}

/// Body with its name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Body {
    pub(crate) name: String,
    /// Types of the body's coordinates x, z and pitch.
    pub(crate) bindings: [Binding; 3],
}

/// Free coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Free {
    pub(crate) body: usize,
    pub(crate) axis: Axis,
    /// Mass, kg, or moment of inertia, kg m².
    pub(crate) mass: f64,
    /// Inverse of the mass.
    pub(crate) mobility: f64,
    /// Gravity and constant loads, N or N m.
    pub(crate) force: f64,
    /// Initial position and velocity.
    pub(crate) start: (f64, f64),
    /// Whether only contacts depend on the coordinate, so that its origin may move along with the body.
    pub(crate) travels: bool,
    /// Natural scales of position and velocity, m and m/s or rad and rad/s.
    pub(crate) scale: (f64, f64),
}

/// Natural scales of a contact at its largest expected indentation. Tolerances of the stepper are relative to these scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NaturalScale {
    /// Gross slip displacement u_c, m.
    pub displacement: f64,
    /// Friction limit μF_N, N.
    pub force: f64,
    /// Natural velocity u_c ω, m/s, with the largest natural angular frequency ω of the contact's bodies; without free ones, of the drive.
    pub velocity: f64,
}

/// Spring, damper or actuator with the force k(s-e) + c(ṡ-ė) + preload on the second body. The elongation e is the displacement of the
/// second end minus that of the first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    /// Elongation e, m.
    pub(crate) elongation: Measure,
    /// Stiffness k, N/m.
    pub(crate) stiffness: f64,
    /// Damping c, N s/m.
    pub(crate) damping: f64,
    /// Preload, N; a positive preload pushes the ends apart.
    pub(crate) preload: f64,
    /// Free stroke s, m.
    pub(crate) stroke: Stroke,
}

/// Free stroke of a spring or actuator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stroke {
    Constant(f64),
    Driven(usize),
}

/// Load on a free coordinate that varies in time: arm times waveform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Load {
    pub(crate) free: usize,
    /// Factor 1 for a force, or lever arm in m for the moment of a force.
    pub(crate) arm: f64,
    pub(crate) waveform: usize,
}

impl Model {
    /// Returns an empty model without bodies.
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

    /// Returns the names of the bodies in order.
    pub fn bodies(&self) -> impl Iterator<Item = &str> {
        self.bodies.iter().map(|b| b.name.as_str())
    }

    /// Returns names and interfaces of the contacts in order, without stops, which come after them.
    pub fn contacts(&self) -> impl Iterator<Item = (&str, &Interface)> {
        self.contacts.iter().filter(|c| !c.stop).map(|c| (c.name.as_str(), &c.interface))
    }

    /// Returns the damping times of contact `index`, s: of its tangential springs, and along the normal.
    pub fn damping(&self, index: usize) -> [f64; 2] {
        let of = |contact: &Contact| [contact.interface.damping(), contact.normal_damping];
        self.contacts.get(index).map_or([0.0; 2], of)
    }

    /// Returns whether any waveform jumps. During a jump gross slip may begin without an event.
    #[must_use]
    pub fn jumps(&self) -> bool {
        self.waveforms.iter().any(Waveform::has_jumps)
    }

    /// Returns the gross slip displacement u_c (m) of contact `index` and the normal force of one contact (N), both at t = 0. `None` for
    /// asperities without a highest one.
    pub fn contact_scale(&self, index: usize) -> Option<(f64, f64)> {
        let endless = |contact: &&Contact| contact.interface.profile().endless_scale().is_some();
        let contact = self.contacts.get(index).filter(|contact| !endless(contact))?;
        let d = self.indentation(contact);
        Some((contact.interface.gross_slip_displacement(d), contact.interface.normal_force(d)))
    }

    /// Returns the largest width 2a of contact `index`, m; 0 if the contact is never pressed.
    pub fn contact_width(&self, index: usize) -> Option<f64> {
        let deepest = self.indentations(&self.rest(), index)?.most;
        self.contacts.get(index).map(|contact| 2.0 * contact.interface.profile().radius(deepest))
    }

    /// Returns the natural angular frequency of contact `index`, rad/s, of small oscillations with the contact stuck.
    pub fn contact_frequency(&self, index: usize) -> Option<f64> {
        self.contacts.get(index).map(|c| c.natural.frequency)
    }

    /// Returns the natural scales of contact `index`, for one of the identical contacts.
    pub fn contact_natural(&self, index: usize) -> Option<NaturalScale> {
        self.contacts.get(index).map(|c| NaturalScale {
            displacement: c.natural.displacement,
            force: c.friction_limit(),
            velocity: c.natural_velocity(),
        })
    }

    /// Returns the natural scale of work, J: μF_N u_c of the smallest contact, at least [`LEAST_WORK`] of that of the largest.
    ///
    /// Without friction the scale is the largest mv² of a free coordinate at its natural velocity, or the smallest stored energy of a
    /// quasi-static coordinate; otherwise 1 J.
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

    /// Returns the work of gravity and constant loads from 0 to the positions `x`, J.
    pub(crate) fn lifted(&self, x: impl Fn(usize) -> f64) -> f64 {
        self.free.iter().enumerate().map(|(i, free)| free.force * x(i)).sum()
    }

    /// Returns the indentation of a contact at t = 0, m, with the free coordinates at their start.
    pub(crate) fn indentation(&self, contact: &Contact) -> f64 {
        let first = |w: usize| self.signals().first(w);
        match &contact.press {
            Press::Constant { d, .. } => *d,
            Press::Force(w) | Press::Indentation(w) | Press::Radius(w) => contact.pressed(first(*w), None).0,
            Press::Coupled(measure) => measure.value(|i| self.free[i].start.0, |w| first(w).value),
        }
    }
}
