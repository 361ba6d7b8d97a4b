//! What makes results worth less than they look.

use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

/// Something that makes results worth less than they look.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Warning {
    /// what a warning is about, one word for machines. Of the scenario, among others: `mass`, `stiffness`, `capacitance`,
    /// `stroke`, `modulus` out of proportion; `pressure` beyond yield; `damping_time` beyond a tenth of the period; `flank`
    /// below ten passages of a shear wave; `load` beyond friction. Of the run: `energy_balance`, `error_estimate`, `flight`,
    /// `angle` beyond 0.1 rad, `rolling` beyond the contact radius, `through_ground` for a fall below all contacts
    pub kind: &'static str,
    /// the place in the scenario that it is about
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// what is implausible, or why the results are unreliable
    pub message: String,
    /// what to try
    #[serde(skip_serializing_if = "Option::is_none")]
    pub help: Option<String>,
}

impl Warning {
    /// One about what came out in a run.
    pub fn new(kind: &'static str, message: impl Into<String>) -> Self {
        Self { kind, path: None, message: message.into(), help: None }
    }

    /// The same with what to try.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// One about the scenario, as what is odd about it says.
    pub fn of_odd(odd: &stickslip_scenario::Warning) -> Self {
        Self { kind: odd.kind, path: Some(odd.path.clone()), message: odd.message.clone(), help: None }
    }

    /// Whether it is about what came out in the run, and not about its scenario, which `stickslip check` tells beforehand.
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
