//! The study file: which numbers of a scenario vary, how, and what is kept of each run.

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

/// Version of the form that this program reads.
const VERSION: u64 = 1;
/// Cases of a part where the file does not say.
const CHUNK: u64 = 1000;
/// Most cases of a part: they are held in memory.
const MOST_CHUNK: u64 = 1 << 20;

/// A study file, read: its numbers in SI.
#[derive(Debug, Clone)]
pub struct StudyFile {
    /// The scenario with the values of `set`.
    pub scenario: Scenario,
    /// Name of the scenario: that of its file without ending, or that of the study file.
    pub name: String,
    /// How the samples are drawn, as the file has it.
    pub sampling: Option<Sampling>,
    /// Number of samples at each point of the grids.
    pub cases: Option<u64>,
    /// Seed of the samples.
    pub seed: u64,
    /// Numbers that vary, in the order of the file.
    pub vary: Vec<(Parameter, Variation)>,
    /// Names of the results.
    pub results: Vec<String>,
    /// Cases of a part.
    pub chunk: u64,
    /// What is optimised instead of varied.
    pub goal: Option<Goal>,
    document: Document,
}

/// How a number varies, in SI.
#[derive(Debug, Clone, PartialEq)]
pub enum Variation {
    /// Values of a grid or a list.
    Values(Vec<f64>),
    /// Uniform distribution: bounds.
    Uniform([f64; 2]),
    /// Normal distribution: mean, standard deviation and, of the truncated one, bounds.
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
    /// Whatever is wrong with one of them, with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ScenarioError> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = read(path, &name)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self::from_str(&text, (&name, &stem), path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a study from a text: its file's name stands in errors, its stem is the name of a scenario that stands in it; `base` is the
    /// folder its files are looked for in.
    ///
    /// # Errors
    /// Whatever is wrong with it, with its place.
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
            return Err(at(Fault::new(place, format!("{path} varies: it has no value of its own")).on_key()));
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

    /// The study as a text that stands alone: with its scenario in it, tables included.
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

    /// An error of a later check, pointed into the file: the value under a key, or, with a name, what stands in it under that name
    /// or at that place of a list.
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
    /// The scenario, with its name.
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

/// A number that varies, and how.
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
        let message = format!("{path} counts whole things: it takes a list or a grid of whole numbers");
        return Err(Fault::new(place, message));
    }
    Ok((parameter, variation))
}
