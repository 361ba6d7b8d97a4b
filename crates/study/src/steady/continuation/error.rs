//! Why a branch cannot be followed, or no further.

use crate::steady::SteadyError;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why there is no branch at all.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ContinuationError {
    /// A path into it that names no number that can change by any amount.
    #[error(transparent)]
    Path(#[from] ScenarioError),
    /// A number that the scenario does not give.
    #[error(
        "{0} has no value in this scenario\n   help: give it one, such as --set {0}=…, for the branch to start at"
    )]
    Absent(String),
    /// A range that holds nothing.
    #[error("{path}: expected a range that rises from one finite value to another, got {from} to {to}")]
    Range {
        /// Key path of what is to be varied.
        path: String,
        /// Where it begins, SI.
        from: f64,
        /// Where it ends, SI.
        to: f64,
    },
    /// A start outside of the range.
    #[error(
        "{path} is {present} {unit} in this scenario: the branch starts there, which is not between {from} and {to}\n   help: widen the range, or set it, --set {path}=…"
    )]
    Outside {
        /// Its path.
        path: String,
        /// What it is, SI.
        present: f64,
        /// Its unit.
        unit: &'static str,
        /// Where the range begins, SI.
        from: f64,
        /// Where it ends, SI.
        to: f64,
    },
    /// The caller had enough before there was a motion to start with.
    #[error("interrupted after {0} periods, before the motion was found that the branch starts from")]
    Interrupted(u32),
    /// No steady motion to start with.
    #[error("the branch starts at {path} = {present} {unit}, where there is no steady motion: {source}")]
    NoStart {
        /// What is varied.
        path: String,
        /// What it is, SI.
        present: f64,
        /// Its unit.
        unit: &'static str,
        /// Why.
        source: Box<SteadyError>,
    },
    /// A period that cannot change without parting from another one.
    #[error(
        "{path} cannot be varied by itself: the waveforms \"{first}\" and \"{second}\" would have no common period\n   help: vary the period of all of them, as `stickslip curve --curve speed-frequency` does"
    )]
    Apart {
        /// What is varied.
        path: String,
        /// Name of one waveform.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// A motion that nothing leads on from.
    #[error("there is a steady motion at {path} = {present} {unit}, but no branch leads on from it: {why}")]
    NoBranch {
        /// What is varied.
        path: String,
        /// What it is, SI.
        present: f64,
        /// Its unit.
        unit: &'static str,
        /// Why.
        why: String,
    },
    /// A continuum to start with.
    #[error(
        "at {path} = {present} {unit} {contacts:?} never slip grossly: steady motions are a whole family (a shakedown), and no one branch leads on from there\n   help: drive it further, so that all slip"
    )]
    Shakedown {
        /// What is varied.
        path: String,
        /// What it is, SI.
        present: f64,
        /// Its unit.
        unit: &'static str,
        /// Names of the contacts.
        contacts: Vec<String>,
    },
}

/// Why a step along a branch came to nothing.
#[derive(Debug, Clone, PartialEq, Error)]
pub(super) enum Trouble {
    /// The value makes no scenario.
    #[error("refused: {0}")]
    Refused(String),
    /// A contact's memory has other knots there, or the drive other numbers.
    #[error("what contacts remember has another form")]
    OtherForm,
    /// No motion was come to.
    #[error("no motion was found")]
    Diverged,
    /// The branch bends too much for the step.
    #[error("the branch bends")]
    Bends,
    /// The body of the figures slides all through, and any speed does.
    #[error("any speed does")]
    Slides,
    /// A period, or a drive that is none.
    #[error(transparent)]
    Steady(#[from] SteadyError),
}

impl Trouble {
    /// Whether a shorter step would not help.
    pub(super) fn is_final(&self) -> bool {
        matches!(self, Self::Steady(SteadyError::Interrupted(_)))
    }
}
