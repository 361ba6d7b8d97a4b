//! Waveform of an optimisation: basis of its shape, and limits of its driver.

use super::form::{Amount, ShapeForm};
use super::goal::{Basis, Shaped, ordered};
use super::{Numbers, key};
use crate::fault::Fault;
use crate::form::Count;
use crate::meaning::Piezo;
use crate::path::{KeyPath, Step};
use crate::scenario::Scenario;
use crate::suggest;
use stickslip_drive::scene::Varying;

/// Maximum number of corners or harmonics.
const MOST_CORNERS: u64 = 24;

/// Returns the path of a key of `waveform`.
fn place(name: &str) -> KeyPath {
    KeyPath(vec![Step::Key("waveform".to_owned()), Step::Key(name.to_owned())])
}

/// Returns the reader of the numbers of `waveform`.
fn numbers(unit: &'static str) -> Numbers {
    Numbers { place: key("waveform"), unit }
}

impl ShapeForm {
    /// Returns the waveform with the limits of the file and the driver.
    pub(super) fn shaped(&self, scenario: &Scenario) -> Result<Shaped, Fault> {
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
                return Err(fault.help("give a range for \"period\""));
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
                let message = "the smallest and the largest value are missing: no driver with a window follows this waveform";
                Err(Fault::new(key("waveform"), message).on_key().help("such as \"window\": [0, \"120 V\"]"))
            }
        }
    }

    /// Returns the maximum falling and rising voltage rates I/C, V/s.
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

    /// Returns the SI unit of the values of a waveform that is not a voltage.
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
    /// Refuses more corners or harmonics than the bandwidth allows at the shortest period.
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

/// Returns an optional number above 0.
fn positive(name: &str, unit: &'static str, amount: Option<&Amount>) -> Result<Option<f64>, Fault> {
    let Some(amount) = amount else { return Ok(None) };
    let value = numbers(unit).si(name, 0, amount).map_err(|fault| Fault { path: place(name), ..fault })?;
    if value > 0.0 { Ok(Some(value)) } else { Err(Fault::expected(place(name), "a number above 0")) }
}
