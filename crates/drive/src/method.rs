//! Choice of the integration method for each time interval, with the reason for the choice.
//!
//! A run calls [`choice`] at the beginning of every interval between two events, and [`treatment`] for every contact. [`Model::expected`]
//! calls the same functions for all possible intervals, so the prediction agrees with the run.
//!
//! | method | free coordinates | forces |
//! | --- | --- | --- |
//! | [`Method::Walk`] | none | prescribed paths |
//! | [`Method::Parabola`] | any; one over sinusoidal prescribed motions | constant until the next event |
//! | [`Method::Swing`] | one | closed forms of u with linear prescribed motions |
//! | [`Method::Nystrom`] | any | independent of velocities |
//! | [`Method::Radau`] | any | stiff |
//! | [`Method::DormandPrince`] | any | all others |
//!
//! At tolerances down to [`TIGHTEST_BRIEF`] both explicit methods have a variant of lower order with fewer stages, [`Method::brief`], used
//! for steps that an event will soon cut. Graded steps always use Dormand–Prince, because their stages need velocities.

mod expected;
mod tally;
mod why;

use crate::contact::Contact;
pub use expected::Expected;
pub use tally::Tally;
pub use why::Why;

use crate::model::Model;
use stickslip_contact::{Branch, Law};

/// Smallest tolerance at which explicit methods with fewer stages are used near events.
const TIGHTEST_BRIEF: f64 = 1e-6;

/// Integration method of a time interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// Steps from event to event along prescribed paths of the contacts, without free coordinates.
    Walk,
    /// Closed-form oscillation of a single slider from event to event, by one quadrature.
    Swing,
    /// Parabolic motion under constant forces, without evaluations of the equations.
    Parabola,
    /// Runge–Kutta–Nyström steps of order 8(6).
    Nystrom,
    /// Nyström steps of order 5 with half the stages, near an event, if the tolerance allows them.
    BriefNystrom,
    /// Dormand–Prince steps of order 8(5,3).
    DormandPrince,
    /// Dormand–Prince steps of order 5(4) with half the stages, near an event, if the tolerance allows them.
    Brief,
    /// Implicit Radau IIA steps of order 9, for stiff models.
    Radau,
    /// Graded step of order 8(5,3), with stages concentrated near a singular moment (power 3/2 of time) at one end of the step.
    Graded,
    /// Runge–Kutta steps with step doubling on the full force law, where events accumulate.
    Whole,
    /// Steps of the requested stepper, without event location.
    AskedFor,
}

impl Method {
    /// Returns the variant with fewer stages for a step that an event will soon cut; `None` if the method has no such variant.
    pub(crate) fn in_few_stages(self) -> Option<Self> {
        match self {
            Self::Nystrom => Some(Self::BriefNystrom),
            Self::DormandPrince => Some(Self::Brief),
            _ => None,
        }
    }

    /// Returns the variant with fewer stages if it is accurate enough; `None` below a tolerance, and for rows of springs under constant
    /// load.
    // In such rows, few stages miss the kinks of single springs, which slip one by one. At small tolerances, few stages save nothing.
    pub(crate) fn brief(self, model: &Model, tolerance: f64) -> Option<Self> {
        let slips = |contact: &Contact| !contact.engine.branches() && !contact.inert && contact.is_constant();
        let few = self.in_few_stages()?;
        (tolerance >= TIGHTEST_BRIEF && !model.contacts.iter().any(slips)).then_some(few)
    }
}

/// Treatment of a contact between two events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Treatment {
    /// The contact is never evaluated, because it is never pressed.
    Spared,
    /// The contact is open, and only its gap is monitored.
    Apart,
    /// The force is a closed form of u; the slip memory is updated at the next event only.
    Closed,
    /// The contact uses the general equations; its slip memory is updated in every step.
    General,
}

/// Properties of a model that determine the integration method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SceneTraits {
    /// Number of free coordinates.
    pub(crate) free: usize,
    /// Whether the model has quasi-static ("balanced") coordinates.
    pub(crate) balanced: bool,
    /// Whether the model is stiff.
    pub(crate) stiff: bool,
    /// Reason why forces depend on velocities; `None` if no force does.
    pub(crate) velocities: Option<Why>,
    /// Whether springs, dampers or actuators act.
    pub(crate) links: bool,
    /// Whether loads vary in time.
    pub(crate) loads: bool,
}

/// Properties of a time interval between two events that determine the integration method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct IntervalTraits {
    /// Whether every contact is open or in gross slip.
    pub(crate) slides: bool,
    /// Whether the prescribed motions of all contacts with closed-form forces have constant rates.
    pub(crate) straight: bool,
    /// Whether a contact uses the general equations.
    pub(crate) general: bool,
    /// Whether the gap of an open contact may close.
    pub(crate) gap: bool,
    /// Whether the closed-form oscillation was tried without success in this interval, so that it is not tried again before the next event.
    pub(crate) asked: bool,
}

impl SceneTraits {
    pub(crate) fn of(model: &Model) -> Self {
        Self {
            free: model.free.len(),
            balanced: !model.balanced.is_empty(),
            stiff: model.stiff,
            velocities: velocities(model),
            links: !model.links.is_empty(),
            loads: !model.loads.is_empty(),
        }
    }
}

/// Returns the reason why forces, or rates of integrals, depend on velocities; `None` if they do not.
fn velocities(model: &Model) -> Option<Why> {
    let damped = model.links.iter().any(|link| link.damping > 0.0);
    let stuck = model.contacts.iter().any(|c| c.interface.damping() > 0.0 || c.normal_damping > 0.0);
    match () {
        () if damped => Some(Why::Damper),
        () if stuck => Some(Why::ContactDamping),
        // The power of a varying load is a force times a velocity.
        () if !model.loads.is_empty() => Some(Why::VaryingLoad),
        // Ḟ = G*m(d)u̇ needs velocities, which Nyström stages do not have.
        () if model.growing > 0 => Some(Why::Growth),
        () if !model.blocks.is_empty() => Some(Why::Block),
        () => None,
    }
}

impl IntervalTraits {
    /// Returns whether only contacts with closed-form forces and loads act.
    fn is_closed(&self, scene: &SceneTraits) -> bool {
        !self.general && !scene.links
    }

    /// Returns whether only closed-form contacts and loads act, and all prescribed motions have constant rates.
    pub(crate) fn is_simple(&self, scene: &SceneTraits) -> bool {
        self.straight && self.is_closed(scene)
    }

    /// Returns whether all forces are constant in the interval.
    pub(crate) fn is_constant(&self, scene: &SceneTraits) -> bool {
        self.slides && self.is_simple(scene) && !scene.loads
    }

    /// Returns whether the interval of a single slider can be solved in one step to its next event. In gross slip this includes sinusoidal
    /// prescribed motions, which do not change the forces.
    #[inline(always)]
    pub(crate) fn leaps(&self, scene: &SceneTraits) -> bool {
        let has_form = self.is_closed(scene) && (self.straight || self.slides);
        scene.free == 1 && scene.velocities.is_none() && has_form && !self.gap && !self.asked
    }
}

/// Returns the integration method of an interval, with the reason.
pub(crate) fn choice(scene: &SceneTraits, interval: &IntervalTraits) -> (Method, Why) {
    // A parabola is exact for any number of coordinates and comes first.
    if scene.free > 0 && interval.is_constant(scene) {
        (Method::Parabola, Why::ConstantForces)
    } else if interval.leaps(scene) {
        if interval.slides {
            (Method::Parabola, Why::ConstantForces)
        } else {
            (Method::Swing, Why::OneQuadrature)
        }
    } else {
        stepping(scene)
    }
}

/// Returns the integration method of intervals without a closed form, with the reason.
pub(crate) fn stepping(scene: &SceneTraits) -> (Method, Why) {
    match scene.velocities {
        // Positions follow from time; steps lead from event to event.
        _ if scene.balanced => (Method::Walk, Why::Balanced),
        // States of blocks may be stiff even without free coordinates.
        _ if scene.stiff => (Method::Radau, Why::Stiff),
        _ if scene.free == 0 => (Method::Walk, Why::NothingFree),
        None => (Method::Nystrom, Why::NoVelocities),
        Some(why) => (Method::DormandPrince, why),
    }
}

/// Returns whether a slipping contact has no damping force. Only sticking springs are damped, and no spring sticks in gross slip.
pub(crate) fn is_undamped(contact: &Contact, branch: &Branch) -> bool {
    contact.interface.damping() == 0.0 || branch.is_gross()
}

/// Returns the treatment of a contact under a law, with the reason. `followed` returns whether the prescribed part of u has a closed form.
#[inline(always)]
pub(crate) fn treatment(contact: &Contact, law: &Law, followed: impl FnOnce() -> bool) -> (Treatment, Why) {
    let why = match law.branch() {
        _ if contact.is_never_pressed() => return (Treatment::Spared, Why::NeverPressed),
        _ if law.is_open() => return (Treatment::Apart, Why::OnlyTheGap),
        Some(_) if !contact.is_constant() => Why::VaryingIndentation,
        Some(branch) if !is_undamped(contact, branch) => Why::ContactDamping,
        Some(_) if followed() => return (Treatment::Closed, Why::OneEdge),
        Some(_) => Why::CurvedFollower,
        None if contact.normal_damping > 0.0 => Why::ContactDamping,
        None if law.grows() => Why::Growth,
        None if law.lull().is_some() => Why::BetweenSprings,
        None if contact.inert => Why::NoFriction,
        None => Why::WholeLaw,
    };
    (Treatment::General, why)
}
