//! What `stickslip study optimise` searches: a result, and the numbers or the waveform that it depends on.

use super::form::{Amount, ShapeForm, StudyForm};
use super::{Numbers, key};
use crate::fault::Fault;
use crate::form::Count;
use crate::meaning::Piezo;
use crate::parameter::Parameter;
use crate::path::{KeyPath, Step};
use crate::scenario::Scenario;
use crate::suggest;
use stickslip_drive::scene::Varying;

/// Most numbers of `over`.
const MOST_NUMBERS: usize = 6;
/// Local searches where the file does not say.
const STARTS: u64 = 8;
/// Most local searches.
const MOST_STARTS: u64 = 64;
/// Most evaluations of a local search.
const MOST_EVALUATIONS: u64 = 100_000;
/// Most corners or harmonics.
const MOST_CORNERS: u64 = 24;

/// What is optimised, its numbers in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// Whether the maximum is searched; otherwise the minimum.
    pub is_maximum: bool,
    /// Name of the result.
    pub result: String,
    /// Numbers, each with its least and largest value.
    pub over: Vec<(Parameter, [f64; 2])>,
    /// The waveform whose shape is searched.
    pub shaped: Option<Shaped>,
    /// Number of local searches.
    pub starts: u64,
    /// Most evaluations of each, where the file says.
    pub evaluations: Option<u64>,
    /// Whether the worst of period ± 1 % counts, where the file says.
    pub worst_of_period: Option<bool>,
}

/// A waveform whose shape is searched, within the limits of its driver.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaped {
    /// Its key path, such as `waveforms.drive`.
    pub path: String,
    /// Its place in the scene.
    pub waveform: usize,
    /// What it is made of.
    pub basis: Basis,
    /// Least and largest period, s; equal for a fixed one.
    pub period: [f64; 2],
    /// Least and largest value.
    pub window: [f64; 2],
    /// Largest rates down and up, values per second.
    pub slew: Option<[f64; 2]>,
    /// Highest frequency, Hz.
    pub bandwidth: Option<f64>,
    /// Factor from its values to those of the scene: the stroke per volt of a stack, m/V, or 1.
    pub gain: f64,
    /// SI unit of its values.
    pub unit: &'static str,
}

/// What a waveform is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// A polygon with so many corners at equal distances in time.
    Corners(usize),
    /// So many harmonics.
    Harmonics(usize),
}

impl StudyForm {
    /// Whether it asks for an optimum.
    pub(super) fn is_of_optimum(&self) -> bool {
        self.maximise.is_some() || self.minimise.is_some() || !self.over.is_empty() || self.waveform.is_some()
    }

    /// What it asks for.
    pub(super) fn goal(&self, scenario: &Scenario) -> Result<Goal, Fault> {
        let (is_maximum, result) = match (&self.maximise, &self.minimise) {
            (Some(result), None) => (true, result),
            (None, Some(result)) => (false, result),
            (Some(_), Some(_)) => {
                return Err(Fault::new(key("minimise"), "give either \"maximise\" or \"minimise\""));
            }
            (None, None) => {
                let help = "such as \"maximise\": \"steady_motion.speed_m_s\"";
                return Err(Fault::new(key("over"), "which result is optimised is missing").help(help));
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
            return Err(Fault::new(key("maximise"), "there is nothing to optimise over").help(help));
        }
        let inside = |path: &str| shaped.as_ref().is_some_and(|shaped| path.starts_with(&shaped.path));
        if let Some((inner, _)) = over.iter().find(|(parameter, _)| inside(&parameter.path)) {
            let message = "the waveform is replaced as a whole: it has no such number any more";
            let place = KeyPath(vec![Step::Key("over".to_owned()), Step::Key(inner.path.clone())]);
            return Err(Fault::new(place, message)
                .on_key()
                .help("\"waveform\" takes a range of its \"period\""));
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

/// A number of `over` with its range.
fn over(scenario: &Scenario, path: &str, range: &[Amount; 2]) -> Result<(Parameter, [f64; 2]), Fault> {
    let place = KeyPath(vec![Step::Key("over".to_owned()), Step::Key(path.to_owned())]);
    let parameter = scenario.number(path).map_err(|error| {
        let fault = Fault::new(place.clone(), format!("{path}: {}", error.message)).on_key();
        fault.maybe_help(error.help.clone())
    })?;
    if parameter.is_whole {
        let message = format!("{path} counts whole things: it is no number that can change by any amount");
        return Err(Fault::new(place, message).on_key());
    }
    let range = ordered(&Numbers { place: key("over"), unit: parameter.unit }, path, range)?;
    Ok((parameter, range))
}

/// A least and a largest value.
fn ordered(numbers: &Numbers, name: &str, [low, high]: &[Amount; 2]) -> Result<[f64; 2], Fault> {
    let [low, high] = [numbers.si(name, 0, low)?, numbers.si(name, 1, high)?];
    if low < high && (high - low).is_finite() {
        return Ok([low, high]);
    }
    let message = format!("the least value must be below the largest, got {low} and {high}");
    Err(Fault::new(numbers.inside(name, 1), message))
}

/// Where a key of `waveform` stands.
fn place(name: &str) -> KeyPath {
    KeyPath(vec![Step::Key("waveform".to_owned()), Step::Key(name.to_owned())])
}

/// The numbers of `waveform`.
fn numbers(unit: &'static str) -> Numbers {
    Numbers { place: key("waveform"), unit }
}

impl ShapeForm {
    fn shaped(&self, scenario: &Scenario) -> Result<Shaped, Fault> {
        let scene = &scenario.scene;
        let paths: Vec<String> =
            scene.waveforms.iter().map(|named| format!("waveforms.{}", named.name)).collect();
        let Some(waveform) = paths.iter().position(|path| *path == self.path) else {
            let fault = Fault::new(place("path"), "there is no such waveform");
            return Err(fault.maybe_help(suggest::help(&self.path, paths.iter().map(String::as_str))));
        };
        let commands = |varying: Varying| varying == Varying::Follows(waveform);
        let stack = scenario.stacks.iter().find(|stack| stack.by_voltage && commands(stack.command));
        let unit = if stack.is_some() { "V" } else { self.unit(scenario) };
        let bandwidth = positive("bandwidth", "Hz", self.bandwidth.as_ref())?;
        let low = stack.and_then(|stack| stack.driver?.low);
        let shaped = Shaped {
            path: self.path.clone(),
            waveform,
            basis: self.basis()?,
            period: self.period(scene.waveforms[waveform].part.period())?,
            window: self.window(stack, unit)?,
            slew: self.slew(stack)?,
            bandwidth: bandwidth.or(low.map(|low| low.frequency)),
            gain: stack.and_then(|stack| stack.stack.stroke_per_volt).unwrap_or(1.0),
            unit,
        };
        shaped.check_bandwidth()?;
        Ok(shaped)
    }

    fn basis(&self) -> Result<Basis, Fault> {
        let count = |name: &str, count: Count, least: u64| match count.0 {
            n if (least..=MOST_CORNERS).contains(&n) => Ok(n as usize),
            _ => Err(Fault::expected(place(name), format!("a whole number from {least} to {MOST_CORNERS}"))),
        };
        match (self.corners, self.harmonics) {
            (Some(corners), None) => Ok(Basis::Corners(count("corners", corners, 3)?)),
            (None, Some(harmonics)) => Ok(Basis::Harmonics(count("harmonics", harmonics, 2)?)),
            _ => Err(Fault::new(key("waveform"), "give either \"corners\" or \"harmonics\"").on_key()),
        }
    }

    fn period(&self, own: Option<f64>) -> Result<[f64; 2], Fault> {
        let period = match (&self.period, own) {
            (Some(range), _) => ordered(&numbers("s"), "period", range)?,
            (None, Some(period)) => [period; 2],
            (None, None) => {
                let fault = Fault::new(place("path"), "this waveform has no period");
                return Err(fault.help("give a range of it as \"period\""));
            }
        };
        if period[0] > 0.0 {
            return Ok(period);
        }
        Err(Fault::expected(numbers("s").inside("period", 0), "a time above 0"))
    }

    fn window(&self, stack: Option<&Piezo>, unit: &'static str) -> Result<[f64; 2], Fault> {
        match (&self.window, stack.and_then(|stack| stack.driver?.window)) {
            (Some(window), _) => ordered(&numbers(unit), "window", window),
            (None, Some((low, high))) => Ok([low, high]),
            (None, None) => {
                let message =
                    "the least and largest value are missing: no driver with a window follows this waveform";
                Err(Fault::new(key("waveform"), message).on_key().help("such as \"window\": [0, \"120 V\"]"))
            }
        }
    }

    /// Largest rates down and up, I/C.
    fn slew(&self, stack: Option<&Piezo>) -> Result<Option<[f64; 2]>, Fault> {
        let own = positive("current", "A", self.current.as_ref())?.map(|current| (current, current));
        let current = own.or(stack.and_then(|stack| stack.driver?.current));
        match (current, stack.and_then(|stack| stack.stack.capacitance)) {
            (Some((sink, source)), Some(capacitance)) => Ok(Some([sink / capacitance, source / capacitance])),
            (Some(_), None) => {
                let message = "no stack with a capacitance follows this waveform";
                Err(Fault::new(place("current"), message))
            }
            (None, _) => Ok(None),
        }
    }

    /// SI unit of the values of a waveform that no voltage follows.
    fn unit(&self, scenario: &Scenario) -> &'static str {
        let kinds = ["sawtooth", "triangle", "trapezoid", "parabola", "cycloid", "s_curve"];
        let strokes = kinds.map(|kind| format!("{kind}.stroke"));
        let others = [
            "sine.amplitude",
            "two_harmonics.amplitude",
            "harmonics.terms[0].amplitude",
            "table.offset",
            "chirp.amplitude",
        ];
        let mut all = strokes.iter().map(String::as_str).chain(others);
        let unit = |key: &str| {
            scenario.number(&format!("{}.{key}", self.path)).ok().filter(|found| found.value.is_some())
        };
        all.find_map(unit).map_or("", |found| found.unit)
    }
}

impl Shaped {
    /// Refuses more corners or harmonics than the bandwidth lets through at the shortest period.
    fn check_bandwidth(&self) -> Result<(), Fault> {
        let Some(bandwidth) = self.bandwidth else { return Ok(()) };
        let shortest = self.period[0];
        let (name, count, most) = match self.basis {
            Basis::Corners(n) => ("corners", n, 2.0 * bandwidth * shortest),
            Basis::Harmonics(n) => ("harmonics", n, bandwidth * shortest),
        };
        if count as f64 <= most {
            return Ok(());
        }
        let most = most.floor();
        let message =
            format!("a bandwidth of {bandwidth} Hz allows {most:.0} {name} in a period of {shortest} s");
        Err(Fault::new(place(name), message))
    }
}

/// A number above 0.
fn positive(name: &str, unit: &'static str, amount: Option<&Amount>) -> Result<Option<f64>, Fault> {
    let Some(amount) = amount else { return Ok(None) };
    let value = numbers(unit).si(name, 0, amount).map_err(|fault| Fault { path: place(name), ..fault })?;
    if value > 0.0 { Ok(Some(value)) } else { Err(Fault::expected(place(name), "a number above 0")) }
}
