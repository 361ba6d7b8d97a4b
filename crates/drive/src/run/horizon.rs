//! Where a run ends, and the next moment that a step may not cross.
//!
//! Owns the end, which an early end moves forward, and the next corner, which the run sets whenever waveforms
//! turn. Events are not here: no step has to stop before one.

use super::steady::Steps;
use crate::{Model, Plan};

/// Moments ahead.
pub(super) struct Horizon {
    /// End of the run, s.
    pub(super) end: f64,
    /// Earliest corner of a waveform, s.
    pub(super) corner: f64,
    /// The steps of the drive, where they may end the run.
    pub(super) steps: Steps,
}

impl Horizon {
    pub(super) fn new(model: &Model, plan: &Plan) -> Self {
        Self { end: plan.duration, corner: f64::INFINITY, steps: Steps::of(model, plan) }
    }

    /// The first moment that a step may not cross, s.
    pub(super) fn next(&self) -> f64 {
        self.corner.min(self.end)
    }
}
