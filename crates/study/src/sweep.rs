//! A study: many runs of one scenario that differ in some of its numbers, in parts on disk.
//!
//! In reading order: `design` (which numbers a case has) on `spread` (distributions) and `points` (samples), `wanted` (what is kept
//! of each run), `worker` (one case after the other; `quick` where nothing has to be read anew), `part` (a piece of the result as
//! Parquet) in a `folder`, `desk` (parts among threads), `shard` (parts among processes), `statistics` and `sobol_indices` (what
//! the results say), `csv` (the result as one table).

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

/// Most parts of a study: files of one folder.
const MOST_PARTS: u64 = 1 << 22;

/// A study, read and checked.
pub struct Study {
    /// The scenario that is run.
    pub job: Job,
    pub(crate) file: StudyFile,
    pub(crate) design: Design,
    pub(crate) wanted: Vec<Wanted>,
    /// SHA-256 of all that the bytes of a part depend on but its number: scenario, variations, results and version of the program. The
    /// number of cases does not belong to it, so that a study can grow, except for a Latin hypercube.
    pub hash: String,
}

impl Study {
    /// Reads and checks a study file.
    ///
    /// # Errors
    /// Whatever is wrong with it or its scenario, with its place.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        Self::new(StudyFile::load(path)?)
    }

    /// The same of a text; see [`StudyFile::from_str`].
    ///
    /// # Errors
    /// Whatever is wrong with it or its scenario, with its place.
    pub fn from_str(text: &str, (file, stem): (&str, &str), base: &Path) -> Result<Self, ScenarioError> {
        Self::new(StudyFile::from_str(text, (file, stem), base)?)
    }

    fn new(file: StudyFile) -> Result<Self, ScenarioError> {
        if let Some(goal) = &file.goal {
            let key = if goal.is_maximum { "maximise" } else { "minimise" };
            let help = "`stickslip study optimise` takes it".to_owned();
            return Err(file.refusal(key, None, "this study asks for an optimum, not for cases", Some(help)));
        }
        let job = Job::new(file.scenario.clone(), file.name.clone(), PathBuf::new())?;
        let design = Design::new(&file)?;
        if design.cases.div_ceil(file.chunk) > MOST_PARTS {
            let message = format!("{} cases make more than {MOST_PARTS} parts", design.cases);
            let help = "raise \"chunk\", the number of cases in a part".to_owned();
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

    /// What the bytes of a part depend on.
    fn definition(&self) -> serde_json::Value {
        json!({
            "program": format!("{} {}", program::NAME, program::VERSION),
            "scenario": self.job.hash,
            "design": self.design.definition(),
            "results": self.file.results,
            "chunk": self.file.chunk,
        })
    }

    /// The study as a text that stands alone; read back it is the same study, with the same hash.
    #[must_use]
    pub fn portable(&self) -> String {
        self.file.portable()
    }

    /// Number of cases.
    #[must_use]
    pub fn cases(&self) -> u64 {
        self.design.cases
    }

    /// Number of parts.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.design.cases.div_ceil(self.file.chunk)
    }

    /// Cases of a part.
    #[must_use]
    pub fn part(&self, part: u64) -> std::ops::Range<u64> {
        let first = part.saturating_mul(self.file.chunk).min(self.design.cases);
        first..first.saturating_add(self.file.chunk).min(self.design.cases)
    }

    /// Paths of the numbers that vary, in order, and their SI units.
    pub fn varied(&self) -> impl Iterator<Item = (&str, &'static str)> {
        self.design.axes.iter().map(|axis| (axis.path.as_str(), axis.unit))
    }

    /// Names of the results, as columns have them.
    pub fn results(&self) -> impl Iterator<Item = &str> {
        self.file.results.iter().map(String::as_str)
    }

    /// The words that the codes of a result stand for; none of a number.
    pub fn codes(&self, result: usize) -> Option<&[String]> {
        self.wanted.get(result)?.codes.as_deref()
    }

    /// A result of all cases from the parts in a folder: a number, or the code of a word; NaN where there is none.
    ///
    /// # Errors
    /// Parts that are missing or cannot be read.
    pub fn column(&self, folder: &Path, result: usize) -> Result<Vec<f64>, StudyError> {
        self.check_complete(folder)?;
        let mut all = Vec::new();
        self.each_part(folder, |_, open| {
            all.extend(open.result(self, result)?);
            Ok(())
        })?;
        Ok(all)
    }

    /// Why each case in the parts of a folder has no results.
    ///
    /// # Errors
    /// Parts that are missing or cannot be read.
    pub fn errors(&self, folder: &Path) -> Result<Vec<Option<String>>, StudyError> {
        self.check_complete(folder)?;
        let mut all = Vec::new();
        self.each_part(folder, |_, open| {
            all.extend(open.errors(self)?);
            Ok(())
        })?;
        Ok(all)
    }

    /// The values of the numbers that vary in a case, SI.
    #[must_use]
    pub fn values(&self, case: u64) -> Vec<f64> {
        let mut values = vec![0.0; self.design.axes.len()];
        self.design.write(case, &mut values);
        values
    }

    /// A case as overrides of the scenario, such as `contacts.ball.friction=0.15`.
    #[must_use]
    pub fn overrides(&self, case: u64) -> Vec<(String, String)> {
        self.design.overrides(&self.values(case))
    }
}
