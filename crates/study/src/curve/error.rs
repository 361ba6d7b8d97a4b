//! Errors that concern a whole curve. Errors of a single point are stored in the point.

use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Error: the curve cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The key path does not name a number that can be varied continuously.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// There is no waveform whose period is the period of the steps.
    #[error("{file}: no waveform determines the steps: {why}\n   help: {help}")]
    NoPeriod {
        /// Name of the scenario.
        file: String,
        /// What is missing.
        why: String,
        /// Advice for the user.
        help: String,
    },
    /// There is no body whose steps are evaluated or that can be loaded.
    #[error("{file}: {lacking}\n   help: {help}")]
    NoBody {
        /// Name of the scenario.
        file: String,
        /// What is missing.
        lacking: &'static str,
        /// Advice for the user.
        help: String,
    },
    /// The scenario does not have this curve.
    #[error("{file}: the curve {kind} is not possible: {why}\n   help: {help}")]
    NotHere {
        /// Name of the scenario.
        file: String,
        /// Name of the curve.
        kind: &'static str,
        /// What the scenario lacks.
        why: String,
        /// Advice for the user.
        help: String,
    },
    /// The parameter has no default range.
    #[error("{file}: no default range for {varied}: {why}\n   help: give a range, --range FROM..TO")]
    NoRange {
        /// Name of the scenario.
        file: String,
        /// Name of the parameter.
        varied: String,
        /// Reason for the error.
        why: &'static str,
    },
    /// The range is empty or not finite.
    #[error("expected a range that rises from one finite value to another, got {from} to {to}")]
    Range {
        /// Start of the range, SI.
        from: f64,
        /// End of the range, SI.
        to: f64,
    },
    /// A logarithmic range does not start above 0.
    #[error("expected a range above 0 for logarithmic spacing, got {from} to {to}")]
    Decades {
        /// Start of the range, SI.
        from: f64,
        /// End of the range, SI.
        to: f64,
    },
    /// The tolerance is outside 1e-9 to 0.1.
    #[error("expected a tolerance from 1e-9 to 0.1, got {0}")]
    Tolerance(f64),
    /// The number of points is invalid.
    #[error("expected 2 to {most} points, got {got}")]
    Points {
        /// Maximum number of points.
        most: usize,
        /// Requested number of points.
        got: usize,
    },
}
