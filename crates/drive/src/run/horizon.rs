//! End of a run, and the next time that no step may cross.
//!
//! A run to the end of its plan does not cut its last step there: the step may pass the end. Results before the end are therefore
//! independent of the end. A finished run can continue from its last whole step.
//!
//! An advance to a given time cuts its last step at that time. The next corner is updated when waveforms reach a corner. Events are not
//! part of the horizon, because no step stops before an event.

use super::steady::Steps;
use crate::{Model, Plan};

/// Times that end a run or its next step.
pub(super) struct Horizon {
    /// Goal of an advance, s; no step crosses it.
    pub(super) until: f64,
    /// End of the run, s; steps may pass it.
    pub(super) end: f64,
    /// Time that the last step must reach or pass, s.
    past: f64,
    /// Time from which on the end counts as reached, s.
    pub(super) nearly: f64,
    /// Whether the step that reaches the end is taken; otherwise the run stops before it.
    pub(super) takes_last: bool,
    /// Next corner of any waveform, s.
    pub(super) corner: f64,
    /// Step lengths of the drive, which may end the run.
    pub(super) steps: Steps,
    /// Initial value of `steps`, before the first period end.
    pub(super) unmade: Steps,
}

impl Horizon {
    /// Creates a horizon without a goal.
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

    /// Sets the goal.
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

    /// Returns the next time that no step may cross, s.
    pub(super) fn next(&self) -> f64 {
        self.corner.min(self.until)
    }

    /// Returns the time at which the run stops, s.
    pub(super) fn limit(&self) -> f64 {
        self.until.min(self.end).min(self.past)
    }

    /// Whether a step that ends at time t reaches the end of a run that stops before that step.
    #[inline(always)]
    pub(super) fn is_beyond(&self, t: f64) -> bool {
        t >= self.nearly && !self.takes_last
    }
}

/// Goal of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Goal {
    /// Time at which the last step is cut, s.
    Moment(f64),
    /// End of the run, s; the run stops after the last whole step before the end.
    BeforeEnd(f64),
    /// End of the run, s; the last row is written there.
    End(f64),
    /// Time that a step must reach or pass, s.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests look at one step after another"))]
    Past(f64),
}

impl Goal {
    /// Returns the time of the last row, s; ∞ without one.
    pub(super) fn last_row(self) -> f64 {
        match self {
            Self::BeforeEnd(end) | Self::End(end) => end,
            Self::Moment(_) | Self::Past(_) => f64::INFINITY,
        }
    }
}

/// Result of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// The time has advanced, or the next attempt is shorter.
    Made,
    /// The state is unchanged, because the next step would reach the end.
    Short,
}
