//! Reasons, in the words that a user reads.

use std::fmt;

/// Why something is integrated as it is, or is spared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Why {
    /// No coordinate is free.
    NothingFree,
    /// Places without mass are solved for.
    Balanced,
    /// A single slider among contacts whose energy has a closed form of roots, all dragged alike along a line.
    OneQuadrature,
    /// Gross slip or flight under constant loads.
    ConstantForces,
    /// A swing that has come to rest, or has no turning points.
    AtRest,
    /// No force depends on a velocity.
    NoVelocities,
    /// A damper's force depends on a velocity.
    Damper,
    /// The force of a contact's stuck springs depends on a velocity.
    ContactDamping,
    /// Damped springs that stick and slip by turns, so that no step is long enough between two events.
    Turns,
    /// The power of a load that varies depends on a velocity.
    VaryingLoad,
    /// The force of a contact that grows in full stick depends on its path.
    Growth,
    /// A damper, damped springs or a block settle far faster than all else goes on.
    Stiff,
    /// A block has states of its own.
    Block,
    /// An event is near.
    NearEvent,
    /// A force ends with the power 3/2 of the time.
    SingularMoment,
    /// The stepper was asked for.
    AskedFor,
    /// A contact that nothing ever presses.
    NeverPressed,
    /// A contact that is apart.
    OnlyTheGap,
    /// A contact that drags one edge over one piece of its memory.
    OneEdge,
    /// Followers that make no closed form of u.
    CurvedFollower,
    /// An indentation that varies.
    VaryingIndentation,
    /// No friction: nothing to remember.
    NoFriction,
    /// A row of springs, straight until the next of them changes.
    BetweenSprings,
    /// The whole law of a memory.
    WholeLaw,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NothingFree => "nothing is free: contacts are walked along their path",
            Self::Balanced => {
                "nothing has a mass: places are solved from the balance of forces, contacts walked from event to event"
            }
            Self::OneQuadrature => {
                "one slider, cones, powers up to r⁴ or spheres under constant load, straight waveforms: an interval is one quadrature"
            }
            Self::ConstantForces => "in gross slip or flight all forces are constant",
            Self::AtRest => "where a swing stops or does not reverse",
            Self::NoVelocities => "no force depends on a velocity: a third of the evaluations is spared",
            Self::Damper => "the force of a damper depends on a velocity",
            Self::ContactDamping => "the force of damped stuck springs depends on a velocity",
            Self::VaryingLoad => "the power of a load that varies depends on a velocity",
            Self::Growth => "the force of a contact that grows in full stick depends on its path",
            Self::Stiff => {
                "a damper, damped springs or a driver settle far faster than all else goes on: explicit steps would have to follow them all the time"
            }
            Self::Block => "a block has states of its own beside the motion",
            Self::NearEvent => "where an event is near: it would cut a longer step",
            Self::SingularMoment => {
                "where gross slip or a touch begins or ends, a force goes with the power 3/2 of the time"
            }
            Self::AskedFor => "asked for",
            Self::NeverPressed => "never pressed: it is not evaluated, and nothing looks out for it",
            Self::OnlyTheGap => "while apart: only the gap is watched",
            Self::OneEdge => {
                "one edge is dragged over one piece of the memory: the force is a closed form, the memory moves at events only"
            }
            Self::CurvedFollower => "followers that are neither lines nor a single sum of sines",
            Self::VaryingIndentation => "the indentation varies",
            Self::NoFriction => "no friction",
            Self::BetweenSprings => "forces of a row are straight until one of its springs changes",
            Self::Turns => "damped springs may stick and slip alternately",
            Self::WholeLaw => "the memory is asked at every evaluation",
        })
    }
}
