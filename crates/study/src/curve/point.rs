//! Points of a curve: steady motions of variants of the scenario.

use super::{Curve, Landmark, Motion, Motionless, Traced, Unfound};
use stickslip_run::Warning;

/// A point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Value of the parameter, SI.
    pub value: f64,
    /// Arguments of `--set` that give this point: pairs of key path and value.
    pub set: Vec<(String, String)>,
    /// Warnings of `check` at this point.
    pub warnings: Vec<Warning>,
    /// Steady motion, or the reason why there is none.
    pub motion: Result<Motion, Motionless>,
}

impl Traced {
    /// Returns the power against the load at a point, W: load times velocity in the direction of the unloaded steps.
    /// Returns `None` for curves without load.
    #[must_use]
    pub fn power(&self, curve: &Curve, place: usize) -> Option<f64> {
        let point = self.points.get(place).filter(|_| curve.kind.is_of_load())?;
        let motion = point.motion.as_ref().ok()?;
        Some(motion.power(self.direction * point.value))
    }

    /// Returns the number of points without a motion.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.points.iter().filter(|point| point.motion.is_err()).count()
    }

    /// Returns the number of finished points, with or without a motion.
    #[must_use]
    pub fn done(&self) -> usize {
        self.points.iter().filter(|point| point.motion != Err(Motionless::NotRun)).count()
    }

    /// Returns whether points or landmarks were interrupted.
    #[must_use]
    pub fn is_cut(&self) -> bool {
        let is_undone = |landmark: &Landmark| landmark.at == Err(Unfound::NotRun);
        self.done() < self.points.len() || self.landmarks.iter().any(is_undone)
    }
}
