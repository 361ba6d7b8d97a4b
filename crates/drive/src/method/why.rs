//! Reasons for integration methods and for treatments of contacts.

use std::fmt;

/// Reason for an integration method or a treatment of a contact. The displayed text is for reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Why {
    /// No coordinate is free.
    NothingFree,
    /// Coordinates are quasi-static ("balanced").
    Balanced,
    /// A single slider has contacts whose energy has a closed form, all with the same linear prescribed motion.
    OneQuadrature,
    /// All forces are constant: gross slip or flight under constant loads.
    ConstantForces,
    /// The motion is at rest or has no turning points.
    AtRest,
    /// No force depends on a velocity.
    NoVelocities,
    /// The force of a damper depends on a velocity.
    Damper,
    /// The damping force of sticking springs depends on a velocity.
    ContactDamping,
    /// The power of a varying load depends on a velocity.
    VaryingLoad,
    /// The force of a contact that grows in full stick depends on the path of the contact.
    Growth,
    /// Motions of a damper, damped contact springs or a block decay much faster than all other motions.
    Stiff,
    /// A block has states.
    Block,
    /// An event is near and would cut a longer step.
    NearEvent,
    /// A force varies with the power 3/2 of time at one end of the step.
    SingularMoment,
    /// The user requested this stepper.
    AskedFor,
    /// The contact is never pressed.
    NeverPressed,
    /// The contact is open.
    OnlyTheGap,
    /// Slip spreads from the contact edge along one segment of the slip memory.
    OneEdge,
    /// The prescribed motion has no closed form.
    CurvedFollower,
    /// The indentation varies.
    VaryingIndentation,
    /// The contact has no friction and thus no slip memory.
    NoFriction,
    /// The forces of a row of springs are linear until a spring changes its state.
    BetweenSprings,
    /// The slip memory computes the full force law.
    WholeLaw,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NothingFree => "no coordinate is free: contacts follow prescribed paths",
            Self::Balanced => {
                "no body has a mass: positions follow from the balance of forces"
            }
            Self::OneQuadrature => {
                "one slider, cones, powers up to r⁴ or spheres under constant load, straight waveforms: an interval is one quadrature"
            }
            Self::ConstantForces => "all forces are constant in gross slip or flight",
            Self::AtRest => "the motion comes to rest or does not reverse",
            Self::NoVelocities => "no force depends on a velocity: this saves a third of the evaluations",
            Self::Damper => "the force of a damper depends on a velocity",
            Self::ContactDamping => "the force of damped stuck springs depends on a velocity",
            Self::VaryingLoad => "the power of a load that varies depends on a velocity",
            Self::Growth => "the force of a contact that grows in full stick depends on its path",
            Self::Stiff => {
                "stiff: a damper, damped springs or a driver settle much faster than the motion"
            }
            Self::Block => "a block has states of its own",
            Self::NearEvent => "an event is near and would cut a longer step",
            Self::SingularMoment => {
                "gross slip or contact begins or ends: a force varies with the power 3/2 of time"
            }
            Self::AskedFor => "chosen in the scenario",
            Self::NeverPressed => "never pressed: forces and events are not evaluated",
            Self::OnlyTheGap => "open contact: only the gap is evaluated",
            Self::OneEdge => {
                "slip advances along one segment of the memory: the force has a closed form, the memory changes only at events"
            }
            Self::CurvedFollower => "the prescribed motion is neither piecewise linear nor a sum of sines",
            Self::VaryingIndentation => "the indentation varies",
            Self::NoFriction => "no friction",
            Self::BetweenSprings => "the forces of a row are linear until one of its springs changes state",
            Self::WholeLaw => "the memory is evaluated at every stage",
        })
    }
}
