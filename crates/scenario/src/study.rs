//! Study file: varied numbers of a scenario, their distributions, and the results to record.

mod form;
mod goal;
mod numbers;
mod shaped;

use crate::document::Document;
use crate::error::ScenarioError;
use crate::fault::Fault;
use crate::parameter::Parameter;
use crate::path::{KeyPath, Step};
use crate::reader::Reader;
use crate::refusal;
use crate::scenario::{Scenario, read};
use form::{SubjectForm, VariationForm};
use numbers::Numbers;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub use form::Sampling;
pub(crate) use form::StudyForm;
pub use goal::{Basis, Goal, Shaped};

/// Version of the file format that this program reads.
const VERSION: u64 = 1;
/// Default number of cases per part.
const CHUNK: u64 = 1000;
/// Maximum number of cases per part, which are held in memory.
const MOST_CHUNK: u64 = 1 << 20;

/// Study file that has been read; numbers in SI.
#[derive(Debug, Clone)]
pub struct StudyFile {
    /// Scenario with the values of `set`.
    pub scenario: Scenario,
    /// Name of the scenario: the name of its file without extension; for an inline scenario, the name of the study file.
    pub name: String,
    /// Sampling method, if given.
    pub sampling: Option<Sampling>,
    /// Number of samples at each grid point, if given.
    pub cases: Option<u64>,
    /// Seed of the random samples.
    pub seed: u64,
    /// Varied numbers in the order of the file.
    pub vary: Vec<(Parameter, Variation)>,
    /// Names of the results.
    pub results: Vec<String>,
    /// Number of cases per part.
    pub chunk: u64,
    /// Optimisation goal; `None` if numbers are varied.
    pub goal: Option<Goal>,
    document: Document,
}

/// Variation of a number, in SI.
#[derive(Debug, Clone, PartialEq)]
pub enum Variation {
    /// Values of a grid or a list.
    Values(Vec<f64>),
    /// Uniform distribution: bounds.
    Uniform([f64; 2]),
    /// Normal distribution: mean, standard deviation and, if truncated, bounds.
    Normal([f64; 2], Option<[f64; 2]>),
    /// Lognormal distribution: median and geometric standard deviation.
    Lognormal([f64; 2]),
    /// Triangular distribution: lower bound, mode, upper bound.
    Triangular([f64; 3]),
}

impl StudyFile {
    /// Reads a study file and the scenario that it names.
    ///
    /// # Errors
    /// Errors of study or scenario, with their positions.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = read(path, &name)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self::from_str(&text, (&name, &stem), path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a study from a text. `file` is the file name in messages, `stem` the name of an inline scenario, `base` the folder of files
    /// that the study names.
    ///
    /// # Errors
    /// Errors of study or scenario, with their positions.
    pub fn from_str(text: &str, (file, stem): (&str, &str), base: &Path) -> Result<Self, ScenarioError> {
        let (document, faults) = Document::read_study(file, text)?;
        if let Some(fault) = faults.into_iter().next() {
            return Err(document.report(fault).into());
        }
        let is_there = |name: &str| document.value.get(name).is_some();
        if is_there("stickslip") && !is_there("stickslip_study") {
            let help = "a study file names it: { \"stickslip_study\": 1, \"scenario\": \"drive.json\", … }; `stickslip schema study` has all keys";
            let fault = Fault::new(key("stickslip"), "this is a scenario, not a study").on_key();
            return Err(document.report(fault.help(help)).into());
        }
        let found = |error| ScenarioError::from(document.report(refusal::fault(&document, &error)));
        let form: StudyForm = serde_path_to_error::deserialize(Reader(&document.value)).map_err(found)?;
        let at = |fault: Fault| ScenarioError::from(document.report(fault));
        if form.stickslip_study.0 != VERSION {
            let fault = Fault::expected(key("stickslip_study"), VERSION);
            return Err(at(fault.help("the version of the format, a number")));
        }
        let chunk = form.chunk.map_or(CHUNK, |chunk| chunk.0);
        if !(1..=MOST_CHUNK).contains(&chunk) {
            return Err(at(Fault::expected(key("chunk"), format!("a whole number from 1 to {MOST_CHUNK}"))));
        }
        if form.results.is_empty() && !form.is_of_optimum() {
            return Err(at(Fault::new(key("results"), "expected at least one result")));
        }
        if let Some(path) = form.set.names().find(|path| form.vary.names().any(|varied| varied == *path)) {
            let place = KeyPath(vec![Step::Key("set".to_owned()), Step::Key(path.to_owned())]);
            return Err(at(Fault::new(place, format!("{path} varies, so it has no single value")).on_key()));
        }
        let (scenario, name) = form.subject((file, stem), base, &at)?;
        let vary: Result<Vec<_>, Fault> =
            form.vary.iter().map(|(path, variation)| varied(&scenario, path, variation)).collect();
        let vary = vary.map_err(&at)?;
        if let Some(twice) =
            form.results.iter().enumerate().find(|(i, name)| form.results[..*i].contains(name))
        {
            let path = KeyPath(vec![Step::Key("results".to_owned()), Step::Index(twice.0)]);
            return Err(at(Fault::new(path, "this result is named twice")));
        }
        let goal = form.is_of_optimum().then(|| form.goal(&scenario)).transpose().map_err(&at)?;
        Ok(Self {
            scenario,
            name,
            goal,
            sampling: form.sampling,
            cases: form.cases.map(|cases| cases.0),
            seed: form.seed.map_or(1, |seed| seed.0),
            vary,
            results: form.results,
            chunk,
            document,
        })
    }

    /// Returns the study as JSON that needs no other files: the scenario and its tables are inlined.
    #[must_use]
    pub fn portable(&self) -> String {
        let mut value = self.document.value.clone();
        if let Some(keys) = value.as_object_mut() {
            keys.remove("set");
            keys.insert(
                "scenario".to_owned(),
                serde_json::from_str(&self.scenario.resolved()).unwrap_or_default(),
            );
        }
        value.to_string()
    }

    /// Returns an error of a later check, with its position in the file. `at` is a key of the study. `inside` selects a key in its
    /// object, or an entry of its list.
    pub fn refusal(
        &self,
        at: &str,
        inside: Option<&str>,
        message: &str,
        help: Option<String>,
    ) -> ScenarioError {
        let mut path = key(at);
        path.0.extend(inside.and_then(|inside| match &self.document.value[at] {
            Value::Array(list) => {
                Some(Step::Index(list.iter().position(|entry| entry == inside).unwrap_or(0)))
            }
            Value::Object(_) => Some(Step::Key(inside.to_owned())),
            _ => None,
        }));
        self.document.report(Fault::new(path, message).maybe_help(help)).into()
    }
}

impl StudyForm {
    /// Returns the scenario and its name.
    fn subject(
        &self,
        (file, stem): (&str, &str),
        base: &Path,
        at: &dyn Fn(Fault) -> ScenarioError,
    ) -> Result<(Scenario, String), ScenarioError> {
        let texts = self.set.iter().map(|(path, value)| {
            let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            (path.to_owned(), text)
        });
        let texts: Vec<(String, String)> = texts.collect();
        let set: Vec<(&str, &str)> =
            texts.iter().map(|(path, text)| (path.as_str(), text.as_str())).collect();
        match &self.scenario {
            SubjectForm::Inline(value) => {
                let scenario = Scenario::from_str_with(&value.to_string(), file, base, &set)?;
                Ok((scenario, stem.to_owned()))
            }
            SubjectForm::Path(path) => {
                let path: PathBuf = base.join(path);
                if !path.is_file() {
                    let place = key("scenario");
                    let missing = Scenario::load(&path).err();
                    let fault = Fault::new(place, format!("there is no file {}", path.display()));
                    return Err(at(fault.maybe_help(missing.and_then(|error| error.help.clone()))));
                }
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                Ok((Scenario::load_with(&path, &set)?, stem))
            }
        }
    }
}

fn key(name: &str) -> KeyPath {
    KeyPath(vec![Step::Key(name.to_owned())])
}

/// Returns a varied number and its variation.
fn varied(scenario: &Scenario, path: &str, form: &VariationForm) -> Result<(Parameter, Variation), Fault> {
    let place = KeyPath(vec![Step::Key("vary".to_owned()), Step::Key(path.to_owned())]);
    let parameter = scenario.number(path).map_err(|error| {
        let fault = Fault::new(place.clone(), format!("{path}: {}", error.message)).on_key();
        fault.maybe_help(error.help.clone())
    })?;
    let variation = Numbers { place: place.clone(), unit: parameter.unit }.variation(form)?;
    let is_good = match &variation {
        Variation::Values(values) => values.iter().all(|value| value.fract() == 0.0),
        _ => false,
    };
    if parameter.is_whole && !is_good {
        let message = format!("{path} is a count: expected a list or a grid of whole numbers");
        return Err(Fault::new(place, message));
    }
    Ok((parameter, variation))
}
