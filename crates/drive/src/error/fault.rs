//! What can be wrong with a field of a scene or a plan.

use super::{Field, Part, SceneError};
use crate::scene::{Axis, SMALL_ANGLE};
use stickslip_contact::{ContactError, FirstLoadingError, SpringsError};
use thiserror::Error;

/// What is wrong with a field. [`SceneFault::advice`] says what to try.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneFault {
    /// Infinite or not a number.
    #[error("expected a finite number, got {0}")]
    NotFinite(f64),
    /// Below zero or not finite.
    #[error("expected a number of at least 0, got {0}")]
    BelowZero(f64),
    /// Zero, below or not finite.
    #[error("expected a finite number above 0, got {0}")]
    NotAboveZero(f64),
    /// No contact at all.
    #[error("expected at least 1 contact, got 0")]
    NoContact,
    /// A side, or the body of a load, that is not in the scene.
    #[error("there is no body at place {0}")]
    NoBody(usize),
    /// A waveform that is not in the scene.
    #[error("there is no waveform at place {0}")]
    NoWaveform(usize),
    /// Both sides are the same.
    #[error("expected two different bodies")]
    OneBody,
    /// A coordinate obeys Newton, but nothing says how slowly.
    #[error("{}", no_inertia(*.0))]
    NoInertia(Axis),
    /// A free z or pitch on which nothing acts.
    #[error("nothing holds {}, which is free", .0.key())]
    Unheld(Axis),
    /// A balanced pitch.
    #[error("a pitch cannot be balanced, only x and z can")]
    BalancedPitch,
    /// A mass of a body whose place satisfies a balance without one.
    #[error("{} is balanced, without mass: forces alone set its place", .0.key())]
    BalancedMass(Axis),
    /// A balanced coordinate in a scene with free ones.
    #[error("{} is balanced in a scene where other coordinates are free", .0.key())]
    BalancedBesideFree(Axis),
    /// A balanced coordinate in a scene with blocks.
    #[error("{} is balanced in a scene whose stacks or drivers have states of their own", .0.key())]
    BalancedBesideBlock(Axis),
    /// A force that depends on the velocity of a balanced coordinate.
    #[error("a damper cannot act on a balanced coordinate: its place would depend on its velocity")]
    BalancedDamper,
    /// Two balanced coordinates that must be solved for together.
    #[error("two balanced bodies, each with a contact, act on each other")]
    BalancedTogether,
    /// A balanced coordinate on which nothing acts that could balance a load.
    #[error("nothing balances {}: no contact with friction and no spring acts along it", .0.key())]
    Unbalanceable(Axis),
    /// The load of t = 0 on a balanced coordinate is more than what holds it.
    #[error("nothing balances {load:.3e} N {} at t = 0: the contacts hold {limit:.3e} N", way(*.axis))]
    Unbalanced {
        /// The coordinate.
        axis: Axis,
        /// What pulls, N.
        load: f64,
        /// What the contacts hold, N.
        limit: f64,
    },
    /// A coupled contact between bodies that keep their distance.
    #[error(
        "neither body moves along the normal: a coupled contact needs a z or a pitch that is free or follows a waveform"
    )]
    Unmoved,
    /// A contact that does not touch at t = 0 is to start with a tangential load.
    #[error("a contact that is open at the start cannot be loaded along x")]
    Open,
    /// A contact cannot be pressed like that, or no monotonic loading reaches its start.
    #[error(transparent)]
    Loading(#[from] FirstLoadingError),
    /// There is no such row of springs.
    #[error(transparent)]
    Springs(#[from] SpringsError),
    /// A row of springs that is narrower than its contact at t = 0.
    #[error("expected at least the contact's width at the start, {width:.3e} m, got {span:e} m")]
    Narrow {
        /// Width of the contact, m.
        width: f64,
        /// Length of the row, m.
        span: f64,
    },
    /// A damper whose length jumps: its impulse would be a matter of definition.
    #[error("a damper cannot follow the jumps of waveform `{0}`")]
    DampedJump(String),
    /// Steps of a given length or without events on waveforms that jump.
    #[error("only the steppers \"event\" and \"frames\" follow waveforms that jump")]
    UnlocatedJump,
    /// A fixed step with which the fastest motion, or a state of a block, grows.
    #[error("expected less than {limit:.3e} s, from where on the fastest motion grows, got {step:e} s")]
    Unstable {
        /// Longest stable step, s.
        limit: f64,
        /// The step, s.
        step: f64,
    },
    /// The search for an equilibrium would take too long.
    #[error("expected at most {most} free bodies for an equilibrium, got {count}")]
    TooManyFree {
        /// Most free coordinates.
        most: usize,
        /// Number of free coordinates.
        count: usize,
    },
    /// A block reads, or carries as states, more than there is room for.
    #[error("expected at most {most} inputs and as many states of a block, got {count}")]
    TooWide {
        /// Most of either.
        most: usize,
        /// Number of the more numerous.
        count: usize,
    },
    /// A block that pushes on bodies is no part of the statics.
    #[error("a scene with a block between bodies cannot start in equilibrium")]
    BlockInEquilibrium,
    /// A contact cannot follow its bodies into equilibrium.
    #[error("in static equilibrium {0}")]
    Settling(ContactError),
    /// Nothing balances what acts at t = 0.
    #[error(
        "`{body}` has no static equilibrium {}: {unbalanced:.3e} {} stay unbalanced{}",
        way(*.axis), unit(*.axis), if *.shared { ", what other bodies put on it included" } else { "" }
    )]
    NoEquilibrium {
        /// Name of the body.
        body: String,
        /// Its coordinate.
        axis: Axis,
        /// Force or moment that nothing balances, N or N m.
        unbalanced: f64,
        /// Whether other bodies push and pull at it, too: held, it bears what they cannot hold either.
        shared: bool,
    },
    /// What acts at t = 0 is in balance beyond small angles only.
    #[error(
        "`{body}` has no static equilibrium in pitch: it would turn to {angle:.3e} rad, and angles up to {SMALL_ANGLE} rad are small"
    )]
    Turned {
        /// Name of the body.
        body: String,
        /// Its angle there, rad.
        angle: f64,
    },
}

impl SceneFault {
    /// The fault in its place.
    pub(crate) fn of(self, part: Part, field: Field) -> SceneError {
        SceneError { part, field, fault: self }
    }

    /// What to try.
    pub fn advice(&self) -> Option<String> {
        let advice = match self {
            Self::NoInertia(axis) => {
                let example = if *axis == Axis::Pitch { "\"inertia\": 2e-7" } else { "\"mass\": \"10 g\"" };
                return Some(format!("add {example}, or make {} \"fixed\"", axis.key()));
            }
            Self::Unheld(Axis::Pitch) => {
                "give a contact, spring or actuator of this body a point \"at\" beside its reference point, or make \
                 pitch \"fixed\""
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
            | Self::BalancedTogether
            | Self::Unbalanceable(_)
            | Self::Unbalanced { .. } => self.advice_on_balance(),
            Self::Unmoved => {
                "make z of one of the bodies \"free\", or give the contact a normal \"force\" or \"indentation\""
            }
            Self::Loading(FirstLoadingError::Undetermined) => "give the normal force or the indentation",
            Self::Loading(FirstLoadingError::BeyondProfile { .. }) => {
                "lower the load, or enlarge the radius or the table of the profile"
            }
            Self::Open => "press it at t = 0, or leave it \"untouched\"",
            Self::Springs(_) | Self::Narrow { .. } => {
                "leave the span out: the row is then as wide as the contact ever is"
            }
            Self::DampedJump(_) => "give the waveform a flyback above 0",
            Self::UnlocatedJump => "take the event stepper, or give the waveform a flyback above 0",
            Self::Unstable { .. } => {
                "take a twentieth of that for accuracy, or the event stepper, which needs no step"
            }
            Self::TooManyFree { .. } | Self::BlockInEquilibrium => "give the bodies where they start",
            Self::Settling(_) => "give the row a longer span, or use the engine \"curve\"",
            Self::NoEquilibrium { axis: Axis::Z, .. } => {
                "lower the load, press harder, or start from rest instead; of a coupled contact the lower body is the first in \
                 \"between\""
            }
            Self::NoEquilibrium { .. } | Self::Turned { .. } => {
                "lower the load, press harder, or start from rest instead"
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

    /// What to try where a body is to be balanced.
    fn advice_on_balance(&self) -> &'static str {
        match self {
            Self::BalancedPitch => "make pitch \"fixed\"",
            Self::BalancedBesideFree(_) => {
                "make the others \"balanced\" or \"fixed\", or let them follow a waveform"
            }
            Self::BalancedBesideBlock(_) => "take a stack that is linear and has no driver, or a spring",
            Self::BalancedDamper => "remove the damping, or make the coordinate \"free\" and give it a mass",
            Self::BalancedTogether => {
                "let one of them follow a waveform, or join them to a body without a contact"
            }
            Self::Unbalanceable(_) => {
                "give the body a contact (along z one whose \"normal\" is \"coupled\"), or a spring with stiffness"
            }
            Self::Unbalanced { axis: Axis::Z, .. } => {
                "press the body onto its contacts, or hold it by a spring"
            }
            _ => "lower the load, press harder, or hold the body by a spring",
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
