//! Working data of a run that its next step depends on.
//!
//! They are part of the state, so that a resumed run, also in another process, has identical bits. All other data of a run is
//! scratch and follows from the state.

use crate::Model;
use crate::interval::PhasePoint;
use stickslip_stepper::{Hand, StepHistory};

/// Working data of the last run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Underway {
    /// Run with event location.
    Located(Box<LocatedWay>),
    /// Run with fixed steps.
    Fixed(Box<FixedWay>),
}

impl Underway {}

/// Working data of a run with event location.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LocatedWay {
    /// Tolerance of the run.
    pub(crate) tolerance: f64,
    pub(crate) whereabouts: Whereabouts,
    /// Method of a pair that has the present state.
    pub(crate) hand: Hand,
    /// Slopes at the start of the next step, if the stepper is there. They precede the last commit of the memories.
    pub(crate) slopes: Vec<f64>,
    /// Memory of the step control.
    pub(crate) history: StepHistory,
    pub(crate) gait: Gait,
    pub(crate) allowed: Allowed,
    pub(crate) booked: Booked,
    /// Whether the closed-form solution of the interval has been tried.
    pub(crate) asked: bool,
    /// Closed-form interval that was interrupted.
    pub(crate) leap: Option<Takeoff>,
    /// Present interval of step doubling.
    pub(crate) detour: Option<Detour>,
    /// Last interval of step doubling, finished or not.
    pub(crate) last_detour: Detour,
    pub(crate) windows: Vec<Window>,
    pub(crate) crawl: Crawl,
    /// Step lengths of the drive so far, if the run may end at steady steps.
    pub(crate) steps: Option<Stepped>,
}

/// Working data of a run with fixed steps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FixedWay {
    /// Name of the stepper.
    pub(crate) stepper: &'static str,
    pub(crate) grid: Grid,
    /// Slopes that the method keeps; empty if none.
    pub(crate) slopes: Vec<f64>,
    /// Last sense of slip of each contact.
    pub(crate) senses: Vec<f64>,
    pub(crate) booked: Booked,
    pub(crate) windows: Vec<Window>,
    /// Step lengths of the drive so far, if the run may end at steady steps.
    pub(crate) steps: Option<Stepped>,
}

/// Grid of fixed steps: start + count · step, computed as a product.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Start, s.
    pub(crate) start: f64,
    /// Length of a step, s.
    pub(crate) step: f64,
    /// Number of steps taken, an integer.
    pub(crate) count: f64,
}

/// Position of the stepper relative to the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Whereabouts {
    /// At the state.
    Here,
    /// Outdated: the state has moved by closed forms, or laws have changed.
    Behind,
}

/// Data for the choice of the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gait {
    /// Largest step since the last event, or since a graded step was rejected, s.
    pub(crate) proven: f64,
    /// Whether even steps become shorter towards a singular moment.
    pub(crate) ahead: Ahead,
    /// Whether steps must stay below the stability limit.
    pub(crate) grip: Grip,
}

impl Gait {
    /// Values before the first step.
    pub(crate) const FRESH: Self = Self { proven: 0.0, ahead: Ahead::Clear, grip: Grip::Slips };
}

/// Effect of a singular moment on even steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ahead {
    /// No effect yet.
    Clear,
    /// An even step was rejected because of it.
    Shortens,
}

/// Constraint of the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grip {
    /// No restoring force: all contacts slip under prescribed normal loads, and there are no links.
    Slips,
    /// There is a restoring force, or no contact.
    Sticks,
    /// There is a restoring force, and all free coordinates are at rest.
    Rests,
}

/// Allowed absolute errors of a step, limited by rounding at the last event or rejection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Allowed {
    /// Allowed error of each component.
    pub(crate) scale: Vec<f64>,
    /// Largest power of prescribed motions on contacts at the last corner, W.
    pub(crate) power: f64,
}

impl Allowed {
    /// Copies values, reusing the memory.
    pub(crate) fn copy(&mut self, from: &Self) {
        self.scale.clone_from(&from.scale);
        self.power = from.power;
    }
}

/// Times up to which paths of contacts and blocks are committed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Booked {
    /// Time for each contact, s.
    pub(crate) last: Vec<f64>,
    /// Time for the blocks, s.
    pub(crate) blocks: f64,
    /// Whether the memories of contacts of closed form are up to date.
    pub(crate) books: Books,
}

impl Booked {
    /// Copies values, reusing the memory.
    pub(crate) fn copy(&mut self, from: &Self) {
        self.last.clone_from(&from.last);
        (self.blocks, self.books) = (from.blocks, from.books);
    }
}

/// State of the memories of contacts of closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Books {
    /// Up to date.
    Current,
    /// At the last event.
    Behind,
}

/// Start of a closed-form interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Takeoff {
    pub(crate) from: PhasePoint,
    /// Input work until then, J.
    pub(crate) input: f64,
}

/// Close events of one component: time of the first (s) and their number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    pub(crate) start: f64,
    pub(crate) count: u32,
}

/// Interval of step doubling on the full force law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Detour {
    /// End, s.
    pub(crate) end: f64,
    /// Length, s.
    pub(crate) length: f64,
    /// Length of the next step, s.
    pub(crate) step: f64,
}

impl Detour {
    /// Value before the first interval.
    pub(crate) const NONE: Self = Self { end: f64::NEG_INFINITY, length: 0.0, step: 0.0 };
}

/// Progress of attempts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crawl {
    /// Last time at which progress was sufficient, s.
    pub(crate) since: f64,
    /// Number of attempts since then.
    pub(crate) attempts: u64,
}

impl Window {
    /// Returns the number of event windows: one for the events of each contact and block, and one for the closed loops of each contact.
    pub(crate) fn count(model: &Model) -> usize {
        2 * model.contacts.len() + model.blocks.len()
    }
}

/// Step lengths of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stepped {
    /// Index of the next end of a period.
    pub(crate) next: f64,
    /// Origin and position at the end of the last period, m, kept separate for accurate differences.
    pub(crate) place: Option<(f64, f64)>,
    /// Last step length, m.
    pub(crate) step: Option<f64>,
    /// Number of successive steps that agree with the previous one.
    pub(crate) agreed: u32,
}

impl LocatedWay {
    /// Initial values.
    pub(crate) const BLANK: Self = Self {
        tolerance: 0.0,
        whereabouts: Whereabouts::Behind,
        hand: Hand { graded: false, both: false },
        slopes: Vec::new(),
        history: StepHistory::BLANK,
        gait: Gait { proven: 0.0, ahead: Ahead::Clear, grip: Grip::Slips },
        allowed: Allowed { scale: Vec::new(), power: 0.0 },
        booked: Booked { last: Vec::new(), blocks: 0.0, books: Books::Current },
        asked: false,
        leap: None,
        detour: None,
        last_detour: Detour::NONE,
        windows: Vec::new(),
        crawl: Crawl { since: 0.0, attempts: 0 },
        steps: None,
    };
}

impl FixedWay {
    /// Initial values.
    pub(crate) const BLANK: Self = Self {
        stepper: "",
        grid: Grid { start: 0.0, step: 0.0, count: 0.0 },
        slopes: Vec::new(),
        senses: Vec::new(),
        booked: Booked { last: Vec::new(), blocks: 0.0, books: Books::Current },
        windows: Vec::new(),
        steps: None,
    };
}
