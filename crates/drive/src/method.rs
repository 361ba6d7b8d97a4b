//! Which method integrates what, and why: decided here and nowhere else.
//!
//! A run asks [`choice`] at the beginning of every interval between two events and [`treatment`] of every contact in it;
//! [`Model::expected`] asks the same two functions of the intervals that a scene can come to, so that what is told of a run
//! beforehand is what it does.
//!
//! | method | free coordinates | forces |
//! | --- | --- | --- |
//! | [`Method::Walk`] | none | prescribed paths |
//! | [`Method::Parabola`] | any; one over followers on sines | constant until the next event |
//! | [`Method::Swing`] | one | closed forms of u under straight followers |
//! | [`Method::Nystrom`] | any | without velocities |
//! | [`Method::Radau`] | any | of what settles far faster than all else goes on |
//! | [`Method::DormandPrince`] | any | all others |
//!
//! At tolerances down to [`TIGHTEST_BRIEF`] a step of the two explicit methods that an event will end soon goes by one of
//! fewer stages, [`Method::brief`].
//!
//! A graded step goes by Dormand and Prince's pair wherever it is taken: its stages ask for velocities.

mod expected;
mod tally;
mod why;

use crate::contact::{Contact, Mode, Press};
pub use expected::Expected;
pub use tally::Tally;
pub use why::Why;

use crate::model::Model;
use stickslip_contact::Branch;

/// Tightest tolerance at which steps of few stages are taken.
const TIGHTEST_BRIEF: f64 = 1e-6;

/// How a stretch of time is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Method {
    /// Nothing is free: the contacts are walked along their prescribed path from event to event.
    Walk,
    /// A single slider swings from event to event by one quadrature of time.
    Swing,
    /// All forces are constant: positions run along parabolas, nothing is evaluated.
    Parabola,
    /// Steps of the Runge–Kutta–Nyström pair of order 8(6).
    Nystrom,
    /// Steps of Nyström's method of order 5, of half the stages, where an event is near and the tolerance allows.
    BriefNystrom,
    /// Steps of Dormand and Prince's Runge–Kutta pair of order 8(5,3).
    DormandPrince,
    /// Steps of their pair of order 5(4), of half the stages, where an event is near and the tolerance allows.
    Brief,
    /// Steps of the implicit method Radau IIA of order 9: what settles within a step need not be followed.
    Radau,
    /// A step of order 8(5,3) whose stages crowd towards a singular moment at one of its ends.
    Graded,
    /// Runge–Kutta steps by the whole law of the contacts, against their halves, where events accumulate.
    Whole,
    /// Steps of whichever stepper was asked for, one without located events.
    AskedFor,
}

impl Method {
    /// The method of a step that an event will end soon, of fewer stages than this one's; none where there is none.
    pub(crate) fn in_few_stages(self) -> Option<Self> {
        match self {
            Self::Nystrom => Some(Self::BriefNystrom),
            Self::DormandPrince => Some(Self::Brief),
            _ => None,
        }
    }

    /// The same where such steps are worth their errors: down to a tolerance, and where no springs of a row slip one by one on the way.
    // Few stages step over what these do. Of two drawn drives on 16 springs errors at 1e-6 were 600 and 270 tolerances with such steps, and
    // are 10 and 0.2 for 10 % more evaluations. At 1e-9 they spare nothing, and at 1e-10 the books of a stage on damped springs, which no
    // estimate sees, were twice as far off (1.1e-8).
    pub(crate) fn brief(self, model: &Model, tolerance: f64) -> Option<Self> {
        let slips = |contact: &Contact| !contact.engine.branches() && !contact.inert && contact.is_constant();
        let few = self.in_few_stages()?;
        (tolerance >= TIGHTEST_BRIEF && !model.contacts.iter().any(slips)).then_some(few)
    }
}

/// What is done about one contact between two events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Treatment {
    /// Nothing: it is never pressed.
    Spared,
    /// Only its gap is looked at.
    Apart,
    /// Its force is one closed form of u, and its memory stays where it is until the next event.
    Closed,
    /// It goes through the general equations, and its memory through every step.
    General,
}

/// What of a scene decides the method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SceneTraits {
    /// Number of free coordinates.
    pub(crate) free: usize,
    /// Whether places without mass are solved for.
    pub(crate) balanced: bool,
    /// Whether something settles far faster than all else goes on.
    pub(crate) stiff: bool,
    /// Why forces depend on velocities, if they do.
    pub(crate) velocities: Option<Why>,
    /// Whether springs, dampers or actuators act.
    pub(crate) links: bool,
    /// Whether loads vary in time.
    pub(crate) loads: bool,
}

/// What of an interval between two events decides it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct IntervalTraits {
    /// Whether every contact that is not apart is in gross slip.
    pub(crate) slides: bool,
    /// Whether what drags the contacts of closed form moves at constant rates.
    pub(crate) straight: bool,
    /// Whether a contact goes through the general equations.
    pub(crate) general: bool,
    /// Whether a gap may close.
    pub(crate) gap: bool,
    /// Whether the closed form of a swing has been asked for: what has none now has none until the next event.
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

/// Why a model's forces, or the rates of what is integrated beside its motion, depend on velocities.
fn velocities(model: &Model) -> Option<Why> {
    let damped = model.links.iter().any(|link| link.damping > 0.0);
    let stuck = model.contacts.iter().any(|contact| contact.interface.damping() > 0.0);
    match () {
        () if damped => Some(Why::Damper),
        () if stuck => Some(Why::ContactDamping),
        // The power of a load that varies is a force times a velocity.
        () if !model.loads.is_empty() => Some(Why::VaryingLoad),
        // Ḟ = G*m(d)u̇ is a rate, and Nyström's stages have no velocities.
        () if model.growing > 0 => Some(Why::Growth),
        () if !model.blocks.is_empty() => Some(Why::Block),
        () => None,
    }
}

impl IntervalTraits {
    /// Whether nothing acts but contacts of closed form and constant loads.
    fn is_closed(&self, scene: &SceneTraits) -> bool {
        !self.general && !scene.links
    }

    /// The same where what drags them moves at constant rates.
    pub(crate) fn is_simple(&self, scene: &SceneTraits) -> bool {
        self.straight && self.is_closed(scene)
    }

    /// Whether all forces are the same throughout.
    pub(crate) fn is_constant(&self, scene: &SceneTraits) -> bool {
        self.slides && self.is_simple(scene) && !scene.loads
    }

    /// Whether the interval of a single slider is to be taken in one leap to its next event: in gross slip also over followers
    /// on sines, which change nothing of the forces.
    #[inline(always)]
    pub(crate) fn leaps(&self, scene: &SceneTraits) -> bool {
        let has_form = self.is_closed(scene) && (self.straight || self.slides);
        scene.free == 1 && scene.velocities.is_none() && has_form && !self.gap && !self.asked
    }
}

/// The method of an interval, and why.
pub(crate) fn choice(scene: &SceneTraits, interval: &IntervalTraits) -> (Method, Why) {
    // Before the swing: a parabola is exact for any number of free coordinates.
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

/// The method of intervals without a closed form.
pub(crate) fn stepping(scene: &SceneTraits) -> (Method, Why) {
    match scene.velocities {
        // Only time goes on: steps then go from event to event of the contacts.
        _ if scene.balanced => (Method::Walk, Why::Balanced),
        // States of blocks may be stiff where nothing is free.
        _ if scene.stiff => (Method::Radau, Why::Stiff),
        _ if scene.free == 0 => (Method::Walk, Why::NothingFree),
        None => (Method::Nystrom, Why::NoVelocities),
        Some(why) => (Method::DormandPrince, why),
    }
}

/// Whether nothing of a contact on a branch resists u̇, so that at a constant depth its force is a form of u alone: damping is
/// that of the springs that stick, and in gross slip none does.
pub(crate) fn is_undamped(contact: &Contact, branch: &Branch) -> bool {
    contact.interface.damping() == 0.0 || branch.is_gross()
}

/// What is done about a contact in a mode, and why; `followed` is what its followers make of u where that has a closed form.
#[inline(always)]
pub(crate) fn treatment(contact: &Contact, mode: &Mode, followed: impl FnOnce() -> bool) -> (Treatment, Why) {
    match (mode, &contact.press) {
        _ if contact.is_never_pressed() => (Treatment::Spared, Why::NeverPressed),
        (Mode::Open, _) => (Treatment::Apart, Why::OnlyTheGap),
        (Mode::Slip(branch), Press::Constant { .. }) if is_undamped(contact, branch) => {
            if followed() {
                (Treatment::Closed, Why::OneEdge)
            } else {
                (Treatment::General, Why::CurvedFollower)
            }
        }
        (Mode::Slip(_), Press::Constant { .. }) => (Treatment::General, Why::ContactDamping),
        (Mode::Slip(_), _) => (Treatment::General, Why::VaryingIndentation),
        (Mode::Grow, _) => (Treatment::General, Why::Growth),
        (Mode::Lull { .. }, _) => (Treatment::General, Why::BetweenSprings),
        (Mode::Whole { .. }, _) if contact.inert => (Treatment::General, Why::NoFriction),
        (Mode::Whole { .. }, _) => (Treatment::General, Why::WholeLaw),
    }
}
