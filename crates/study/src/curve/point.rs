//! The points of a curve, each the steady motion of a scene of its own.

use super::{Motion, Motionless};

/// A point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What is varied, SI.
    pub value: f64,
    /// What sets it in the scenario: pairs of key path and value, as `--set` takes them.
    pub set: Vec<(String, String)>,
    /// What the drive does there, or why that is not known.
    pub motion: Result<Motion, Motionless>,
}
