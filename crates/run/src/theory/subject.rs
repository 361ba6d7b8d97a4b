//! Selection of the contact to be solved.

use crate::job::Job;
use std::io;
use stickslip_contact::{FirstLoadingError, Interface, NormalGiven};
use stickslip_scenario::{ScenarioError, suggestion};
use thiserror::Error;

/// One contact of a job.
#[derive(Clone)]
pub struct Subject<'a> {
    /// Job with the scenario.
    pub job: &'a Job,
    /// Name of the contact.
    pub name: &'a str,
    /// Contact law of one of the identical contacts.
    pub law: &'a Interface,
    /// Indentation at t = 0, m. Negative if the contact is open.
    pub start: f64,
    /// Names of the materials.
    pub materials: [String; 2],
    /// Type of the profile.
    pub profile: String,
}

/// Error of the solution of a single contact.
#[derive(Debug, Error)]
pub enum TheoryError {
    /// The scenario has no contacts.
    #[error("{0}: the scenario has no contacts")]
    NoContacts(String),
    /// No contact has the given name.
    #[error("--contact {asked}  there is no contact \"{}\"{help}", .asked.escape_debug())]
    Unknown {
        /// Given name.
        asked: String,
        /// Suggestion of a similar name, on a separate line.
        help: String,
    },
    /// The scenario has several contacts, and no name was given.
    #[error("{file}: expected --contact, because the scenario has {count}\n   help: contacts: {names}")]
    Several {
        /// Name of the scenario.
        file: String,
        /// Number of contacts.
        count: usize,
        /// Names of the contacts.
        names: String,
    },
    /// The first loading is impossible.
    #[error("{option}{error}", option = option(.0), error = .0)]
    Loading(FirstLoadingError),
    /// A corner of the history cannot be reached.
    #[error("corner {corner} of the history: {source}")]
    Corner {
        /// Number of the corner, from 1.
        corner: usize,
        /// Reason.
        source: FirstLoadingError,
    },
    /// The history is invalid.
    #[error("--history  {0}")]
    History(String),
    /// The table of the history cannot be read.
    #[error(transparent)]
    Table(#[from] ScenarioError),
    /// The files cannot be written.
    #[error("{path}: the results cannot be written: {words}")]
    Write {
        /// Path of the folder.
        path: String,
        /// Message of the operating system.
        words: String,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Returns the command line option whose value caused the error.
fn option(error: &FirstLoadingError) -> &'static str {
    match error {
        FirstLoadingError::Indentation(_) => "--indentation  ",
        FirstLoadingError::Radius(_) => "--radius  ",
        FirstLoadingError::NormalForce(_) => "--force  ",
        FirstLoadingError::Displacement(_) => "--displacement  ",
        FirstLoadingError::StickRadius { .. } => "--stick-radius  ",
        FirstLoadingError::TangentialForce { .. } => "--tangential  ",
        FirstLoadingError::BeyondProfile { .. } | FirstLoadingError::Undetermined => "",
    }
}

impl From<FirstLoadingError> for TheoryError {
    fn from(error: FirstLoadingError) -> Self {
        Self::Loading(error)
    }
}

impl<'a> Subject<'a> {
    /// Returns the contact with the given name, or the only contact.
    ///
    /// # Errors
    /// The scenario has no contact, no contact has this name, or there are several contacts and no name was given.
    pub fn find(job: &'a Job, name: Option<&str>) -> Result<Self, TheoryError> {
        let contacts = &job.scenario.scene.contacts;
        let place = match (name, contacts.len()) {
            (_, 0) => return Err(TheoryError::NoContacts(job.name.clone())),
            (None, 1) => 0,
            (None, count) => {
                let names: Vec<&str> = contacts.iter().map(|contact| contact.name.as_str()).collect();
                let help = suggestion("", names.iter().copied()).unwrap_or_default();
                let names = help.strip_prefix("known here: ").unwrap_or(&help).to_owned();
                return Err(TheoryError::Several { file: job.name.clone(), count, names });
            }
            (Some(asked), _) => {
                contacts.iter().position(|contact| contact.name == asked).ok_or_else(|| {
                    let help = suggestion(asked, contacts.iter().map(|contact| contact.name.as_str()));
                    let help = help.map_or(String::new(), |help| format!("\n   help: {help}"));
                    TheoryError::Unknown { asked: asked.to_owned(), help }
                })?
            }
        };
        let contact = &contacts[place];
        let law = &contact.part.interface;
        let start = job.start.memories().get(place).map_or(0.0, |memory| memory.apex().d);
        Ok(Self {
            job,
            name: &contact.name,
            law,
            start,
            materials: job.scenario.materials_of(place).unwrap_or_default().map(str::to_owned),
            profile: job.scenario.profile_of(place).unwrap_or_default().to_owned(),
        })
    }

    /// Returns the normal value if none is given: the indentation of the scenario at t = 0.
    pub fn pressed(&self) -> NormalGiven {
        NormalGiven::Indentation(self.start)
    }

    /// Returns the formulas of f(r) and g(x) for the type of the profile, or `None` for a profile given by numbers.
    pub fn formulas(&self) -> Option<[&'static str; 2]> {
        Some(match self.profile.as_str() {
            "flat" => ["0, r < b", "0, x < b"],
            "cone" => ["r tanθ", "(π/2) x tanθ"],
            "paraboloid" => ["r²/2R", "x²/R"],
            "sphere" => ["R - √(R²-r²)", "(x/2) ln((R+x)/(R-x))"],
            "truncated_cone" => ["0 up to b, (r-b) tanθ beyond", "0 up to b, x tanθ arccos(b/x) beyond"],
            "truncated_paraboloid" => ["0 up to b, (r²-b²)/2R beyond", "0 up to b, (x/R) √(x²-b²) beyond"],
            "rounded_flat" => {
                ["0 up to b, (r-b)²/2R beyond", "0 up to b, (x/R) [√(x²-b²) - b arccos(b/x)] beyond"]
            }
            "tipped_paraboloid" => [
                "br/R up to b, (r²+b²)/2R beyond",
                "(π/2) bx/R up to b, (x/R) [√(x²-b²) + b arcsin(b/x)] beyond",
            ],
            "powers" => ["Σ A rⁿ", "Σ κₙ A xⁿ, κₙ = √π Γ(n/2+1)/Γ((n+1)/2)"],
            "power" => ["A rⁿ", "κₙ A xⁿ, κₙ = √π Γ(n/2+1)/Γ((n+1)/2)"],
            _ => return None,
        })
    }
}
