//! The study file: which numbers of a scenario vary, how, and what is kept of each run.

mod form;
mod goal;

use crate::document::Document;
use crate::error::ScenarioError;
use crate::fault::Fault;
use crate::form::Count;
use crate::parameter::Parameter;
use crate::path::{KeyPath, Step};
use crate::quantity::quantity;
use crate::reader::Reader;
use crate::refusal;
use crate::scenario::{Scenario, read};
use form::{Amount, Normal, SubjectForm, VariationForm};
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
/// Most values of a grid or a list.
const MOST_VALUES: u64 = 1 << 20;

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

/// The numbers of a variation: where it stands, and their SI unit.
struct Numbers {
    place: KeyPath,
    unit: &'static str,
}

impl Numbers {
    fn variation(&self, form: &VariationForm) -> Result<Variation, Fault> {
        let [mut a, mut b, mut c] = [0.0; 3];
        let mut read = |kind: &str, amounts: &[&Amount]| -> Result<(), Fault> {
            for (place, (number, amount)) in [&mut a, &mut b, &mut c].into_iter().zip(amounts).enumerate() {
                *number = self.si(kind, place, amount)?;
            }
            Ok(())
        };
        Ok(match form {
            VariationForm::Grid((low, high, count)) => {
                read("grid", &[low, high])?;
                self.spaced("grid", [a, b], count, |low, high, share| low + (high - low) * share)?
            }
            VariationForm::Log((low, high, count)) => {
                read("log", &[low, high])?;
                if !(a > 0.0 && b > 0.0) {
                    let message = "equal ratios need a first and a last value above 0";
                    return Err(Fault::new(self.inside("log", usize::from(a > 0.0)), message));
                }
                let of = |low, high, share| low * math::exp(math::ln(high / low) * share);
                self.spaced("log", [a, b], count, of)?
            }
            VariationForm::List(values) if values.is_empty() => {
                return Err(Fault::new(self.place.clone(), "expected at least one value"));
            }
            VariationForm::List(values) => {
                let values = values.iter().enumerate().map(|(place, value)| self.si("list", place, value));
                Variation::Values(values.collect::<Result<_, _>>()?)
            }
            VariationForm::Uniform([low, high]) => {
                read("uniform", &[low, high])?;
                Variation::Uniform([a, b])
            }
            VariationForm::Normal(Normal(all)) => {
                read("normal", &all.iter().take(2).collect::<Vec<_>>())?;
                let bound =
                    |place: usize| all.get(place).map(|bound| self.si("normal", place, bound)).transpose();
                Variation::Normal([a, b], bound(2)?.zip(bound(3)?).map(|(low, high)| [low, high]))
            }
            VariationForm::Lognormal((median, deviation)) => {
                read("lognormal", &[median])?;
                Variation::Lognormal([a, *deviation])
            }
            VariationForm::Triangular([low, mode, high]) => {
                read("triangular", &[low, mode, high])?;
                Variation::Triangular([a, b, c])
            }
        })
    }

    /// The place of an entry of a variation's list.
    fn inside(&self, kind: &str, place: usize) -> KeyPath {
        let mut path = self.place.clone();
        path.0.extend([Step::Key(kind.to_owned()), Step::Index(place)]);
        path
    }

    fn si(&self, kind: &str, place: usize, amount: &Amount) -> Result<f64, Fault> {
        let text = match amount {
            Amount::Number(number) => return Ok(*number),
            Amount::Text(text) => text,
        };
        quantity(text, self.unit).map_err(|message| {
            let mut lines = message.splitn(2, "\n   help: ").map(str::to_owned);
            Fault::new(self.inside(kind, place), lines.next().unwrap_or_default()).maybe_help(lines.next())
        })
    }

    /// Values from the first to the last one, both as they are given.
    fn spaced(
        &self,
        kind: &str,
        [low, high]: [f64; 2],
        Count(count): &Count,
        of: impl Fn(f64, f64, f64) -> f64,
    ) -> Result<Variation, Fault> {
        if !(1..=MOST_VALUES).contains(count) {
            let wanted = format!("a number of values from 1 to {MOST_VALUES}");
            return Err(Fault::expected(self.inside(kind, 2), wanted));
        }
        if *count > 1 && low >= high {
            let message = format!("the first value must be below the last, got {low} and {high}");
            return Err(Fault::new(self.inside(kind, 1), message));
        }
        let last = count - 1;
        let value = |k: u64| match k {
            0 => low,
            k if k == last => high,
            k => of(low, high, k as f64 / last as f64),
        };
        Ok(Variation::Values((0..*count).map(value).collect()))
    }
}
