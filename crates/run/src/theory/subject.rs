//! The contact that is asked about.

use crate::job::Job;
use std::io;
use stickslip_contact::{FirstLoadingError, Interface, NormalGiven};
use stickslip_scenario::{ScenarioError, suggestion};
use thiserror::Error;

/// A contact of a job, by itself.
#[derive(Clone)]
pub struct Subject<'a> {
    /// The scenario.
    pub job: &'a Job,
    /// Its name.
    pub name: &'a str,
    /// Its constants: those of one of its identical members.
    pub law: &'a Interface,
    /// Indentation at t = 0, m; negative: open.
    pub start: f64,
    /// Names of its materials.
    pub materials: [String; 2],
    /// Word for its profile.
    pub profile: String,
}

/// Why there is no answer.
#[derive(Debug, Error)]
pub enum TheoryError {
    /// A scenario without contacts.
    #[error("{0}: the scenario has no contacts")]
    NoContacts(String),
    /// A name that no contact has.
    #[error("--contact {asked}  there is no contact \"{}\"{help}", .asked.escape_debug())]
    Unknown {
        /// The name.
        asked: String,
        /// What was meant, perhaps; on a line of its own.
        help: String,
    },
    /// More than one contact and no name.
    #[error("{file}: expected --contact, for the scenario has {count}\n   help: name one of them: {names}")]
    Several {
        /// Name of the scenario.
        file: String,
        /// How many.
        count: usize,
        /// Their names.
        names: String,
    },
    /// No first loading fits.
    #[error("{option}{error}", option = option(.0), error = .0)]
    Loading(FirstLoadingError),
    /// A corner of a history that cannot be reached.
    #[error("corner {corner} of the history: {source}")]
    Corner {
        /// Which, from 1.
        corner: usize,
        /// Why.
        source: FirstLoadingError,
    },
    /// A history that is none.
    #[error("--history  {0}")]
    History(String),
    /// A table of a history.
    #[error(transparent)]
    Table(#[from] ScenarioError),
    /// The files.
    #[error("{path}: the results cannot be written: {words}")]
    Write {
        /// Where to.
        path: String,
        /// What the system says.
        words: String,
        /// The same.
        source: io::Error,
    },
}

/// What asked for it, as the options of the program are named.
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
    /// The contact of a name, or the only one.
    ///
    /// # Errors
    /// No contact, none of that name, or several and no name.
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

    /// What presses it unless something else is asked for: the scenario's indentation at t = 0.
    pub fn pressed(&self) -> NormalGiven {
        NormalGiven::Indentation(self.start)
    }

    /// Formulas of f(r) and g(x), by the name of the profile; none of a profile that is given by numbers.
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
