//! Which part of a scene or a plan is refused, and which of its fields.

use super::SceneFault;
use crate::scene::Axis;
use std::fmt;
use thiserror::Error;

/// A scene that makes no model, or a plan that makes no run.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{part}, {field}: {fault}")]
pub struct SceneError {
    /// Which part.
    pub part: Part,
    /// Which of its fields.
    pub field: Field,
    /// What is wrong with it.
    pub fault: SceneFault,
}

/// A part of a [`Scene`](crate::Scene) by its place in the scene's list, or the [`Plan`](crate::Plan).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A body.
    Body(usize),
    /// A contact.
    Contact(usize),
    /// A spring.
    Spring(usize),
    /// An actuator.
    Actuator(usize),
    /// A load.
    Load(usize),
    /// A block.
    Block(usize),
    /// Gravity.
    Gravity,
    /// How the scene starts and is run.
    Run,
}

/// A field of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The part as a whole.
    Whole,
    /// Mass of a body.
    Mass,
    /// Moment of inertia of a body.
    Inertia,
    /// What a coordinate of a body may do.
    Coordinate(Axis),
    /// Where a coordinate of a body starts.
    Position(Axis),
    /// How fast a coordinate of a body starts.
    Velocity(Axis),
    /// The two sides of a contact, spring or actuator.
    Between,
    /// The points of a contact, spring or actuator on its bodies, or where a load attacks.
    Points,
    /// What presses a contact.
    Normal,
    /// The force that presses a contact.
    NormalForce,
    /// The indentation that is given to a contact.
    NormalIndentation,
    /// The radius that is given to a contact.
    NormalRadius,
    /// Gap of a contact.
    Gap,
    /// Damping of a contact, spring or actuator.
    Damping,
    /// The starting state of a contact, or how the free coordinates start.
    Start,
    /// The tangential force that a contact starts with.
    StartForce,
    /// The displacement that a contact starts with.
    StartDisplacement,
    /// How the tangential problem of a contact is solved.
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
    /// The body that a load acts on.
    On,
    /// Force or moment of a load on a coordinate.
    Component(Axis),
    /// Acceleration of gravity.
    Acceleration,
    /// Incline of the slide.
    Incline,
    /// Simulated time.
    Duration,
    /// Interval of the rows of the trace.
    Interval,
    /// Change of a step that counts as none.
    SteadyChange,
    /// Time stepping.
    Stepper,
    /// Tolerance of the plan's stepper.
    Tolerance,
    /// Step of the plan's stepper.
    Step,
    /// Frame of the plan's stepper.
    Frame,
    /// What may be lost in a frame.
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
            Self::Velocity(axis) => return write!(f, "speed of {} at the start", axis.key()),
            Self::Between => "sides",
            Self::Points => "points",
            Self::Normal => "normal load",
            Self::NormalForce => "normal force",
            Self::NormalIndentation => "indentation",
            Self::NormalRadius => "contact radius",
            Self::Gap => "gap",
            Self::Damping => "damping",
            Self::Start => "start",
            Self::StartForce => "tangential force at the start",
            Self::StartDisplacement => "displacement at the start",
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
            Self::SteadyChange => "change that counts as none",
            Self::Stepper => "stepper",
            Self::Tolerance => "tolerance",
            Self::Step => "step",
            Self::Frame => "frame",
            Self::FrameAccuracy => "accuracy",
        })
    }
}
