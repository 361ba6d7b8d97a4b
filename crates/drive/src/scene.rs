//! A scene: what is there, in SI, before it becomes equations. Plain data; [`crate::Model::new`] checks it.

mod contact;

pub use contact::{Contact, ContactStart, EngineChoice, Normal};

use std::f64::consts::FRAC_PI_2;

use crate::component::{Input, SharedBlock};
use crate::{SceneFault, Waveform};

/// Largest angle that is small, rad: further round bodies do not go as the model has it.
///
/// A point that moves along its tangent goes tan θ where a rotation takes it sin θ, and leaves its circle by 1 - cos θ:
/// 0.5 % of its arm and of its way at 0.1 rad.
pub const SMALL_ANGLE: f64 = 0.1;

/// Everything a drive consists of.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Waveforms, referred to by their place in this list.
    pub waveforms: Vec<Named<Waveform>>,
    /// Bodies beside the ground.
    pub bodies: Vec<Named<Body>>,
    /// Contacts between bodies or a body and the ground.
    pub contacts: Vec<Named<Contact>>,
    /// Components that the scene brings along.
    pub blocks: Vec<Named<SharedBlock>>,
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

impl Scene {
    /// SI unit of a waveform: that of what follows it first; empty where nothing does.
    #[must_use]
    pub fn waveform_unit(&self, place: usize) -> &'static str {
        let follows = |value: Varying| matches!(value, Varying::Follows(waveform) if waveform == place);
        for body in &self.bodies {
            for (axis, coordinate) in body.part.coordinates() {
                if coordinate.freedom == Freedom::Follows(place) {
                    return if axis == Axis::Pitch { "rad" } else { "m" };
                }
            }
        }
        if self.actuators.iter().any(|actuator| follows(actuator.part.stroke)) {
            return "m";
        }
        for load in &self.loads {
            if follows(load.x) || follows(load.z) {
                return "N";
            }
            if follows(load.pitch) {
                return "N m";
            }
        }
        for contact in &self.contacts {
            match contact.part.normal {
                Normal::Force(value) if follows(value) => return "N",
                Normal::Indentation(value) | Normal::Radius(value) if follows(value) => return "m",
                _ => {}
            }
        }
        ""
    }

    /// The waveform that a signal is or, where a block makes it, what the first signal that the block reads comes from. None where
    /// no waveform is behind it.
    #[must_use]
    pub fn waveform_of(&self, signal: usize) -> Option<usize> {
        let Some(block) = signal.checked_sub(self.waveforms.len()) else { return Some(signal) };
        let inputs = self.blocks.get(block)?.part.0.inputs();
        let first = inputs.iter().find_map(|input| match input {
            // A block reads what is before it: that ends.
            Input::Signal(read) if *read < signal => Some(*read),
            Input::Signal(_) | Input::Length { .. } => None,
        });
        self.waveform_of(first?)
    }
}

/// A part of a scene under the name its user gave it.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T> {
    /// Name, unique among its kind.
    pub name: String,
    /// The part.
    pub part: T,
}

/// A rigid body in the plane. Its coordinates are displacements from the position drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// Mass, kg; needed where x or z is free.
    pub mass: Option<f64>,
    /// Moment of inertia about the reference point, the centre of mass, kg m²; needed where the pitch is free.
    pub inertia: Option<f64>,
    /// Along the slide, m.
    pub x: Coordinate,
    /// Normal to the slide, up, m.
    pub z: Coordinate,
    /// Small angle of rotation, positive from x towards z, rad: a point at (X, Z) from the reference point moves by
    /// (-Zθ, Xθ).
    pub pitch: Coordinate,
}

/// Which coordinate of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Along the slide.
    X,
    /// Normal to the slide.
    Z,
    /// Rotation.
    Pitch,
}

/// A coordinate of a body; SI (m and m/s, rad and rad/s).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coordinate {
    /// What it may do.
    pub freedom: Freedom,
    /// Where it is at t = 0, unless it follows a waveform.
    pub position: f64,
    /// How fast it is at t = 0, where free.
    pub velocity: f64,
}

/// A point of a body relative to its reference point, m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// Along the slide.
    pub x: f64,
    /// Normal to the slide.
    pub z: f64,
}

/// A direction of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// Along the slide.
    #[default]
    X,
    /// Normal to the slide.
    Z,
}

/// What a coordinate may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Freedom {
    /// Stays where it is.
    #[default]
    Fixed,
    /// Obeys Newton.
    Free,
    /// Follows the waveform at this place of [`Scene::waveforms`] or, counted on from the last one, the signal of the block
    /// at this place of [`Scene::blocks`].
    Follows(usize),
    /// Has no mass: it is where loads, springs and contacts balance at every moment. Its position at t = 0 is where it is
    /// drawn; what acts at t = 0 moves it from there in no time.
    Balanced,
}

/// A quantity that may vary in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Varying {
    /// Constant, SI.
    Constant(f64),
    /// Follows the waveform at this place of [`Scene::waveforms`]; a stroke may follow a block, counted on from the last one.
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

impl Side {
    /// The two sides of a contact, spring or actuator.
    ///
    /// # Errors
    /// [`SceneFault::OneBody`] where they are the same.
    pub fn two(first: Self, second: Self) -> Result<[Self; 2], SceneFault> {
        if first == second { Err(SceneFault::OneBody) } else { Ok([first, second]) }
    }
}

/// Linear spring and damper: force on the second body `preload - stiffness·e - damping·ė`, e = x(second) - x(first)
/// or z(second) - z(first) at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// First and second body.
    pub between: [Side; 2],
    /// Its ends on either body.
    pub at: [Point; 2],
    /// Along x or z.
    pub direction: Direction,
    /// Stiffness, N/m, at least 0.
    pub stiffness: f64,
    /// Damping, N s/m, at least 0.
    pub damping: f64,
    /// Force on the second body at e = 0, N.
    pub preload: f64,
}

/// Piezo stack: force on the second body k(s-e) + c(ṡ-ė), e = x(second) - x(first) or z(second) - z(first) at its
/// ends, s the free stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// First and second body.
    pub between: [Side; 2],
    /// Its ends on either body.
    pub at: [Point; 2],
    /// Along x or z.
    pub direction: Direction,
    /// Stiffness k, N/m, above 0.
    pub stiffness: f64,
    /// Damping c, N s/m, at least 0.
    pub damping: f64,
    /// Free stroke s, m.
    pub stroke: Varying,
}

/// Force and moment on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Place of the body in [`Scene::bodies`].
    pub on: usize,
    /// Where the force attacks.
    pub at: Point,
    /// Force along x, N.
    pub x: Varying,
    /// Force along z, N.
    pub z: Varying,
    /// Moment on the pitch, N m.
    pub pitch: Varying,
}

/// Gravity: the slide climbs by `incline` from the horizontal, so the force is -m g sin(incline) along x and
/// -m g cos(incline) along z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gravity {
    /// Acceleration g, m/s².
    pub acceleration: f64,
    /// Angle from the horizontal to the x axis, rad.
    pub incline: f64,
}

impl Gravity {
    /// The accelerations against x and z, m/s²: g sin(incline) and g cos(incline).
    ///
    /// Upright is upright: π/2 is no double, and the cosine of the nearest one, 6e-17, would press a contact on a wall
    /// with 6e-17 of the weight, a contact of rounding alone.
    #[must_use]
    pub fn components(&self) -> (f64, f64) {
        let quarters = (self.incline / FRAC_PI_2).round();
        let turned = (self.incline - quarters * FRAC_PI_2).abs() <= 2.0 * f64::EPSILON * self.incline.abs();
        let (sine, cosine) = match quarters.rem_euclid(4.0) {
            0.0 if turned => (0.0, 1.0),
            1.0 if turned => (1.0, 0.0),
            2.0 if turned => (0.0, -1.0),
            3.0 if turned => (-1.0, 0.0),
            _ => math::sin_cos(self.incline),
        };
        (self.acceleration * sine, self.acceleration * cosine)
    }
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

impl Default for Varying {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl Coordinate {
    /// Free, at rest where it is drawn.
    pub const FREE: Self = Self { freedom: Freedom::Free, position: 0.0, velocity: 0.0 };

    /// Follows the waveform at this place of [`Scene::waveforms`].
    pub fn follows(waveform: usize) -> Self {
        Self { freedom: Freedom::Follows(waveform), ..Self::default() }
    }
}

impl Body {
    /// Whether any of its coordinates is free.
    pub fn is_free(&self) -> bool {
        self.coordinates().iter().any(|(_, coordinate)| coordinate.freedom == Freedom::Free)
    }

    /// Whether any of its coordinates has no mass and is balanced.
    pub fn is_balanced(&self) -> bool {
        self.coordinates().iter().any(|(_, coordinate)| coordinate.freedom == Freedom::Balanced)
    }

    /// Its coordinates with their axes.
    pub fn coordinates(&self) -> [(Axis, Coordinate); 3] {
        [(Axis::X, self.x), (Axis::Z, self.z), (Axis::Pitch, self.pitch)]
    }
}

impl Axis {
    /// The letter or word for it in messages and columns.
    pub fn key(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Z => "z",
            Self::Pitch => "pitch",
        }
    }
}
