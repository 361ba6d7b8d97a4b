//! What makes results worth less than they look.

use serde::Serialize;
use std::fmt;

/// Something that makes results worth less than they look.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What it is about, as one word for machines, such as `energy_books`; it never changes its meaning.
    pub kind: &'static str,
    /// Key path in the scenario of what is odd about it; none of what came out in the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// What there is to say, with its number.
    pub message: String,
    /// What to try.
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
