//! What a run has learnt on its way, and its next step depends on.
//!
//! Kept with the state whenever a caller holds it: a run that takes it up, in this process or another, goes on to the same bits
//! as one that was never put down. Everything else a run works with is scratch, and follows from the state.

use crate::Model;
use crate::interval::PhasePoint;
use stickslip_stepper::{Hand, StepHistory};

/// Of the run that moved the state last.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Underway {
    /// One between located events.
    Located(Box<LocatedWay>),
    /// One at a fixed step.
    Fixed(Box<FixedWay>),
}

impl Underway {}

/// Of a run between located events.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LocatedWay {
    /// Tolerance that all of it belongs to.
    pub(crate) tolerance: f64,
    pub(crate) whereabouts: Whereabouts,
    /// Which method of a pair stands where the motion is.
    pub(crate) hand: Hand,
    /// Slopes at the start of the next step, where the solver stands there: they are older than what the memories have committed.
    pub(crate) slopes: Vec<f64>,
    /// What step control has learnt.
    pub(crate) history: StepHistory,
    pub(crate) gait: Gait,
    pub(crate) allowed: Allowed,
    pub(crate) booked: Booked,
    /// Whether the interval has been asked for a leap.
    pub(crate) asked: bool,
    /// The leap that an advance has cut.
    pub(crate) leap: Option<Takeoff>,
    /// The stretch that is taken by the whole law.
    pub(crate) detour: Option<Detour>,
    /// The last one, over or not.
    pub(crate) last_detour: Detour,
    pub(crate) windows: Vec<Window>,
    pub(crate) crawl: Crawl,
    /// The steps of the drive so far, where they may end the run.
    pub(crate) steps: Option<Stepped>,
}

/// Of a run at a fixed step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FixedWay {
    /// Name of the method.
    pub(crate) stepper: &'static str,
    pub(crate) grid: Grid,
    /// Slopes that the method keeps; empty where it keeps none.
    pub(crate) slopes: Vec<f64>,
    /// Sense in which each contact slid last.
    pub(crate) senses: Vec<f64>,
    pub(crate) booked: Booked,
    pub(crate) windows: Vec<Window>,
    /// The steps of the drive so far, where they may end the run.
    pub(crate) steps: Option<Stepped>,
}

/// Where fixed steps end: start + count · step, multiplied and not summed up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Start, s.
    pub(crate) start: f64,
    /// Length of a step, s.
    pub(crate) step: f64,
    /// Steps taken, a whole number.
    pub(crate) count: f64,
}

/// Where the solver stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Whereabouts {
    /// Where the state is.
    Here,
    /// Left behind by leaps, or by laws that have changed.
    Behind,
}

/// What one step leaves to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gait {
    /// Longest step since the last event, or since a graded one was refused, s.
    pub(crate) proven: f64,
    /// Whether even steps shorten with what is left.
    pub(crate) ahead: Ahead,
    /// Whether steps must stay where the solver damps.
    pub(crate) grip: Grip,
}

impl Gait {
    /// Before the first step.
    pub(crate) const FRESH: Self = Self { proven: 0.0, ahead: Ahead::Clear, grip: Grip::Slips };
}

/// What a singular moment ahead does to even steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ahead {
    /// Nothing yet.
    Clear,
    /// It has made one too long.
    Shortens,
}

/// What holds the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grip {
    /// Nothing does: all contacts slip, nothing presses them by its motion, and there are no links.
    Slips,
    /// Something does, or there is no contact.
    Sticks,
    /// The same, and all that is free is at rest.
    Rests,
}

/// Absolute errors allowed of a step, as rounding made them at the last event or rejection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Allowed {
    /// Of each component.
    pub(crate) scale: Vec<f64>,
    /// Largest power that followers could put into the contacts at the last corner, W.
    pub(crate) power: f64,
}

impl Allowed {
    /// Takes over another's numbers, into the room there is.
    pub(crate) fn copy(&mut self, from: &Self) {
        self.scale.clone_from(&from.scale);
        self.power = from.power;
    }
}

/// Up to when paths of contacts and blocks are committed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Booked {
    /// Of each contact, s.
    pub(crate) last: Vec<f64>,
    /// Of the blocks, s.
    pub(crate) blocks: f64,
    /// Whether contacts of closed form are where the state is.
    pub(crate) books: Books,
}

impl Booked {
    /// Takes over another's times, into the room there is.
    pub(crate) fn copy(&mut self, from: &Self) {
        self.last.clone_from(&from.last);
        (self.blocks, self.books) = (from.blocks, from.books);
    }
}

/// Where the memories of contacts of closed form are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Books {
    /// Where the state is.
    Current,
    /// At the last event.
    Behind,
}

/// Where a leap began.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Takeoff {
    pub(crate) from: PhasePoint,
    /// Work put in until then, J.
    pub(crate) input: f64,
}

/// Events of one component that lie close together: since when, s, and how many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    pub(crate) start: f64,
    pub(crate) count: u32,
}

/// A stretch of time in which contacts go by their whole law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Detour {
    /// Its end, s.
    pub(crate) end: f64,
    /// Its length, s.
    pub(crate) length: f64,
    /// Next step, s.
    pub(crate) step: f64,
}

impl Detour {
    /// Before the first one.
    pub(crate) const NONE: Self = Self { end: f64::NEG_INFINITY, length: 0.0, step: 0.0 };
}

/// How steps move on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crawl {
    /// When they had last moved on by enough, s.
    pub(crate) since: f64,
    /// Attempts from then on.
    pub(crate) attempts: u64,
}

impl Window {
    /// One for the events of each contact and each block, and one for the loops of each contact.
    pub(crate) fn count(model: &Model) -> usize {
        2 * model.contacts.len() + model.blocks.len()
    }
}

/// What the steps of a drive have come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stepped {
    /// Place of the next end of a period among all of them.
    pub(crate) next: f64,
    /// Origin and place at the end of the last period, m: their differences round apart from each other.
    pub(crate) place: Option<(f64, f64)>,
    /// The last step, m.
    pub(crate) step: Option<f64>,
    /// How many steps running have agreed with the one before.
    pub(crate) agreed: u32,
}

impl LocatedWay {
    /// Nothing learnt yet.
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
    /// Nothing learnt yet.
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
