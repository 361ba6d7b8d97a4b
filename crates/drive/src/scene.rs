//! A scene: what is there, in SI, before it becomes equations. Plain data; [`crate::Model::new`] checks it.

use crate::Waveform;
use stickslip_contact::{Pair, Profile};

/// Everything a drive consists of.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Waveforms, referred to by their place in this list.
    pub waveforms: Vec<Named<Waveform>>,
    /// Bodies beside the ground.
    pub bodies: Vec<Named<Body>>,
    /// Contacts between bodies or a body and the ground.
    pub contacts: Vec<Named<Contact>>,
    /// Linear springs with dampers.
    pub springs: Vec<Named<Spring>>,
    /// Piezo stacks.
    pub actuators: Vec<Named<Actuator>>,
    /// Forces on bodies.
    pub loads: Vec<Load>,
    /// Gravity; none by default.
    pub gravity: Gravity,
    /// How the free coordinates start.
    pub start: Start,
}

/// A part of a scene under the name its user gave it.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T> {
    /// Name, unique among its kind.
    pub name: String,
    /// The part.
    pub part: T,
}

/// A rigid body that moves along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Mass, kg; needed where a coordinate is free.
    pub mass: Option<f64>,
    /// The coordinate along the slide.
    pub x: Freedom,
    /// Position x at t = 0, m, as a displacement from the position drawn.
    pub start_x: f64,
    /// Velocity at t = 0, m/s.
    pub start_vx: f64,
}

/// What a coordinate may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Freedom {
    /// Stays where it is.
    #[default]
    Fixed,
    /// Obeys Newton.
    Free,
    /// Follows the waveform at this place of [`Scene::waveforms`].
    Follows(usize),
}

/// A quantity that may vary in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Varying {
    /// Constant, SI.
    Constant(f64),
    /// Follows the waveform at this place of [`Scene::waveforms`].
    Follows(usize),
}

/// One side of a contact, spring or actuator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The ground, fixed.
    Ground,
    /// The body at this place of [`Scene::bodies`].
    Body(usize),
}

/// A frictional contact: u = x(first) - x(second); F_x(u) acts on the second body, -F_x on the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// First (lower) and second body.
    pub between: [Side; 2],
    /// Effective moduli.
    pub pair: Pair,
    /// Profile of the gap.
    pub profile: Profile,
    /// Coulomb's coefficient of friction.
    pub friction: f64,
    /// What presses the contact.
    pub normal: Normal,
    /// The contact's own starting state.
    pub start: ContactStart,
    /// How the tangential problem is solved.
    pub engine: EngineChoice,
    /// Number of identical contacts that share this motion, at least 1.
    pub count: u32,
}

/// What presses a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// Normal force of one contact, N, at least 0.
    Force(Varying),
    /// Indentation, m; negative: open.
    Indentation(Varying),
    /// Contact radius, m, at least 0.
    Radius(Varying),
}

/// A contact's starting state; both kinds are reached monotonically from the untouched contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ContactStart {
    /// Springs unstretched.
    #[default]
    Untouched,
    /// Preloaded to this tangential force of one contact, N; below μF_N in magnitude.
    Force(f64),
    /// Preloaded by this displacement, m.
    Displacement(f64),
}

/// How the tangential problem of a contact is solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum EngineChoice {
    /// The exact memory curve.
    #[default]
    Curve,
    /// A row of springs.
    Springs {
        /// Number of springs.
        count: usize,
        /// Length of the row, m; by default the contact's width at the largest indentation known.
        span: Option<f64>,
    },
}

/// Linear spring and damper along x: force on the second body `preload - stiffness·e - damping·ė`,
/// e = x(second) - x(first).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// First and second body.
    pub between: [Side; 2],
    /// Stiffness, N/m, at least 0.
    pub stiffness: f64,
    /// Damping, N s/m, at least 0.
    pub damping: f64,
    /// Force on the second body at e = 0, N.
    pub preload: f64,
}

/// Piezo stack along x: force on the second body k(s-e) + c(ṡ-ė), e = x(second) - x(first), s the free stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// First and second body.
    pub between: [Side; 2],
    /// Stiffness k, N/m, above 0.
    pub stiffness: f64,
    /// Damping c, N s/m, at least 0.
    pub damping: f64,
    /// Free stroke s, m.
    pub stroke: Varying,
}

/// Force on a body along x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Place of the body in [`Scene::bodies`].
    pub on: usize,
    /// Force, N.
    pub x: Varying,
}

/// Gravity: the slide climbs by `incline` from the horizontal, so the force along x is -m g sin(incline).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gravity {
    /// Acceleration g, m/s².
    pub acceleration: f64,
    /// Angle from the horizontal to the x axis, rad.
    pub incline: f64,
}

/// How the free coordinates start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// Where the bodies say.
    #[default]
    Given,
    /// In static equilibrium under what acts at t = 0, at rest.
    Equilibrium,
}
