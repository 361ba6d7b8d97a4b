//! Where a run ends, and the next moment that a step may not cross.
//!
//! A run to the end of its plan takes no notice of the end until a step reaches it: what lies before it is the same whatever
//! the end, and a run that was ended goes on from its last whole step. An advance to a moment cuts its last step there. The
//! next corner is set whenever waveforms turn. Events are not here: no step has to stop before one.

use super::steady::Steps;
use crate::{Model, Plan};

/// Moments ahead.
pub(super) struct Horizon {
    /// What no step crosses, s: the moment to which a run is advanced.
    pub(super) until: f64,
    /// End of the run, s, which steps do not see.
    pub(super) end: f64,
    /// What the last step is to reach, s; it may go further.
    past: f64,
    /// From when on a moment is the end, s.
    pub(super) nearly: f64,
    /// Whether the step that reaches the end is taken; otherwise the run stops before it.
    pub(super) takes_last: bool,
    /// Earliest corner of a waveform, s.
    pub(super) corner: f64,
    /// The steps of the drive, where they may end the run.
    pub(super) steps: Steps,
    /// The same before the first.
    pub(super) unmade: Steps,
}

impl Horizon {
    /// Nothing ahead yet.
    pub(super) fn new(model: &Model, plan: &Plan) -> Self {
        let never = f64::INFINITY;
        let steps = Steps::of(model, plan);
        Self {
            until: never,
            end: never,
            nearly: never,
            past: never,
            takes_last: false,
            corner: never,
            steps,
            unmade: steps,
        }
    }

    /// Goes as far as a goal says.
    pub(super) fn aim(&mut self, goal: Goal) {
        let never = f64::INFINITY;
        (self.until, self.end, self.takes_last) = match goal {
            Goal::Moment(until) => (until, never, false),
            Goal::BeforeEnd(end) => (never, end, false),
            Goal::End(end) => (never, end, true),
            Goal::Past(_) => (never, never, true),
        };
        self.past = if let Goal::Past(t) = goal { t } else { never };
        self.nearly = self.end;
    }

    /// The first moment that a step may not cross, s.
    pub(super) fn next(&self) -> f64 {
        self.corner.min(self.until)
    }

    /// Where a run stops.
    pub(super) fn limit(&self) -> f64 {
        self.until.min(self.end).min(self.past)
    }

    /// Whether a step that ends at t is one too far.
    #[inline(always)]
    pub(super) fn is_beyond(&self, t: f64) -> bool {
        t >= self.nearly && !self.takes_last
    }
}

/// How far a run is to go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Goal {
    /// To this moment, s, its last step cut there.
    Moment(f64),
    /// As far as whole steps go before this end, s.
    BeforeEnd(f64),
    /// To this end, s, with its last row.
    End(f64),
    /// Until a step has reached this moment, s, or gone further.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests look at one step after another"))]
    Past(f64),
}

impl Goal {
    /// When rows end, s.
    pub(super) fn last_row(self) -> f64 {
        match self {
            Self::BeforeEnd(end) | Self::End(end) => end,
            Self::Moment(_) | Self::Past(_) => f64::INFINITY,
        }
    }
}

/// How a step left the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// Further on, or with a shorter wish.
    Made,
    /// Where it was: the next step would reach the end.
    Short,
}
