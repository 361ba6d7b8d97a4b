//! Parameter study: many runs of one scenario with different parameter values, stored in parts on disk.
//!
//! Modules in reading order:
//! * `design`: parameter values of each case, with `spread` (distributions) and `points` (sampling).
//! * `wanted`: results of each run; `worker`: run of one case; `quick`: run of one case without reading the scenario again.
//! * `part`: a part of the results as Parquet file; `folder`: folder of the parts; `desk`: distribution of parts among threads; `shard`:
//!   distribution of parts among processes.
//! * `statistics` and `sobol_indices`: evaluation; `csv`: export.

mod csv;
mod design;
mod desk;
mod error;
mod folder;
mod indices;
mod latin;
mod normal;
mod part;
mod plan;
pub(crate) mod points;
mod quick;
mod shard;
mod sobol_directions;
mod sobol_indices;
mod sobol_points;
mod spread;
mod statistics;
pub(crate) mod wanted;
pub(crate) mod worker;

pub use desk::Ran;
pub use error::StudyError;
pub use folder::Status;
pub use indices::{IndexTable, Indices};
pub use plan::Forecast;
pub use shard::Shard;
pub use statistics::{Extremes, Quantiles, Statistics};

use design::Design;
use serde_json::json;
use std::path::{Path, PathBuf};
use stickslip_run::{Job, program};
use stickslip_scenario::{ScenarioError, StudyFile};
use wanted::Wanted;

/// Maximum number of parts, which are files in one folder.
const MOST_PARTS: u64 = 1 << 22;

/// A parameter study, read from a study file and checked.
pub struct Study {
    /// The scenario.
    pub job: Job,
    pub(crate) file: StudyFile,
    pub(crate) design: Design,
    pub(crate) wanted: Vec<Wanted>,
    /// SHA-256 of all data on which the content of a part depends: scenario, variations, results and program version.
    ///
    /// The number of cases is excluded, so that a study can be enlarged, except for a Latin hypercube.
    pub hash: String,
}

impl Study {
    /// Reads and checks a study file.
    ///
    /// # Errors
    /// Fails if the file or its scenario is invalid, with the location of the error.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        Self::new(StudyFile::load(path)?)
    }

    /// Reads and checks a study from text; see [`StudyFile::from_str`].
    ///
    /// # Errors
    /// Fails if the text or its scenario is invalid, with the location of the error.
    pub fn from_str(text: &str, (file, stem): (&str, &str), base: &Path) -> Result<Self, ScenarioError> {
        Self::new(StudyFile::from_str(text, (file, stem), base)?)
    }

    fn new(file: StudyFile) -> Result<Self, ScenarioError> {
        if let Some(goal) = &file.goal {
            let key = if goal.is_maximum { "maximise" } else { "minimise" };
            let help = "run it with `stickslip study optimise`".to_owned();
            return Err(file.refusal(
                key,
                None,
                "this study is an optimisation, it has no cases",
                Some(help),
            ));
        }
        let job = Job::new(file.scenario.clone(), file.name.clone(), PathBuf::new())?;
        let design = Design::new(&file)?;
        if design.cases.div_ceil(file.chunk) > MOST_PARTS {
            let message = format!("{} cases give more than {MOST_PARTS} parts", design.cases);
            let help = "increase \"chunk\", the number of cases per part".to_owned();
            let key = if design.spreads > 0 { "cases" } else { "vary" };
            return Err(file.refusal(key, None, &message, Some(help)));
        }
        let wanted = file
            .results
            .iter()
            .map(|name| Wanted::named(&file, &job, ("results", name)))
            .collect::<Result<_, _>>()?;
        let mut study = Self { job, file, design, wanted, hash: String::new() };
        study.hash = stickslip_run::hash(&study.definition().to_string());
        Ok(study)
    }

    /// Returns all data on which the content of a part depends, for the hash.
    fn definition(&self) -> serde_json::Value {
        json!({
            "program": format!("{} {}", program::NAME, program::VERSION),
            "scenario": self.job.hash,
            "design": self.design.definition(),
            "results": self.file.results,
            "chunk": self.file.chunk,
        })
    }

    /// Returns the study as text without references to other files. The text gives the same study with the same hash.
    #[must_use]
    pub fn portable(&self) -> String {
        self.file.portable()
    }

    /// Returns the number of cases.
    #[must_use]
    pub fn cases(&self) -> u64 {
        self.design.cases
    }

    /// Returns the number of parts.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.design.cases.div_ceil(self.file.chunk)
    }

    /// Returns the cases of a part.
    #[must_use]
    pub fn part(&self, part: u64) -> std::ops::Range<u64> {
        let first = part.saturating_mul(self.file.chunk).min(self.design.cases);
        first..first.saturating_add(self.file.chunk).min(self.design.cases)
    }

    /// Returns key paths and SI units of the varied parameters, in order.
    pub fn varied(&self) -> impl Iterator<Item = (&str, &'static str)> {
        self.design.axes.iter().map(|axis| (axis.path.as_str(), axis.unit))
    }

    /// Returns the names of the results, as in column headers.
    pub fn results(&self) -> impl Iterator<Item = &str> {
        self.file.results.iter().map(String::as_str)
    }

    /// Returns the words that the codes of a result represent, or `None` for a number.
    pub fn codes(&self, result: usize) -> Option<&[String]> {
        self.wanted.get(result)?.codes.as_deref()
    }

    /// Reads a result of all cases from the parts in a folder: a number, or the code of a word. NaN for cases without the result.
    ///
    /// # Errors
    /// Fails if parts are missing or cannot be read.
    pub fn column(&self, folder: &Path, result: usize) -> Result<Vec<f64>, StudyError> {
        self.check_complete(folder)?;
        let mut all = Vec::new();
        self.each_part(folder, |_, open| {
            all.extend(open.result(self, result)?);
            Ok(())
        })?;
        Ok(all)
    }

    /// Reads the reasons for missing results of all cases from the parts in a folder.
    ///
    /// # Errors
    /// Fails if parts are missing or cannot be read.
    pub fn errors(&self, folder: &Path) -> Result<Vec<Option<String>>, StudyError> {
        self.check_complete(folder)?;
        let mut all = Vec::new();
        self.each_part(folder, |_, open| {
            all.extend(open.errors(self)?);
            Ok(())
        })?;
        Ok(all)
    }

    /// Returns the values of the varied parameters in a case, SI.
    #[must_use]
    pub fn values(&self, case: u64) -> Vec<f64> {
        let mut values = vec![0.0; self.design.axes.len()];
        self.design.write(case, &mut values);
        values
    }

    /// Returns a case as overrides of the scenario, such as `contacts.ball.friction=0.15`.
    #[must_use]
    pub fn overrides(&self, case: u64) -> Vec<(String, String)> {
        self.design.overrides(&self.values(case))
    }
}
