//! Waveforms: shapes, timing and the dimension of their values.

use super::{Builder, Course, generator, input, names, pattern, range, shapes, table};
use crate::fault::Fault;
use crate::form::{HarmonicsForm, Moving, Periodic, WaveformForm, WaveformRef};
use crate::guide::Help;
use crate::path::{At, KeyPath};
use crate::quantity::{AnyQuantity, Dimension};
use crate::units::Kind;
use std::f64::consts::FRAC_PI_2;
use stickslip_drive::scene::{Named, Varying};
use stickslip_drive::{Harmonic, Shape, Timing, Waveform, WaveformError};

/// Highest order of a harmonic.
const MAX_ORDER: u64 = 1000;
/// Maximum number of terms of all sums of sines together. Each term costs a sine in every evaluation.
const MAX_TERMS: usize = 1000;

/// Dimension of the values of one waveform, which must agree in all its quantities.
pub(super) struct Values<'a> {
    pub(super) kind: Option<Kind>,
    /// Factor of the values: for voltages the stroke per volt of the driven stack, m/V; otherwise 1.
    gain: f64,
    /// Position of the waveform.
    at: At<'a>,
}

impl Values<'_> {
    /// Returns the path of the waveform.
    pub(super) fn path(&self) -> KeyPath {
        self.at.path()
    }

    /// Converts a rate of change in the file to the rate in the model.
    pub(super) fn scaled(&self, rate: f64) -> f64 {
        self.gain * rate
    }

    /// Converts a rate of change in the model to the rate in the file.
    pub(super) fn unscaled(&self, rate: f64) -> f64 {
        rate / self.gain
    }

    pub(super) fn take(&mut self, at: &At<'_>, value: AnyQuantity) -> Result<f64, Fault> {
        match (self.kind, value.kind) {
            (Some(known), Some(new)) if known != new => {
                let message = format!("expected {} like the values before it", known.article());
                let fault = at.expected(message.trim_start_matches("expected "));
                Err(fault.against_path(self.at.path()))
            }
            (known, new) => {
                self.kind = known.or(new);
                Ok(self.gain * value.si)
            }
        }
    }
}

impl Builder<'_> {
    /// Adds all named waveforms in the order of the file.
    pub(super) fn waveforms(&mut self) -> Result<(), Fault> {
        let form = self.form;
        let root = At::ROOT;
        let at = root.key("waveforms");
        for (name, waveform) in form.waveforms.iter() {
            let gain = self.gain(name);
            self.add((&at.key(name), name.to_owned()), waveform, gain)?;
        }
        Ok(())
    }

    /// Adds a waveform and returns its index. `gain` is the stroke per volt, m/V, or `None` if the waveform is not a voltage.
    pub(super) fn add(
        &mut self,
        (at, name): (&At<'_>, String),
        form: &WaveformForm,
        gain: Option<f64>,
    ) -> Result<usize, Fault> {
        if let WaveformForm::Harmonics(sum) = form {
            self.terms += sum.terms.len();
            if self.terms > MAX_TERMS {
                let message =
                    format!("expected at most {MAX_TERMS} terms in all waveforms, got {}", self.terms);
                return Err(at.key("harmonics").key("terms").fault(message).against_all());
            }
        }
        let mut values = Values { kind: None, gain: gain.unwrap_or(1.0), at: *at };
        let (part, delay) = waveform(at, form, &mut values)?;
        self.scene.waveforms.push(Named { name, part });
        let kind = values.kind.or(gain.map(|_| Kind::Voltage));
        self.courses.push(Course { kind, delay, gain });
        Ok(self.scene.waveforms.len() - 1)
    }

    /// Returns the index of a waveform whose values must have this dimension. An inline waveform is named by its path.
    pub(super) fn follow(&mut self, at: &At<'_>, waveform: &WaveformRef, kind: Kind) -> Result<usize, Fault> {
        let at = at.key("follows");
        let index =
            match waveform {
                WaveformRef::Name(name) => self.form.waveforms.find(name).ok_or_else(|| {
                    names::unknown(&at, ("waveform", "waveforms"), name, &self.form.waveforms)
                })?,
                WaveformRef::Inline(form) => self.add((&at, at.path().to_string()), form, None)?,
            };
        match self.courses.get(index).and_then(|course| course.kind) {
            Some(found) if found != kind => {
                let message =
                    format!("expected a waveform of {}s", kind.article().split_once(' ').map_or("", |w| w.1));
                let help = format!("its values have the unit of {}", found.article());
                let course = match waveform {
                    WaveformRef::Name(name) => At::ROOT.key("waveforms").key(name).path(),
                    WaveformRef::Inline(_) => at.path(),
                };
                Err(at.fault(message).help(help).against_path(course))
            }
            _ => Ok(index),
        }
    }

    /// Converts a quantity that may vary in time.
    pub(super) fn varying<D: Dimension>(&mut self, at: &At<'_>, value: &Moving<D>) -> Result<Varying, Fault> {
        match value {
            Moving::Constant(quantity) => Ok(Varying::Constant(quantity.si)),
            Moving::Follows(waveform) => self.follow(at, waveform, D::KIND).map(Varying::Follows),
        }
    }
}

fn waveform(at: &At<'_>, form: &WaveformForm, values: &mut Values<'_>) -> Result<(Waveform, f64), Fault> {
    let named = |name| at.key(name);
    let (key, (shape, timing)) = match form {
        WaveformForm::Table(form) => ("table", table::shape(&named("table"), form, values)?),
        WaveformForm::Input(form) => {
            ("input", (input::shape(&named("input"), form, values)?, Timing::every(1.0)))
        }
        WaveformForm::Generator(form) => {
            ("generator", (generator::shape(&named("generator"), form, values)?, Timing::every(1.0)))
        }
        WaveformForm::Chirp(form) => ("chirp", shapes::chirp(&named("chirp"), form, values)?),
        WaveformForm::Step(form) => ("step", shapes::step(&named("step"), form, values)?),
        _ => periodic(at, form, values)?,
    };
    let waveform = Waveform::new(shape, timing).map_err(|error| {
        let at = at.key(key);
        refused(&at, &error).against_path(at.path())
    })?;
    // Repeated points start at the time of the first point, so the delay is that of the waveform.
    let delay = waveform.timing().delay;
    Ok((waveform, delay))
}

/// Returns a periodic waveform, with bursts or a sequence if given.
fn periodic(
    at: &At<'_>,
    form: &WaveformForm,
    values: &mut Values<'_>,
) -> Result<(&'static str, (Shape, Timing)), Fault> {
    let Some((key, given)) = form.periodic() else { return Err(at.expected("a waveform with a period")) };
    let at = at.key(key);
    // Checks the timing first, because its keys usually precede the others.
    let timing = timing(&at, &given, key)?;
    let shape = match form {
        WaveformForm::Sawtooth(form) => shapes::sawtooth(&at, form, timing.period, values)?,
        WaveformForm::Triangle(form) => {
            Shape::Triangle { stroke: values.take(&at.key("stroke"), form.stroke)? }
        }
        WaveformForm::Sine(form) => {
            let amplitude = values.take(&at.key("amplitude"), form.amplitude)?;
            let offset = values.take(&at.key("offset"), form.offset)?;
            Shape::Sine { amplitude, phase: 0.0, offset }
        }
        WaveformForm::Harmonics(form) => harmonics(&at, form, values)?,
        WaveformForm::Cycloid(form) => {
            let flyback = shapes::half_flyback(&at, form.flyback, timing.period)?;
            Shape::Cycloid { stroke: values.take(&at.key("stroke"), form.stroke)?, flyback }
        }
        WaveformForm::TwoHarmonics(form) => shapes::two_harmonics(&at, form, values)?,
        WaveformForm::Parabola(form) => shapes::parabola(&at, form, timing.period, values)?,
        WaveformForm::Trapezoid(form) => shapes::trapezoid(&at, form, timing.period, values)?,
        WaveformForm::SCurve(form) => shapes::s_curve(&at, form, timing.period, values)?,
        _ => return Err(at.expected("a waveform with a period")),
    };
    let parts = pattern::sections(&at, &given, timing.period)?;
    Ok((
        key,
        match (shape, parts) {
            (shape, Some(parts)) => (pattern::of(&at, shape, parts)?, timing),
            // A sine contains its phase itself.
            (Shape::Sine { amplitude, offset, .. }, None) => {
                (Shape::Sine { amplitude, phase: timing.phase, offset }, Timing { phase: 0.0, ..timing })
            }
            (shape, None) => (shape, timing),
        },
    ))
}

/// Converts an error of the waveform, at the key that the error names.
fn refused(at: &At<'_>, error: &WaveformError) -> Fault {
    let message = error.to_string();
    let plain =
        message.strip_prefix(error.key()).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(&message);
    let at = at.key(error.key());
    match (error, plain.split_once(", got ")) {
        // The value of a range is not repeated.
        (WaveformError::Number { key: "range", .. }, Some((wanted, _))) => {
            at.fault(wanted).help("a caller can command the whole range")
        }
        // The number is shown as in the file: 1e308 would have 309 digits.
        (WaveformError::Number { key, .. }, Some((wanted, _))) if *key != "points" => {
            at.fault(wanted).with_value().ask(Help::Meaning)
        }
        _ => at.fault(plain),
    }
}

fn harmonics(at: &At<'_>, form: &HarmonicsForm, values: &mut Values<'_>) -> Result<Shape, Fault> {
    let (offset, at) = (at.key("offset"), at.key("terms"));
    if form.terms.is_empty() {
        return Err(at.fault("expected at least one term").ask(Help::Shape));
    }
    let mut terms = Vec::with_capacity(form.terms.len());
    for (i, term) in form.terms.iter().enumerate() {
        let at = at.index(i);
        let order = range::count_between(&at.key("order"), term.order.0, 1, MAX_ORDER)? as u32;
        let amplitude = values.take(&at.key("amplitude"), term.amplitude)?;
        terms.push(Harmonic { amplitude, order: order.into(), phase: term.phase.si });
    }
    if form.offset.si != 0.0 {
        let amplitude = values.take(&offset, form.offset)?;
        terms.push(Harmonic { amplitude, order: 0.0, phase: FRAC_PI_2 });
    }
    Ok(Shape::Harmonics { terms })
}

fn timing(at: &At<'_>, form: &Periodic, name: &str) -> Result<Timing, Fault> {
    let period = match (form.period, form.frequency) {
        (Some(period), None) => range::above_zero(&at.key("period"), period)?,
        (None, Some(frequency)) => 1.0 / range::above_zero(&at.key("frequency"), frequency)?,
        (None, None) => {
            let fault = at.missing("period").against_path(at.key("frequency").path());
            return Err(fault.help(format!("a {name} has a period or a frequency")));
        }
        (Some(_), Some(_)) => {
            return Err(at
                .key("frequency")
                .fault("the period is already given")
                .on_key()
                .help("keep one of them"));
        }
    };
    let delay = range::at_least_zero(&at.key("delay"), form.delay)?;
    let cycles = form.cycles.map(|cycles| range::number_above_zero(&at.key("cycles"), cycles)).transpose()?;
    Ok(Timing { period, delay, phase: form.phase.si, cycles })
}
