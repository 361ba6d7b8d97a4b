//! Errors of a continuation.

use crate::steady::SteadyError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why a branch cannot be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ContinuationError {
    /// The key path does not name a number that can be varied continuously.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// The scenario does not give a value to the parameter.
    #[error(
        "{0} has no value in this scenario\n   help: give the start value of the branch, such as --set {0}=…"
    )]
    Absent(String),
    /// The range is empty or not finite.
    #[error("{path}: expected a range that rises from one finite value to another, got {from} to {to}")]
    Range {
        /// Key path of the parameter.
        path: String,
        /// Start of the range, SI.
        from: f64,
        /// End of the range, SI.
        to: f64,
    },
    /// The start value is outside the range.
    #[error(
        "the branch starts at the value of the scenario, {path} = {present} {unit}, which is not between {from} and {to}\n   help: widen the range, or set another start value, --set {path}=…"
    )]
    Outside {
        /// Key path of the parameter.
        path: String,
        /// Value of the parameter, SI.
        present: f64,
        /// Unit of the parameter.
        unit: &'static str,
        /// Start of the range, SI.
        from: f64,
        /// End of the range, SI.
        to: f64,
    },
    /// The caller interrupted the search for the first orbit.
    #[error("interrupted after {0} periods, before the first orbit of the branch was found")]
    Interrupted(u32),
    /// There is no periodic orbit at the start value.
    #[error("there is no periodic orbit at the start of the branch, {path} = {present} {unit}: {source}")]
    NoStart {
        /// Key path of the parameter.
        path: String,
        /// Value of the parameter, SI.
        present: f64,
        /// Unit of the parameter.
        unit: &'static str,
        /// Reason for the error.
        source: Box<SteadyError>,
    },
    /// Varying this period alone would leave the waveforms without a common period.
    #[error(
        "{path} cannot be varied alone: the waveforms \"{first}\" and \"{second}\" would have no common period\n   help: vary all periods together with `stickslip curve --curve speed-frequency`"
    )]
    Apart {
        /// Key path of the parameter.
        path: String,
        /// Name of the first waveform.
        first: String,
        /// Name of the second waveform.
        second: String,
    },
    /// A periodic orbit exists at the start value, but no branch starts from it.
    #[error("no branch starts from the periodic orbit at {path} = {present} {unit}: {why}")]
    NoBranch {
        /// Key path of the parameter.
        path: String,
        /// Value of the parameter, SI.
        present: f64,
        /// Unit of the parameter.
        unit: &'static str,
        /// Reason for the error.
        why: String,
    },
    /// The periodic orbits at the start value form a family.
    #[error(
        "at {path} = {present} {unit} there is no gross slip in {contacts:?}: the periodic orbits are a family (shakedown) instead of a branch\n   help: increase the stroke until all contacts slip"
    )]
    Shakedown {
        /// Key path of the parameter.
        path: String,
        /// Value of the parameter, SI.
        present: f64,
        /// Unit of the parameter.
        unit: &'static str,
        /// Names of the contacts.
        contacts: Vec<String>,
    },
}

/// Reason why a continuation step failed.
#[derive(Debug, Clone, PartialEq, Error)]
pub(super) enum Trouble {
    /// The parameter value gives an invalid scenario.
    #[error("refused: {0}")]
    Refused(String),
    /// The slip memory has another number of breakpoints, or the model has other unknowns.
    #[error("the Poincaré map has another number of unknowns")]
    OtherForm,
    /// No orbit was found.
    #[error("no orbit was found")]
    Diverged,
    /// The branch bends too much for this step size.
    #[error("the branch bends")]
    Bends,
    /// The body named in `figures` slides during the whole period at any velocity.
    #[error("any speed is possible")]
    Slides,
    /// A period could not be simulated, or the drive has no periodic orbit.
    #[error(transparent)]
    Steady(#[from] SteadyError),
}

impl Trouble {
    /// Returns whether a shorter continuation step would fail, too.
    pub(super) fn is_final(&self) -> bool {
        matches!(self, Self::Steady(SteadyError::Interrupted(_)))
    }
}
