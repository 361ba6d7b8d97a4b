//! Errors that concern a whole sensitivity analysis. Errors of a single derivative are stored in the derivative.

use crate::steady::SteadyError;
use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Error: derivatives cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SensitivityError {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The key path does not name a number that can be varied continuously.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// The scenario does not give a value to the parameter.
    #[error(
        "{file}: {path} has no value in the file\n   help: write a value into the file, or set it with --set {path}=VALUE"
    )]
    LeftOut {
        /// Name of the scenario.
        file: String,
        /// Key path of the parameter.
        path: String,
    },
    /// A parameter or result is requested twice.
    #[error("\"{0}\" is named twice")]
    Twice(String),
    /// The scenario has no parameters.
    #[error("{0}: has no parameter with a derivative\n   help: name one, --to PATH")]
    NoQuantity(String),
    /// No run of any scenario has a result of this name.
    #[error("\"{name}\": there is no such result{}", help.as_ref().map_or(String::new(), |help| format!("\n   help: {help}")))]
    NoFigure {
        /// Requested name.
        name: String,
        /// Suggested name, as help text.
        help: Option<String>,
    },
    /// Runs of this scenario do not have the result, but runs of other scenarios do.
    #[error(
        "\"{name}\": runs of {file} have no such result\n   help: `stickslip explain {name}` explains it; summary.json has the results of a run"
    )]
    NotHere {
        /// Requested name.
        name: String,
        /// Name of the scenario.
        file: String,
    },
    /// The result is an integer or describes the execution of the run.
    #[error("\"{name}\" {why}: it has no derivative")]
    NotContinuous {
        /// Requested name.
        name: String,
        /// Reason for the error.
        why: &'static str,
    },
    /// There is no default result.
    #[error(
        "{0}: has neither steps nor dissipating contacts, so there is no default result\n   help: name a result of summary.json, --of RESULT"
    )]
    NoDefault(String),
    /// The run of the unchanged scenario stopped early.
    #[error("{file}: the run of the scenario stopped early: {why}")]
    Stopped {
        /// Name of the scenario.
        file: String,
        /// Reason for the error.
        why: String,
    },
    /// The unchanged scenario has no periodic orbit.
    #[error("{file}: {source}")]
    NotSteady {
        /// Name of the scenario.
        file: String,
        /// Reason for the error.
        source: SteadyError,
    },
    /// The caller interrupted the run of the unchanged scenario.
    #[error("interrupted")]
    Interrupted,
    /// The tolerance is outside 1e-13 to 1e-6.
    #[error("expected a tolerance from 1e-13 to 1e-6, got {0}")]
    Tolerance(f64),
}
