//! What is asked to be measured.

use crate::problem::Known;
use std::path::PathBuf;

/// What is asked to be measured, and where to.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Scenario files.
    pub files: Vec<PathBuf>,
    /// Folder of what is measured: that of a scenario NAME is OUT/NAME.
    pub out: PathBuf,
    /// Wall time for each scenario, besides its reference, s.
    pub budget: f64,
    /// Values put into every scenario: key path and value.
    pub set: Vec<(String, String)>,
    /// Coordinates at the end of scenarios that are known from elsewhere, by the scenario's name.
    pub known: Vec<(String, Known)>,
    /// Whether instructions are counted, where valgrind is installed.
    pub instructions: bool,
    /// Whether what more of something costs is measured, too.
    pub growth: bool,
    /// A page in Markdown with the tables and pictures of all scenarios, where one is wanted.
    pub page: Option<PathBuf>,
}
