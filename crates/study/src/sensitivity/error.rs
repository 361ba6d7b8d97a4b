//! Why there are no derivatives at all. What is wrong with a single one stands in its row.

use crate::steady::SteadyError;
use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why there are no derivatives.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SensitivityError {
    /// The scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A path into it that names no number that can change by any amount.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// A number that the file leaves out.
    #[error(
        "{file}: {path} is not in the file: there is nothing to start from\n   help: write it there, or give it by --set {path}=VALUE"
    )]
    LeftOut {
        /// The scenario.
        file: String,
        /// Its key path.
        path: String,
    },
    /// A quantity that was asked for twice, or a figure.
    #[error("\"{0}\" is asked for twice")]
    Twice(String),
    /// No number at all.
    #[error("{0}: has no number that could be changed a little\n   help: name one, --to PATH")]
    NoQuantity(String),
    /// A figure that nothing has.
    #[error("\"{name}\": there is no such figure{}", help.as_ref().map_or(String::new(), |help| format!("\n   help: {help}")))]
    NoFigure {
        /// What was asked for.
        name: String,
        /// What might have been meant.
        help: Option<String>,
    },
    /// One that others have.
    #[error(
        "\"{name}\": runs of {file} have no such figure\n   help: `stickslip explain {name}` says what it is of; those that a run has stand in its summary.json"
    )]
    NotHere {
        /// What was asked for.
        name: String,
        /// The scenario.
        file: String,
    },
    /// A figure that changes by jumps, or says how a run went.
    #[error("\"{name}\" {why}: it has no derivative")]
    NotContinuous {
        /// What was asked for.
        name: String,
        /// Why.
        why: &'static str,
    },
    /// No figure by default.
    #[error(
        "{0}: has neither steps nor contacts that lose energy: no figure stands out\n   help: name one of its summary.json, --of FIGURE"
    )]
    NoDefault(String),
    /// The scenario's own run.
    #[error("{file}: its own run stopped: {why}")]
    Stopped {
        /// The scenario.
        file: String,
        /// Why.
        why: String,
    },
    /// The scenario's own steady motion.
    #[error("{file}: {source}")]
    NotSteady {
        /// The scenario.
        file: String,
        /// Why it was not found.
        source: SteadyError,
    },
    /// Its caller wanted an end before the scenario's own run was over.
    #[error("interrupted")]
    Interrupted,
    /// A tolerance out of its range.
    #[error("expected a tolerance from 1e-13 to 1e-6, got {0}")]
    Tolerance(f64),
}
