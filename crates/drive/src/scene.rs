//! Description of a drive in SI units, as plain data; [`crate::Model::new`] checks it.

mod contact;

pub use contact::{Contact, ContactStart, EngineChoice, Normal, NormalDamping};

use std::f64::consts::FRAC_PI_2;

use crate::component::{Input, SharedBlock};
use crate::{SceneFault, Waveform};

/// Largest rotation for which the linearised kinematics of bodies are used, rad.
///
/// A point that moves along its tangent deviates from its circle by 1 - cos θ relative to its arm: 0.5 % at 0.1 rad.
pub const SMALL_ANGLE: f64 = 0.1;

/// Complete description of a drive.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scene {
    /// Waveforms; other parts refer to them by index.
    pub waveforms: Vec<Named<Waveform>>,
    /// Bodies, in addition to the ground.
    pub bodies: Vec<Named<Body>>,
    /// Contacts between two bodies, or a body and the ground.
    pub contacts: Vec<Named<Contact>>,
    /// Additional components, such as driver electronics.
    pub blocks: Vec<Named<SharedBlock>>,
    /// Linear springs with dampers.
    pub springs: Vec<Named<Spring>>,
    /// Piezo stacks.
    pub actuators: Vec<Named<Actuator>>,
    /// Forces on bodies.
    pub loads: Vec<Load>,
    /// End stops of bodies.
    pub stops: Vec<Named<Stop>>,
    /// Gravity; none by default.
    pub gravity: Gravity,
    /// Initial state of the free coordinates.
    pub start: Start,
}

/// End stops of a body along one axis: springs that act beyond a position only, without tension.
///
/// A stop pushes back with kp + cṗ at the penetration p > 0, but never pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Body by index.
    pub on: usize,
    /// Axis of the stop.
    pub direction: Direction,
    /// Lowest and highest free position of the body, m; `None` without a stop there.
    pub ends: [Option<f64>; 2],
    /// Stiffness k, N/m, above 0.
    pub stiffness: f64,
    /// Damping c, N s/m, at least 0.
    pub damping: f64,
}

impl Scene {
    /// Returns the SI unit of the first quantity that follows a waveform. The unit is empty if no quantity follows the waveform.
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

    /// Returns the index of the waveform that determines a signal, by the first signal input of each block. None without such an input.
    #[must_use]
    pub fn waveform_of(&self, signal: usize) -> Option<usize> {
        let Some(block) = signal.checked_sub(self.waveforms.len()) else { return Some(signal) };
        let inputs = self.blocks.get(block)?.part.0.inputs();
        let first = inputs.iter().find_map(|input| match input {
            // A block reads earlier signals only, so the recursion ends.
            Input::Signal(read) if *read < signal => Some(*read),
            Input::Signal(_) | Input::Length { .. } => None,
        });
        self.waveform_of(first?)
    }
}

/// Part of a [`Scene`] with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T> {
    /// Name, unique among parts of its kind.
    pub name: String,
    /// Part.
    pub part: T,
}

/// Rigid body in the plane. The coordinates of a body are displacements from its reference position.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// Mass, kg; required if x or z is free.
    pub mass: Option<f64>,
    /// Moment of inertia about the reference point, which is the centre of mass, kg m²; required if the pitch is free.
    pub inertia: Option<f64>,
    /// Displacement along the slide, m.
    pub x: Coordinate,
    /// Displacement normal to the slide, upwards, m.
    pub z: Coordinate,
    /// Small rotation, positive from x towards z, rad. A point at (X, Z) from the reference point moves by (-Zθ, Xθ).
    pub pitch: Coordinate,
}

/// Coordinate of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Along the slide.
    X,
    /// Normal to the slide.
    Z,
    /// Rotation.
    Pitch,
}

/// Coordinate of a body, in SI units (m and m/s, rad and rad/s).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coordinate {
    /// Type of the coordinate.
    pub freedom: Freedom,
    /// Position at t = 0, unless the coordinate follows a waveform.
    pub position: f64,
    /// Velocity at t = 0, if free.
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

/// Direction in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Direction {
    /// Along the slide.
    #[default]
    X,
    /// Normal to the slide.
    Z,
}

/// Type of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Freedom {
    /// Does not move.
    #[default]
    Fixed,
    /// Coordinate with inertia, which obeys the equations of motion.
    Free,
    /// Coordinate that follows a signal by index: the waveforms of [`Scene::waveforms`] first, then the blocks of [`Scene::blocks`].
    Follows(usize),
    /// Quasi-static coordinate without mass: its loads, springs and contacts are in equilibrium at all times. Its position before t = 0 is
    /// the reference position; the loads at t = 0 move the coordinate in zero time.
    Balanced,
}

/// A quantity that may vary in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Varying {
    /// Constant value, SI unit.
    Constant(f64),
    /// Value of the waveform with this index in [`Scene::waveforms`]. The stroke of an actuator may also follow a block; indices of blocks
    /// continue after those of waveforms.
    Follows(usize),
}

/// One side of a contact, spring or actuator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Ground, fixed.
    Ground,
    /// Body by its index in [`Scene::bodies`].
    Body(usize),
}

impl Side {
    /// Returns the two sides of a contact, spring or actuator.
    ///
    /// # Errors
    ///
    /// [`SceneFault::OneBody`] if both sides are equal.
    pub fn two(first: Self, second: Self) -> Result<[Self; 2], SceneFault> {
        if first == second { Err(SceneFault::OneBody) } else { Ok([first, second]) }
    }
}

/// Linear spring and damper. The force on the second body is `preload - stiffness·e - damping·ė`, with the elongation e =
/// x(second) - x(first) or z(second) - z(first) of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// First and second body.
    pub between: [Side; 2],
    /// Points of attachment on both bodies.
    pub at: [Point; 2],
    /// Direction, x or z.
    pub direction: Direction,
    /// Stiffness, N/m, at least 0.
    pub stiffness: f64,
    /// Damping, N s/m, at least 0.
    pub damping: f64,
    /// Force on the second body at e = 0, N.
    pub preload: f64,
}

/// Piezo stack. The force on the second body is k(s-e) + c(ṡ-ė), with the elongation e = x(second) - x(first) or z(second) -
/// z(first) of its ends, and the free stroke s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// First and second body.
    pub between: [Side; 2],
    /// Points of attachment on both bodies.
    pub at: [Point; 2],
    /// Direction, x or z.
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
    /// Index of the body in [`Scene::bodies`].
    pub on: usize,
    /// Point of application of the force.
    pub at: Point,
    /// Force along x, N.
    pub x: Varying,
    /// Force along z, N.
    pub z: Varying,
    /// Moment, N m.
    pub pitch: Varying,
}

/// Gravity. The slide rises by `incline` from the horizontal, so the force is -m g sin(incline) along x and -m g cos(incline) along z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gravity {
    /// Acceleration g, m/s².
    pub acceleration: f64,
    /// Inclination of the x axis from the horizontal, rad.
    pub incline: f64,
}

impl Gravity {
    /// Returns g sin(incline) and g cos(incline), m/s², the accelerations opposite to x and z.
    ///
    /// For multiples of π/2 the result is exact: a rounded cos(π/2) = 6e-17 would press a contact against a vertical wall.
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

/// Initial state of the free coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// Positions and velocities given by the bodies.
    #[default]
    Given,
    /// Static equilibrium at t = 0, at rest.
    Equilibrium,
}

impl Default for Varying {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl Coordinate {
    /// Free coordinate, at rest in the reference position.
    pub const FREE: Self = Self { freedom: Freedom::Free, position: 0.0, velocity: 0.0 };

    /// Returns a coordinate that follows the waveform with this index in [`Scene::waveforms`].
    pub fn follows(waveform: usize) -> Self {
        Self { freedom: Freedom::Follows(waveform), ..Self::default() }
    }
}

impl Body {
    /// Whether any coordinate of the body is free.
    pub fn is_free(&self) -> bool {
        self.coordinates().iter().any(|(_, coordinate)| coordinate.freedom == Freedom::Free)
    }

    /// Whether any coordinate of the body is balanced (quasi-static).
    pub fn is_balanced(&self) -> bool {
        self.coordinates().iter().any(|(_, coordinate)| coordinate.freedom == Freedom::Balanced)
    }

    /// Returns the coordinates of the body with their axes.
    pub fn coordinates(&self) -> [(Axis, Coordinate); 3] {
        [(Axis::X, self.x), (Axis::Z, self.z), (Axis::Pitch, self.pitch)]
    }
}

impl Axis {
    /// Returns the name of the axis in messages and columns.
    pub fn key(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Z => "z",
            Self::Pitch => "pitch",
        }
    }
}
