//! Data of a run in progress on which its next step depends.
//!
//! These data are part of the state, so that a resumed run, also in another process, has identical bits. All other data of a run are
//! scratch and follow from the state.

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
    /// Integration method of a [`Paired`](stickslip_stepper::Paired) stepper that contains the present state.
    pub(crate) hand: Hand,
    /// Time derivatives at the start of the next step, unless outdated. These derivatives were computed before the last commit of memories.
    pub(crate) slopes: Vec<f64>,
    /// Earlier errors and step lengths for the step size control.
    pub(crate) history: StepHistory,
    pub(crate) gait: Gait,
    pub(crate) allowed: Allowed,
    pub(crate) booked: Booked,
    /// Whether a closed-form solution of the present interval has already been attempted.
    pub(crate) asked: bool,
    /// Start of a closed-form interval that was interrupted.
    pub(crate) leap: Option<Takeoff>,
    /// Present interval of step doubling on the full force law.
    pub(crate) detour: Option<Detour>,
    /// Last interval of step doubling on the full force law, finished or not.
    pub(crate) last_detour: Detour,
    pub(crate) windows: Vec<Window>,
    pub(crate) crawl: Crawl,
    /// Step lengths of the drive so far, if the run may end at a steady step length.
    pub(crate) steps: Option<Stepped>,
}

/// Working data of a run with fixed steps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FixedWay {
    /// Name of the stepper.
    pub(crate) stepper: &'static str,
    pub(crate) grid: Grid,
    /// Time derivatives that the method keeps for its next step; empty if it keeps none.
    pub(crate) slopes: Vec<f64>,
    /// Last sense of slip of each contact.
    pub(crate) senses: Vec<f64>,
    pub(crate) booked: Booked,
    pub(crate) windows: Vec<Window>,
    /// Step lengths of the drive so far, if the run may end at a steady step length.
    pub(crate) steps: Option<Stepped>,
}

/// Time grid of fixed steps: start + count · step, computed as a product.
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
    /// Stepper data are outdated: the state has moved by closed forms, or force laws have changed.
    Behind,
}

/// Data for the choice of the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gait {
    /// Largest accepted step since the last event or the last rejection of a graded step (stages concentrated at one end), s.
    pub(crate) proven: f64,
    /// Whether steps with evenly distributed stages become shorter towards a singular time.
    pub(crate) ahead: Ahead,
    /// Whether steps must stay below the stability limit.
    pub(crate) grip: Grip,
}

impl Gait {
    /// Values before the first step.
    pub(crate) const FRESH: Self = Self { proven: 0.0, ahead: Ahead::Clear, grip: Grip::Slips };
}

/// Effect of a singular time ahead on steps with evenly distributed stages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ahead {
    /// No effect yet.
    Clear,
    /// A step was rejected because of the singular time.
    Shortens,
}

/// Constraint of the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grip {
    /// No restoring force acts: all contacts slip under prescribed normal loads, and there are no springs or actuators.
    Slips,
    /// A restoring force acts, or the model has no contact.
    Sticks,
    /// A restoring force acts, and all free coordinates are at rest.
    Rests,
}

/// Allowed absolute errors of a step, bounded below by rounding and computed at the last event or rejection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Allowed {
    /// Allowed error of each component.
    pub(crate) scale: Vec<f64>,
    /// Largest power that prescribed motions transfer to contacts at the last corner, W.
    pub(crate) power: f64,
}

impl Allowed {
    /// Copies values, reusing the memory.
    pub(crate) fn copy(&mut self, from: &Self) {
        self.scale.clone_from(&from.scale);
        self.power = from.power;
    }
}

/// Extent to which the paths of contacts and blocks are committed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Booked {
    /// Time for the blocks, s.
    pub(crate) blocks: f64,
    /// Whether the slip memories of contacts with a closed form are up to date.
    pub(crate) books: Books,
}

/// State of the slip memories of contacts with a closed form.
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
    /// Input work up to the start of the interval, J.
    pub(crate) input: f64,
}

/// Window that counts close events of one component: time of the first event (s) and number of events.
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
    /// Value before the first interval of step doubling.
    pub(crate) const NONE: Self = Self { end: f64::NEG_INFINITY, length: 0.0, step: 0.0 };
}

/// Progress of the run over many attempted steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crawl {
    /// Time at which progress was last sufficient, s.
    pub(crate) since: f64,
    /// Number of attempted steps since that time.
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
    /// Shift of the origin and position relative to it at the end of the last period, m, kept apart for accurate differences.
    pub(crate) place: Option<(f64, f64)>,
    /// Last step length, m.
    pub(crate) step: Option<f64>,
    /// Number of successive step lengths that agree with the previous one.
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
        booked: Booked { blocks: 0.0, books: Books::Current },
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
        booked: Booked { blocks: 0.0, books: Books::Current },
        windows: Vec::new(),
        steps: None,
    };
}
