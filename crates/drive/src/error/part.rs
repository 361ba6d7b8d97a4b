//! Part and field of a [`Scene`](crate::Scene) or a [`Plan`](crate::Plan) that an error refers to.

use super::SceneFault;
use crate::scene::Axis;
use std::fmt;
use thiserror::Error;

/// Error of an invalid [`Scene`](crate::Scene) or [`Plan`](crate::Plan).
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{part}, {field}: {fault}")]
pub struct SceneError {
    /// Part that the error refers to.
    pub part: Part,
    /// Field of the part.
    pub field: Field,
    /// Fault of the field.
    pub fault: SceneFault,
}

/// Part of a [`Scene`](crate::Scene) by its index, or the [`Plan`](crate::Plan).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Body by index.
    Body(usize),
    /// Contact by index.
    Contact(usize),
    /// Spring by index.
    Spring(usize),
    /// Actuator by index.
    Actuator(usize),
    /// Load by index.
    Load(usize),
    /// Stop by index.
    Stop(usize),
    /// Block by index.
    Block(usize),
    /// Gravity.
    Gravity,
    /// Start and run.
    Run,
}

/// Field of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The part as a whole.
    Whole,
    /// Mass of a body.
    Mass,
    /// Moment of inertia of a body.
    Inertia,
    /// Type of a coordinate of a body.
    Coordinate(Axis),
    /// Initial position of a coordinate of a body.
    Position(Axis),
    /// Initial velocity of a coordinate of a body.
    Velocity(Axis),
    /// Two sides of a contact, spring or actuator.
    Between,
    /// Points of a contact, spring, actuator or load on its bodies.
    Points,
    /// Normal load of a contact.
    Normal,
    /// Normal force of a contact.
    NormalForce,
    /// Prescribed indentation of a contact.
    NormalIndentation,
    /// Prescribed radius of a contact.
    NormalRadius,
    /// Gap of a contact.
    Gap,
    /// Friction of a contact.
    Friction,
    /// Damping of a contact, spring or actuator.
    Damping,
    /// Lowest (0) or highest (1) free position of a stop.
    End(usize),
    /// Damping of a contact along the normal.
    NormalDamping,
    /// Coefficient of restitution of a contact.
    Restitution,
    /// Initial state of a contact, or of the free coordinates.
    Start,
    /// Initial tangential force of a contact.
    StartForce,
    /// Initial displacement of a contact.
    StartDisplacement,
    /// Time at rest before the start.
    StartRest,
    /// Solution of the tangential problem of a contact: memory curve or row of springs.
    Engine,
    /// Number of springs of a row.
    SpringCount,
    /// Length of a row of springs.
    Span,
    /// Number of identical contacts.
    Count,
    /// Stiffness of a spring or actuator.
    Stiffness,
    /// Preload of a spring.
    Preload,
    /// Free stroke of an actuator.
    Stroke,
    /// Body of a load.
    On,
    /// Force or moment of a load on a coordinate.
    Component(Axis),
    /// Acceleration of gravity.
    Acceleration,
    /// Inclination of the slide.
    Incline,
    /// Simulated time.
    Duration,
    /// Interval of the rows of the record.
    Interval,
    /// Relative change of the step length below which the motion counts as steady.
    SteadyChange,
    /// Stepper.
    Stepper,
    /// Tolerance of the stepper of a run.
    Tolerance,
    /// Step length of the stepper of a run.
    Step,
    /// Frame length of a real-time stepper, s.
    Frame,
    /// Accuracy of a frame of a real-time stepper.
    FrameAccuracy,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Body(i) => write!(f, "body {i}"),
            Self::Contact(i) => write!(f, "contact {i}"),
            Self::Spring(i) => write!(f, "spring {i}"),
            Self::Actuator(i) => write!(f, "actuator {i}"),
            Self::Load(i) => write!(f, "load {i}"),
            Self::Stop(i) => write!(f, "stop {i}"),
            Self::Block(i) => write!(f, "block {i}"),
            Self::Gravity => f.write_str("gravity"),
            Self::Run => f.write_str("run"),
        }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Whole => "as a whole",
            Self::Mass => "mass",
            Self::Inertia => "moment of inertia",
            Self::Coordinate(axis) | Self::Component(axis) => axis.key(),
            Self::Position(axis) => return write!(f, "start of {}", axis.key()),
            Self::Velocity(axis) => return write!(f, "initial velocity of {}", axis.key()),
            Self::Between => "sides",
            Self::Points => "points",
            Self::Normal => "normal load",
            Self::NormalForce => "normal force",
            Self::NormalIndentation => "indentation",
            Self::NormalRadius => "contact radius",
            Self::Gap => "gap",
            Self::Friction => "friction",
            Self::Damping => "damping",
            Self::Start => "start",
            Self::StartForce => "initial tangential force",
            Self::StartDisplacement => "initial displacement",
            Self::End(0) => "lowest position",
            Self::End(_) => "highest position",
            Self::NormalDamping => "normal damping",
            Self::Restitution => "restitution",
            Self::StartRest => "initial time at rest",
            Self::Engine => "engine",
            Self::SpringCount => "number of springs",
            Self::Span => "length of the row",
            Self::Count => "number of contacts",
            Self::Stiffness => "stiffness",
            Self::Preload => "preload",
            Self::Stroke => "stroke",
            Self::On => "its body",
            Self::Acceleration => "acceleration",
            Self::Incline => "incline",
            Self::Duration => "duration",
            Self::Interval => "interval of the rows",
            Self::SteadyChange => "relative change of steps",
            Self::Stepper => "stepper",
            Self::Tolerance => "tolerance",
            Self::Step => "step",
            Self::Frame => "frame",
            Self::FrameAccuracy => "accuracy",
        })
    }
}
