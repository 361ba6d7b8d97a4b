//! Optimisation: maximum or minimum of a result over parameters of a scenario or the shape of a waveform.
//!
//! Modules in reading order:
//! * `space`: conversion of a point of the unit cube to a scenario; `shape`: waveforms within driver limits.
//! * `search`: local searches from several points. Every evaluation is written to a journal.
//! * `flatness`: decrease of the result near the optimum; `report`: output.

mod flatness;
mod report;
mod search;
mod shape;
mod space;

pub use flatness::Section;
pub use report::Report;

use crate::journal::{Held, Journal};
use crate::sweep::StudyError;
use crate::sweep::wanted::Wanted;
use crate::sweep::worker::{Fault, record, refused, without_output};
use search::{Effort, Local, SCREENED};
use space::Space;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use stickslip_run::{Job, Watcher, program};
use stickslip_scenario::{Goal, ScenarioError, StudyFile};

/// Name of the journal in the folder of the results.
const JOURNAL: &str = "evaluations.txt";

/// Results of a point, with `None` for results that are not finite; or the reason of a failure.
type Written = Result<Vec<Option<f64>>, String>;

/// Factors on the period for a robust optimum: ± 1 %.
const STRETCHES: [f64; 3] = [0.99, 1.0, 1.01];
/// Maximum number of further local searches, started from better points on the sections through the optimum.
const ROUNDS: usize = 8;
/// Maximum number of evaluations of a local search, divided by the number of coordinates plus one.
const EVALUATIONS: usize = 40;

/// An optimisation problem, read from a study file and checked.
pub struct Optimum {
    /// The scenario to be optimised.
    pub job: Job,
    pub(crate) goal: Goal,
    pub(crate) wanted: Wanted,
    pub(crate) space: Space,
    /// Factors on the waveform periods at which each point is evaluated.
    stretches: Vec<f64>,
    seed: u64,
    /// SHA-256 of all data on which the evaluations depend.
    pub hash: String,
}

/// Result of an optimisation.
#[derive(Debug, Clone)]
pub struct Best {
    pub(crate) point: Vec<f64>,
    /// Result for each factor on the period.
    pub(crate) values: Vec<f64>,
    pub(crate) locals: Vec<Local>,
    /// Sections: the result along each coordinate through the optimum.
    pub sections: Vec<Section>,
    /// Number of evaluations, and number of evaluations without a result.
    pub(crate) counts: (usize, usize),
}

impl Optimum {
    /// Reads and checks a study file.
    ///
    /// # Errors
    /// Fails if the file or its scenario is invalid, with the location of the error; or if the study has cases instead
    /// of a goal.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        Self::new(&StudyFile::load(path)?)
    }

    /// Reads and checks a study from text; see [`StudyFile::from_str`].
    ///
    /// # Errors
    /// Fails as [`Self::load`] does.
    pub fn from_str(text: &str, (file, stem): (&str, &str), base: &Path) -> Result<Self, ScenarioError> {
        Self::new(&StudyFile::from_str(text, (file, stem), base)?)
    }

    fn new(file: &StudyFile) -> Result<Self, ScenarioError> {
        let Some(goal) = file.goal.clone() else {
            let help =
                "run it with `stickslip study run`; an optimisation needs \"maximise\" or \"minimise\""
                    .to_owned();
            return Err(file.refusal(
                "vary",
                None,
                "this study has cases, it is not an optimisation",
                Some(help),
            ));
        };
        let key = if goal.is_maximum { "maximise" } else { "minimise" };
        let job = Job::new(file.scenario.clone(), file.name.clone(), PathBuf::new())?;
        let wanted = Wanted::named(file, &job, (key, &goal.result))?;
        if wanted.codes.is_some() {
            return Err(file.refusal(
                key,
                None,
                "this result is a word: an optimisation needs a number",
                None,
            ));
        }
        let space = Space::new(&goal, &job);
        let stretches = match (goal.worst_of_period, space.has_period()) {
            (Some(true), false) => {
                let message = "no named waveform has a variable period";
                return Err(file.refusal("worst_of_period", None, message, None));
            }
            (Some(false), _) | (None, false) => vec![1.0],
            (_, true) => STRETCHES.to_vec(),
        };
        let definition = serde_json::json!({
            "program": format!("{} {}", program::NAME, program::VERSION),
            "scenario": job.hash,
            "goal": format!("{goal:?}"),
            "stretches": stretches,
            "seed": file.seed,
        });
        let hash = stickslip_run::hash(&definition.to_string());
        Ok(Self { job, goal, wanted, space, stretches, seed: file.seed, hash })
    }

    /// Returns the maximum number of evaluations, each with one run per period factor.
    #[must_use]
    pub fn most_evaluations(&self) -> u64 {
        let starts = self.goal.starts;
        1 + starts * (SCREENED + self.evaluations() as u64) + flatness::most(self.dimensions()) as u64
    }

    /// Returns the number of coordinates.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.space.names().len()
    }

    fn evaluations(&self) -> usize {
        self.goal.evaluations.map_or(EVALUATIONS * (self.dimensions() + 1), |most| most as usize)
    }

    /// Runs the optimisation on `threads` threads. The result does not depend on the number of threads.
    ///
    /// The watcher receives the number of evaluations. Each evaluation is written to a journal in the folder `out`; an interrupted search
    /// resumes from this journal unless `is_fresh`.
    ///
    /// # Errors
    /// Fails if the journal belongs to another search, the folder cannot be written, the watcher interrupts, or no
    /// point has the result.
    pub fn run(
        &self,
        out: &Path,
        (threads, is_fresh): (usize, bool),
        watcher: &(dyn Watcher + Sync),
    ) -> Result<Best, StudyError> {
        let path = out.join(JOURNAL);
        let failed = |source| StudyError::Disk { path: path.clone(), source };
        fs::create_dir_all(out).map_err(failed)?;
        let (journal, held) = Journal::held(path.clone(), &self.hash, is_fresh).map_err(failed)?;
        if held == Held::Foreign {
            let why = "its scenario, ranges or goal differ, or another version of the program wrote it";
            return Err(StudyError::Foreign { path, why: why.to_owned() });
        }
        let bench = Bench { optimum: self, journal, path: &path, watcher, done: AtomicU64::new(0) };
        let effort =
            Effort { starts: self.goal.starts, evaluations: self.evaluations(), seed: self.seed, threads };
        let judge = |point: &[f64]| bench.judge(point);
        let locals = search::search(&self.space.present(&self.job), effort, &judge);
        bench.check()?;
        let Some(mut locals) = locals else { return Err(StudyError::AllFailed(bench.reason())) };
        // Among local searches with equal results, the first is selected. There is at least one local search.
        let better = |best: Option<(Vec<f64>, f64)>, local: &Local| match best {
            Some(best) if best.1 >= local.to.1 => Some(best),
            _ => Some(local.to.clone()),
        };
        let (mut point, mut value) = locals.iter().fold(None, better).unwrap_or_default();
        let mut rounds = 0;
        let sections = loop {
            let (sections, beside) = flatness::sections(&self.space, &point, threads, &judge);
            bench.check()?;
            // A point on a section may be better, because the simplex method cannot cross a ridge of the result.
            let Some(found) = beside.filter(|found| found.1 > value && rounds < ROUNDS) else {
                break sections;
            };
            let local = search::again((&found.0, found.1), self.evaluations(), &judge);
            bench.check()?;
            (point, value) = local.to.clone();
            locals.push(local);
            rounds += 1;
        };
        let sections = sections.into_iter().map(|section| section.signed(self.sign())).collect();
        let values = bench.found(&point).unwrap_or_default();
        bench.journal.sort().map_err(failed)?;
        Ok(Best { point, values, locals, sections, counts: bench.counts() })
    }

    /// Returns 1 for a maximum and -1 for a minimum: the factor with which larger results are better.
    pub(crate) fn sign(&self) -> f64 {
        if self.goal.is_maximum { 1.0 } else { -1.0 }
    }
}

/// Evaluates points and stores their results.
struct Bench<'o> {
    optimum: &'o Optimum,
    journal: Journal,
    path: &'o Path,
    watcher: &'o (dyn Watcher + Sync),
    done: AtomicU64,
}

impl Bench<'_> {
    /// Returns an error if the search was interrupted or the journal could not be written.
    fn check(&self) -> Result<(), StudyError> {
        match self.journal.fault() {
            Some(source) => Err(StudyError::Disk { path: self.path.to_owned(), source }),
            None if self.watcher.goes_on() => Ok(()),
            None => Err(StudyError::Interrupted),
        }
    }

    /// Returns the number of evaluations, and the number of evaluations without a result.
    fn counts(&self) -> (usize, usize) {
        let all = self.journal.all::<Written>();
        let has_none =
            |found: &&Written| !found.as_ref().is_ok_and(|values| values.iter().all(Option::is_some));
        (all.len(), all.iter().filter(has_none).count())
    }

    /// Returns the reason of the first point without a result.
    fn reason(&self) -> String {
        let reasons = self.journal.all::<Written>().into_iter().find_map(Result::err);
        reasons.unwrap_or_else(|| "the result has no value".to_owned())
    }

    /// Returns the worst result of a point over all period factors, signed so that larger is better. Returns NaN if a result is missing.
    fn judge(&self, point: &[f64]) -> f64 {
        let sign = self.optimum.sign();
        let worst =
            |worst: f64, value: &f64| if value.is_finite() { worst.min(sign * value) } else { f64::NAN };
        match self.found(point) {
            Ok(values) if values.iter().all(|value| value.is_finite()) => {
                values.iter().fold(f64::INFINITY, worst)
            }
            _ => f64::NAN,
        }
    }

    /// Returns the results of a point for each period factor, or the reason of a failure.
    fn found(&self, point: &[f64]) -> Result<Vec<f64>, String> {
        let compute = || {
            let found = match self.evaluate(point) {
                Ok(values) => {
                    Ok(values.into_iter().map(|value| value.is_finite().then_some(value)).collect())
                }
                Err(Fault::Failed(why)) => Err(why),
                Err(Fault::Interrupted) => Err(String::new()),
            };
            self.watcher.reached((self.done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
            found
        };
        // An empty reason means that the watcher interrupted.
        let is_kept = |found: &Written| !found.as_ref().is_err_and(String::is_empty);
        let found = self.journal.found(&point, compute, is_kept)?;
        Ok(found.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect())
    }

    fn evaluate(&self, point: &[f64]) -> Result<Vec<f64>, Fault> {
        let Optimum { job, space, wanted, stretches, .. } = self.optimum;
        let (mut values, mut row) = (Vec::new(), Vec::new());
        for stretch in stretches {
            if !self.watcher.goes_on() {
                return Err(Fault::Interrupted);
            }
            let case = job.with(&space.overrides(point, *stretch)).map_err(|error| refused(&error))?;
            let wanted = (std::slice::from_ref(wanted), self.watcher);
            record(without_output(case), wanted, &mut row, &mut values)?;
        }
        Ok(values)
    }
}
