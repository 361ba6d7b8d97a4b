//! Faults of a field of a [`Scene`](crate::Scene) or a [`Plan`](crate::Plan).

use super::{Field, Part, SceneError};
use crate::scene::{Axis, SMALL_ANGLE};
use stickslip_contact::{ContactError, FirstLoadingError, SpringsError};
use thiserror::Error;

/// Fault of a field of the input. [`SceneFault::advice`] suggests a remedy.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneFault {
    /// The number is infinite or NaN.
    #[error("expected a finite number, got {0}")]
    NotFinite(f64),
    /// The number is negative or not finite.
    #[error("expected a number of at least 0, got {0}")]
    BelowZero(f64),
    /// The number is not positive or not finite.
    #[error("expected a finite number above 0, got {0}")]
    NotAboveZero(f64),
    /// The number of contacts is zero.
    #[error("expected at least 1 contact, got 0")]
    NoContact,
    /// A side of a contact, or a load, refers to a body that does not exist.
    #[error("there is no body with index {0}")]
    NoBody(usize),
    /// The input refers to a waveform that does not exist.
    #[error("there is no waveform with index {0}")]
    NoWaveform(usize),
    /// Both sides of a contact or spring are the same body.
    #[error("expected two different bodies")]
    OneBody,
    /// A free coordinate has no mass or moment of inertia.
    #[error("{}", no_inertia(*.0))]
    NoInertia(Axis),
    /// No force acts on a free z or pitch coordinate.
    #[error("no part holds {}, which is free", .0.key())]
    Unheld(Axis),
    /// A pitch coordinate is quasi-static ("balanced"), which only x and z can be.
    #[error("a pitch cannot be balanced, only x and z can")]
    BalancedPitch,
    /// A body with a quasi-static ("balanced") coordinate has a mass.
    #[error("{} is balanced, so the body takes no mass: forces alone determine its position", .0.key())]
    BalancedMass(Axis),
    /// The model has both quasi-static ("balanced") and free coordinates.
    #[error("{} is balanced, but other coordinates of the model are free", .0.key())]
    BalancedBesideFree(Axis),
    /// The model has both quasi-static ("balanced") coordinates and blocks.
    #[error("{} is balanced, but stacks or drivers of the model have states of their own", .0.key())]
    BalancedBesideBlock(Axis),
    /// A force depends on the velocity of a quasi-static ("balanced") coordinate.
    #[error("a damper cannot act on a balanced coordinate: its position would depend on its velocity")]
    BalancedDamper,
    /// A contact with two friction coefficients is moved by a quasi-static ("balanced") coordinate.
    #[error(
        "a balanced coordinate would jump when a contact with a kinetic coefficient of friction breaks loose"
    )]
    BalancedBreak,
    /// A body starts beyond the position of a stop, m.
    #[error("the body starts beyond the stop at {0} m")]
    InsideStop(f64),
    /// The lowest position of a stop is not below the highest one.
    #[error("expected the lowest position of a stop below the highest one, got {low} m and {high} m")]
    StopOrder {
        /// Lowest position, m.
        low: f64,
        /// Highest position, m.
        high: f64,
    },
    /// A contact under a prescribed normal force or contact radius is damped along the normal.
    #[error("a contact under a prescribed normal force or contact radius has no damping along the normal")]
    UndampedLoad,
    /// A coefficient of restitution is out of (0, 1], or no free body moves along the normal.
    #[error(
        "expected a coefficient of restitution above 0 and at most 1, and a free body along the normal, got {0}"
    )]
    Restitution(f64),
    /// Two quasi-static ("balanced") coordinates with contacts act on each other.
    #[error("two balanced bodies with contacts act on each other")]
    BalancedTogether,
    /// No force that depends on position acts on a quasi-static ("balanced") coordinate.
    #[error("no force balances {}: no contact with friction and no spring acts along it", .0.key())]
    Unbalanceable(Axis),
    /// The load on a quasi-static ("balanced") coordinate at t = 0 exceeds the limit of its contacts.
    #[error("no force balances {load:.3e} N {} at t = 0: the friction limit of the contacts is {limit:.3e} N", way(*.axis))]
    Unbalanced {
        /// Coordinate.
        axis: Axis,
        /// Load, N.
        load: f64,
        /// Limit of the contacts, N.
        limit: f64,
    },
    /// The bodies of a coupled contact cannot change their distance.
    #[error(
        "neither body moves along the normal: a coupled contact needs a z or a pitch that is free or follows a waveform"
    )]
    Unmoved,
    /// A contact that is open at t = 0 has an initial tangential load.
    #[error("a contact that is open at the start cannot be loaded along x")]
    Open,
    /// The normal load is impossible, or no monotonic loading leads to the initial state.
    #[error(transparent)]
    Loading(#[from] FirstLoadingError),
    /// The row of springs is invalid.
    #[error(transparent)]
    Springs(#[from] SpringsError),
    /// The row of springs is narrower than the contact at t = 0.
    #[error("expected at least the contact's width at the start, {width:.3e} m, got {span:e} m")]
    Narrow {
        /// Width of the contact, m.
        width: f64,
        /// Length of the row, m.
        span: f64,
    },
    /// The length of a damper jumps, so that its impulse is not defined.
    #[error("a damper cannot follow the jumps of waveform `{0}`")]
    DampedJump(String),
    /// The stepper cannot follow waveforms that jump.
    #[error(
        "\"dopri5\" follows no waveform that jumps, and fixed steps follow none with a `balanced` coordinate"
    )]
    UnlocatedJump,
    /// The fixed step is unstable for the fastest motion, or for a state of a block.
    #[error("expected less than {limit:.3e} s, the stability limit, got {step:e} s")]
    Unstable {
        /// Longest stable step, s.
        limit: f64,
        /// Step length, s.
        step: f64,
    },
    /// The model has too many free coordinates for an equilibrium.
    #[error("expected at most {most} free bodies for an equilibrium, got {count}")]
    TooManyFree {
        /// Largest number of free coordinates.
        most: usize,
        /// Number of free coordinates.
        count: usize,
    },
    /// A block has more inputs or states than allowed.
    #[error("expected at most {most} inputs and as many states of a block, got {count}")]
    TooWide {
        /// Largest number of either.
        most: usize,
        /// Larger number of both.
        count: usize,
    },
    /// A block acts on bodies in a model that starts in equilibrium.
    #[error("a model with a block between bodies cannot start in equilibrium")]
    BlockInEquilibrium,
    /// A contact cannot follow the motion of its bodies into static equilibrium.
    #[error("in static equilibrium {0}")]
    Settling(ContactError),
    /// No static equilibrium balances the loads at t = 0.
    #[error(
        "`{body}` has no static equilibrium {}: {unbalanced:.3e} {} remain unbalanced{}",
        way(*.axis), unit(*.axis), if *.shared { ", including the forces of other bodies" } else { "" }
    )]
    NoEquilibrium {
        /// Name of the body.
        body: String,
        /// Coordinate.
        axis: Axis,
        /// Unbalanced force or moment, N or N m.
        unbalanced: f64,
        /// Whether other bodies act along the same axis, so that the imbalance includes their forces.
        shared: bool,
    },
    /// The equilibrium at t = 0 requires an angle that is not small.
    #[error(
        "`{body}` has no static equilibrium in pitch: it would rotate to {angle:.3e} rad, beyond the limit of small angles, {SMALL_ANGLE} rad"
    )]
    Turned {
        /// Name of the body.
        body: String,
        /// Angle, rad.
        angle: f64,
    },
}

impl SceneFault {
    /// Returns the error that consists of this fault, a part and its field.
    pub(crate) fn of(self, part: Part, field: Field) -> SceneError {
        SceneError { part, field, fault: self }
    }

    /// Returns a text that suggests a remedy, if there is one.
    pub fn advice(&self) -> Option<String> {
        let advice = match self {
            Self::NoInertia(axis) => {
                let example = if *axis == Axis::Pitch { "\"inertia\": 2e-7" } else { "\"mass\": \"10 g\"" };
                return Some(format!("add {example}, or make {} \"fixed\"", axis.key()));
            }
            Self::Unheld(Axis::Pitch) => {
                "give a contact, spring or actuator of this body a point \"at\" away from its reference \
                 point, or make pitch \"fixed\""
            }
            Self::Unheld(Axis::X | Axis::Z) => {
                "make the \"normal\" of a contact of this body \"coupled\", add a spring with \"direction\": \"z\", or \
                 make z \"fixed\""
            }
            Self::BalancedMass(axis) => {
                return Some(format!("remove the mass, or make {} \"free\"", axis.key()));
            }
            Self::BalancedPitch
            | Self::BalancedBesideFree(_)
            | Self::BalancedBesideBlock(_)
            | Self::BalancedDamper
            | Self::BalancedBreak
            | Self::BalancedTogether
            | Self::Unbalanceable(_)
            | Self::Unbalanced { .. } => self.advice_on_balance(),
            Self::InsideStop(_)
            | Self::StopOrder { .. }
            | Self::UndampedLoad
            | Self::Restitution(_)
            | Self::Unmoved
            | Self::Open
            | Self::Springs(_)
            | Self::Narrow { .. }
            | Self::DampedJump(_)
            | Self::UnlocatedJump
            | Self::Settling(_) => self.advice_on_impacts(),
            Self::Loading(FirstLoadingError::Undetermined | FirstLoadingError::BeyondProfile { .. }) => {
                self.advice_on_impacts()
            }
            Self::Unstable { .. } => {
                "use a twentieth of this limit for accuracy, or the stepper event, which needs no time step"
            }
            Self::TooManyFree { .. } | Self::BlockInEquilibrium => "give the start positions of the bodies",
            Self::NoEquilibrium { axis: Axis::Z, .. } => {
                "reduce the load, increase the normal force, or start from rest; the first body in \
                 \"between\" of a coupled contact is the lower one"
            }
            Self::NoEquilibrium { .. } | Self::Turned { .. } => {
                "reduce the load, increase the normal force, or start from rest"
            }
            Self::NotFinite(_)
            | Self::BelowZero(_)
            | Self::NotAboveZero(_)
            | Self::NoContact
            | Self::NoBody(_)
            | Self::NoWaveform(_)
            | Self::TooWide { .. }
            | Self::OneBody
            | Self::Loading(_) => return None,
        };
        Some(advice.to_owned())
    }

    /// Returns a text that suggests a remedy for a fault of a stop or of the damping along a normal.
    fn advice_on_impacts(&self) -> &'static str {
        match self {
            Self::DampedJump(_) => "give the waveform a flyback above 0",
            Self::UnlocatedJump => "use the stepper `event`, or a waveform with a flyback above 0 s",
            Self::Settling(_) => "give the row a larger span, or use the engine \"curve\"",
            Self::Loading(FirstLoadingError::Undetermined) => "give the normal force or the indentation",
            Self::Loading(FirstLoadingError::BeyondProfile { .. }) => {
                "reduce the load, or increase the radius or the range of the profile"
            }
            Self::Springs(_) | Self::Narrow { .. } => {
                "leave the span out: the row then covers the largest contact"
            }
            Self::Unmoved => {
                "make z of one of the bodies \"free\", or give the contact a normal \"force\" or \"indentation\""
            }
            Self::Open => "press it at t = 0, or leave it \"untouched\"",
            Self::InsideStop(_) => "move the stop, or let the body start between the stops",
            Self::StopOrder { .. } => "the first position is the lowest one; null means no stop",
            Self::UndampedLoad => "remove the damping along the normal, or make \"normal\" \"coupled\"",
            _ => "1 is an impact without loss; give the damping time \"normal\" if a waveform moves the body",
        }
    }

    /// Returns a text that suggests a remedy for a fault of a quasi-static coordinate.
    fn advice_on_balance(&self) -> &'static str {
        match self {
            Self::BalancedPitch => "make pitch \"fixed\"",
            Self::BalancedBesideFree(_) => {
                "make the other coordinates \"balanced\" or \"fixed\", or let them follow a waveform"
            }
            Self::BalancedBesideBlock(_) => "use a linear stack without a driver, or a spring",
            Self::BalancedBreak => {
                "give one friction coefficient, or make the coordinate \"free\" and give it a mass"
            }
            Self::BalancedDamper => "remove the damping, or make the coordinate \"free\" and give it a mass",
            Self::BalancedTogether => {
                "let one of them follow a waveform, or join them to a body without a contact"
            }
            Self::Unbalanceable(_) => {
                "give the body a contact (along z one whose \"normal\" is \"coupled\"), or a spring with stiffness"
            }
            Self::Unbalanced { axis: Axis::Z, .. } => {
                "press the body against its contacts, or hold it by a spring"
            }
            _ => "reduce the load, increase the normal force, or hold the body by a spring",
        }
    }
}

fn no_inertia(axis: Axis) -> &'static str {
    match axis {
        Axis::X | Axis::Z => "a body with a free coordinate needs a mass",
        Axis::Pitch => "a body whose pitch is free needs a moment of inertia",
    }
}

fn way(axis: Axis) -> &'static str {
    match axis {
        Axis::X => "along x",
        Axis::Z => "along z",
        Axis::Pitch => "in pitch",
    }
}

fn unit(axis: Axis) -> &'static str {
    match axis {
        Axis::X | Axis::Z => "N",
        Axis::Pitch => "N m",
    }
}
