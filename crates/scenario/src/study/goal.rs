//! Goal of `stickslip study optimise`: a result, and the numbers or the waveform on which it depends.

use super::form::{Amount, StudyForm};
use super::{Numbers, key};
use crate::fault::Fault;
use crate::form::Count;
use crate::parameter::Parameter;
use crate::path::{KeyPath, Step};
use crate::scenario::Scenario;

/// Maximum number of parameters in `over`.
const MOST_NUMBERS: usize = 6;
/// Default number of local searches.
const STARTS: u64 = 8;
/// Maximum number of local searches.
const MOST_STARTS: u64 = 64;
/// Maximum number of evaluations of a local search.
const MOST_EVALUATIONS: u64 = 100_000;

/// Optimisation goal; numbers in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// Whether the result is maximised; otherwise it is minimised.
    pub is_maximum: bool,
    /// Name of the result.
    pub result: String,
    /// Parameters with their bounds.
    pub over: Vec<(Parameter, [f64; 2])>,
    /// Waveform whose shape is optimised.
    pub shaped: Option<Shaped>,
    /// Number of local searches.
    pub starts: u64,
    /// Maximum number of evaluations of each local search, if given.
    pub evaluations: Option<u64>,
    /// Whether the worst result for periods within ± 1 % counts, if given.
    pub worst_of_period: Option<bool>,
}

/// Waveform whose shape is optimised within the limits of its driver.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaped {
    /// Key path, such as `waveforms.drive`.
    pub path: String,
    /// Index of the waveform in the model.
    pub waveform: usize,
    /// Basis of the shape.
    pub basis: Basis,
    /// Bounds of the period, s; equal for a fixed period.
    pub period: [f64; 2],
    /// Bounds of the values.
    pub window: [f64; 2],
    /// Maximum falling and rising rates, in `unit` per second.
    pub slew: Option<[f64; 2]>,
    /// Highest frequency, Hz.
    pub bandwidth: Option<f64>,
    /// Factor from the waveform's values to the values in the model: the stroke per volt of a stack, m/V, or 1.
    pub gain: f64,
    /// SI unit of the values.
    pub unit: &'static str,
}

/// Basis of a waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Polygon with this number of corners at equal time intervals.
    Corners(usize),
    /// Fourier series with this number of harmonics.
    Harmonics(usize),
}

impl StudyForm {
    /// Returns whether the study is an optimisation.
    pub(super) fn is_of_optimum(&self) -> bool {
        self.maximise.is_some() || self.minimise.is_some() || !self.over.is_empty() || self.waveform.is_some()
    }

    /// Returns the optimisation goal.
    pub(super) fn goal(&self, scenario: &Scenario) -> Result<Goal, Fault> {
        let (is_maximum, result) = match (&self.maximise, &self.minimise) {
            (Some(result), None) => (true, result),
            (None, Some(result)) => (false, result),
            (Some(_), Some(_)) => {
                return Err(Fault::new(key("minimise"), "give either \"maximise\" or \"minimise\""));
            }
            (None, None) => {
                let help = "such as \"maximise\": \"steady_motion.speed_m_s\"";
                return Err(Fault::new(key("over"), "the result to optimise is missing").help(help));
            }
        };
        let foreign = [
            ("vary", !self.vary.is_empty()),
            ("results", !self.results.is_empty()),
            ("cases", self.cases.is_some()),
            ("sampling", self.sampling.is_some()),
            ("chunk", self.chunk.is_some()),
        ];
        if let Some((name, _)) = foreign.iter().find(|(_, is_given)| *is_given) {
            let message = format!(
                "a study with \"{}\" has no \"{name}\"",
                ["minimise", "maximise"][usize::from(is_maximum)]
            );
            return Err(Fault::new(key(name), message).on_key());
        }
        let over: Vec<_> =
            self.over.iter().map(|(path, range)| over(scenario, path, range)).collect::<Result<_, _>>()?;
        if over.len() > MOST_NUMBERS {
            let message = format!("at most {MOST_NUMBERS} numbers, got {}", over.len());
            return Err(Fault::new(key("over"), message).on_key());
        }
        let shaped = self.waveform.as_ref().map(|form| form.shaped(scenario)).transpose()?;
        if over.is_empty() && shaped.is_none() {
            let help = "such as \"over\": { \"waveforms.drive.sawtooth.flyback\": [\"5 us\", \"0.5 ms\"] }";
            return Err(Fault::new(key("maximise"), "there is no variable to optimise").help(help));
        }
        let inside = |path: &str| shaped.as_ref().is_some_and(|shaped| path.starts_with(&shaped.path));
        if let Some((inner, _)) = over.iter().find(|(parameter, _)| inside(&parameter.path)) {
            let message = "the study replaces the whole waveform, so it has no such number";
            let place = KeyPath(vec![Step::Key("over".to_owned()), Step::Key(inner.path.clone())]);
            return Err(Fault::new(place, message)
                .on_key()
                .help("give the range in \"period\" of \"waveform\""));
        }
        Ok(Goal {
            is_maximum,
            result: result.clone(),
            over,
            shaped,
            starts: counted("starts", self.starts, 1, MOST_STARTS)?.unwrap_or(STARTS),
            evaluations: counted("evaluations", self.evaluations, 1, MOST_EVALUATIONS)?,
            worst_of_period: self.worst_of_period,
        })
    }
}

fn counted(name: &str, count: Option<Count>, least: u64, most: u64) -> Result<Option<u64>, Fault> {
    match count {
        Some(Count(count)) if !(least..=most).contains(&count) => {
            Err(Fault::expected(key(name), format!("a whole number from {least} to {most}")))
        }
        count => Ok(count.map(|Count(count)| count)),
    }
}

/// Returns a parameter of `over` with its bounds.
fn over(scenario: &Scenario, path: &str, range: &[Amount; 2]) -> Result<(Parameter, [f64; 2]), Fault> {
    let place = KeyPath(vec![Step::Key("over".to_owned()), Step::Key(path.to_owned())]);
    let parameter = scenario.number(path).map_err(|error| {
        let fault = Fault::new(place.clone(), format!("{path}: {}", error.message)).on_key();
        fault.maybe_help(error.help.clone())
    })?;
    if parameter.is_whole {
        let message = format!("{path} is a count; expected a continuous number");
        return Err(Fault::new(place, message).on_key());
    }
    let range = ordered(&Numbers { place: key("over"), unit: parameter.unit }, path, range)?;
    Ok((parameter, range))
}

/// Returns a lower and an upper bound.
pub(super) fn ordered(numbers: &Numbers, name: &str, [low, high]: &[Amount; 2]) -> Result<[f64; 2], Fault> {
    let [low, high] = [numbers.si(name, 0, low)?, numbers.si(name, 1, high)?];
    if low < high && (high - low).is_finite() {
        return Ok([low, high]);
    }
    let message = format!("the smallest value must be below the largest, got {low} and {high}");
    Err(Fault::new(numbers.inside(name, 1), message))
}
