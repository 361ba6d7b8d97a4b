//! Why there is no curve at all. What is wrong with a single point stands in its row.

use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why there is no curve.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// The scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A path into it that names no number that can change by any amount.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// No waveform whose period is that of the steps.
    #[error("{file}: no waveform makes the steps: {why}\n   help: {help}")]
    NoPeriod {
        /// The scenario.
        file: String,
        /// What it lacks.
        why: String,
        /// What to do.
        help: String,
    },
    /// No body whose way is the step, or that could be loaded.
    #[error("{file}: {lacking}\n   help: {help}")]
    NoBody {
        /// The scenario.
        file: String,
        /// What there is none of.
        lacking: &'static str,
        /// What to do.
        help: String,
    },
    /// A curve that this scene does not have.
    #[error("{file}: there is no curve {kind}: {why}\n   help: {help}")]
    NotHere {
        /// The scenario.
        file: String,
        /// Name of the curve.
        kind: &'static str,
        /// What the scene lacks.
        why: String,
        /// What to do.
        help: String,
    },
    /// Nobody knows in which range to vary something.
    #[error(
        "{file}: in which range the {varied} is to be varied is not known: {why}\n   help: give one, --range FROM..TO"
    )]
    NoRange {
        /// The scenario.
        file: String,
        /// What is varied.
        varied: String,
        /// What keeps it from being known.
        why: &'static str,
    },
    /// A range that holds nothing.
    #[error("expected a range that rises from one finite value to another, got {from} to {to}")]
    Range {
        /// Where it begins, SI.
        from: f64,
        /// Where it ends, SI.
        to: f64,
    },
    /// Decades from zero or below.
    #[error("expected a range above 0 for points that are as many per decade, got {from} to {to}")]
    Decades {
        /// Where it begins, SI.
        from: f64,
        /// Where it ends, SI.
        to: f64,
    },
    /// A tolerance out of its range.
    #[error("expected a tolerance from 1e-9 to 0.1, got {0}")]
    Tolerance(f64),
    /// A number of points.
    #[error("expected 2 to {most} points, got {got}")]
    Points {
        /// Most of them.
        most: usize,
        /// What was asked for.
        got: usize,
    },
}
