//! Options of a benchmark.

use crate::problem::Known;
use std::path::PathBuf;

/// Options of a benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Scenario files.
    pub files: Vec<PathBuf>,
    /// Output folder; the results of the scenario NAME are in OUT/NAME.
    pub out: PathBuf,
    /// Wall time per scenario without the reference, s.
    pub budget: f64,
    /// Overrides of all scenarios: key path and value.
    pub set: Vec<(String, String)>,
    /// Known coordinates at the end, with the name of the scenario.
    pub known: Vec<(String, Known)>,
    /// Whether instructions are counted. Counting requires valgrind.
    pub instructions: bool,
    /// Whether the scaling of the run time is measured, too.
    pub growth: bool,
    /// Markdown page with tables and plots of all scenarios, if requested.
    pub page: Option<PathBuf>,
}
