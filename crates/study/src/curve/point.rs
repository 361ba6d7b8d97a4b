//! The points of a curve, each the steady motion of a scene of its own.

use super::{Curve, Landmark, Motion, Motionless, Traced, Unfound};
use stickslip_run::Warning;

/// A point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What is varied, SI.
    pub value: f64,
    /// What sets it in the scenario: pairs of key path and value, as `--set` takes them.
    pub set: Vec<(String, String)>,
    /// What `check` warns of there.
    pub warnings: Vec<Warning>,
    /// What the drive does there, or why that is not known.
    pub motion: Result<Motion, Motionless>,
}

impl Traced {
    /// Power against the load at a place, W: load times speed the way of the unloaded steps. None of curves without load.
    #[must_use]
    pub fn power(&self, curve: &Curve, place: usize) -> Option<f64> {
        let point = self.points.get(place).filter(|_| curve.kind.is_of_load())?;
        let motion = point.motion.as_ref().ok()?;
        Some(motion.power(self.direction * point.value))
    }

    /// How many points have no motion.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.points.iter().filter(|point| point.motion.is_err()).count()
    }

    /// How many points are done, with a motion or without.
    #[must_use]
    pub fn done(&self) -> usize {
        self.points.iter().filter(|point| point.motion != Err(Motionless::NotRun)).count()
    }

    /// Whether points were left undone, or places with a name.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        let is_undone = |landmark: &Landmark| landmark.at == Err(Unfound::NotRun);
        self.done() < self.points.len() || self.landmarks.iter().any(is_undone)
    }
}
