//! Warnings about a scenario or the results of a run.

use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

/// Warning that results are implausible or less accurate than they look.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Warning {
    /// kind of the warning, one word for programs. About the scenario, among others: `mass`, `stiffness`,
    /// `capacitance`, `stroke`, `modulus` (each: unusual value), `pressure` (above yield), `damping_time` (contact
    /// damping above a tenth of the shortest period), `flank` (of a waveform, shorter than ten passages of a shear
    /// wave), `load` (above the friction limit). About the run: `energy_balance`, `error_estimate`, `flight` (all
    /// contacts open), `angle` (rotation above 0.1 rad), `rolling` (by more than the contact radius), `through_ground`
    /// (fall below all contacts).
    pub kind: &'static str,
    /// path of the scenario key that the warning is about. Absent if it is about the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// what is implausible, or why the results are unreliable
    pub message: String,
    /// advice. Absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
}

impl Warning {
    /// Creates a warning about the results of a run.
    pub fn new(kind: &'static str, message: impl Into<String>) -> Self {
        Self { kind, path: None, message: message.into(), help: None }
    }

    /// Returns the warning with additional advice.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// Creates a warning about the scenario from a finding of its plausibility check.
    pub fn of_odd(odd: &stickslip_scenario::Warning) -> Self {
        Self { kind: odd.kind, path: Some(odd.path.clone()), message: odd.message.clone(), help: None }
    }

    /// Returns whether the warning is about the results of a run. Warnings about the scenario are also reported by
    /// `stickslip check`.
    pub fn is_of_results(&self) -> bool {
        self.path.is_none()
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        self.help.iter().try_for_each(|help| write!(f, "\n   help: {help}"))
    }
}
