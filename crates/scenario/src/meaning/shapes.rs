//! Waveform shapes whose keys restrict each other.

use super::range;
use super::waveform::Values;
use crate::fault::Fault;
use crate::form::{
    ChirpForm, ParabolaForm, SCurveForm, SawtoothForm, StepForm, TrapezoidForm, TwoHarmonicsForm,
};
use crate::path::At;
use crate::quantity::{AnyQuantity, Time};
use crate::units::Kind;
use stickslip_drive::{Harmonic, Shape, Sweep, Timing};

/// Returns a sawtooth whose flyback is given, tuned to a resonance, or limited in its rate.
pub(super) fn sawtooth(
    at: &At<'_>,
    form: &SawtoothForm,
    period: f64,
    values: &mut Values<'_>,
) -> Result<Shape, Fault> {
    let flyback = match (form.flyback, form.resonance) {
        (Some(flyback), None) => self::flyback(at, flyback, period)?,
        (None, Some(resonance)) => {
            let tuned = range::above_zero(&at.key("resonance"), resonance)?.recip();
            if tuned >= period {
                let least = range::short(period.recip());
                let fault = at
                    .key("resonance")
                    .expected(format_args!("a frequency above that of the waveform, {least} Hz"));
                let paths = ["period", "frequency"].map(|key| at.key(key).path());
                let fault = paths.into_iter().fold(fault, Fault::against_path);
                return Err(fault.help("the flyback takes one period of the resonance"));
            }
            tuned
        }
        (None, None) if form.rate.is_some() => 0.0,
        (None, None) => {
            return Err(at
                .missing("flyback")
                .against_path(at.key("resonance").path())
                .against_path(at.key("rate").path()));
        }
        (Some(_), Some(_)) => {
            let fault = at.key("resonance").fault("the flyback is already given").on_key();
            return Err(fault.against_path(at.key("flyback").path()).help("keep one of them"));
        }
    };
    let stroke = values.take(&at.key("stroke"), form.stroke)?;
    let Some(given) = form.rate else { return Ok(Shape::Sawtooth { stroke, flyback }) };
    let rate = rate(&at.key("rate"), given, values)?;
    let least = stroke.abs() / (period - flyback);
    if rate < least {
        let unit = values.kind.map_or(String::new(), |kind| format!(" {}/s", kind.si()));
        let fault = at.key("rate").expected(format_args!(
            "at least {}{unit}, the rate of the rise",
            range::short(values.unscaled(least))
        ));
        let paths = ["stroke", "period", "frequency", "flyback", "resonance"].map(|key| at.key(key).path());
        let fault = paths.into_iter().fold(fault, Fault::against_path);
        return Err(fault.help(
            "with a smaller rate the waveform is a triangle of smaller stroke: reduce the stroke or the frequency",
        ));
    }
    Ok(Shape::Limited { stroke, flyback, rate })
}

/// Returns a rate above 0. Lengths have a velocity, voltages a slew rate, other values a plain number.
fn rate(at: &At<'_>, given: AnyQuantity, values: &mut Values<'_>) -> Result<f64, Fault> {
    let of = match given.kind {
        None => None,
        Some(Kind::Velocity) => Some(Kind::Length),
        Some(Kind::SlewRate) => Some(Kind::Voltage),
        Some(_) => return Err(at.expected("a rate such as \"20 mm/s\"")),
    };
    if let (Some(known), Some(of)) = (values.kind, of)
        && known != of
    {
        let message = format!("{} per s, like the stroke", known.article());
        return Err(at.expected(message).against_path(values.path()));
    }
    values.kind = values.kind.or(of);
    if given.si > 0.0 { Ok(values.scaled(given.si)) } else { Err(at.expected("a rate above 0")) }
}

pub(super) fn flyback(at: &At<'_>, flyback: Time, period: f64) -> Result<f64, Fault> {
    below(at, ("flyback", flyback), period)
}

/// Returns a time of at least 0 and below the period.
fn below(at: &At<'_>, (key, time): (&str, Time), period: f64) -> Result<f64, Fault> {
    let timing = ["period", "frequency"].map(|key| at.key(key).path());
    let at = at.key(key);
    let value = range::at_least_zero(&at, time)?;
    if value < period {
        return Ok(value);
    }
    let period = range::short(period);
    let fault = at.expected(format_args!("a time below the period of {period} s"));
    Err(timing.into_iter().fold(fault, Fault::against_path))
}

/// Returns a flyback above 0, by default half a period.
pub(super) fn half_flyback(at: &At<'_>, flyback: Option<Time>, period: f64) -> Result<f64, Fault> {
    let flyback = flyback.unwrap_or(Time::new(period / 2.0));
    range::above_zero(&at.key("flyback"), flyback)?;
    self::flyback(at, flyback, period)
}

pub(super) fn two_harmonics(
    at: &At<'_>,
    form: &TwoHarmonicsForm,
    values: &mut Values<'_>,
) -> Result<Shape, Fault> {
    let amplitude = values.take(&at.key("amplitude"), form.amplitude)?;
    let at = at.key("second");
    let second = range::number_between(&at, form.second, -0.25, 0.25)?;
    if second == 0.0 {
        return Err(at
            .expected("a relative amplitude other than 0")
            .help("without it the waveform is a \"sine\""));
    }
    let term = |amplitude, order| Harmonic { amplitude, order, phase: 0.0 };
    Ok(Shape::Harmonics { terms: vec![term(amplitude, 1.0), term(second * amplitude, 2.0)] })
}

pub(super) fn parabola(
    at: &At<'_>,
    form: &ParabolaForm,
    period: f64,
    values: &mut Values<'_>,
) -> Result<Shape, Fault> {
    let stroke = values.take(&at.key("stroke"), form.stroke)?;
    Ok(Shape::Parabola { stroke, turn: below(at, ("turn", form.turn), period)? })
}

pub(super) fn trapezoid(
    at: &At<'_>,
    form: &TrapezoidForm,
    period: f64,
    values: &mut Values<'_>,
) -> Result<Shape, Fault> {
    let stroke = values.take(&at.key("stroke"), form.stroke)?;
    let rise = range::at_least_zero(&at.key("rise"), form.rise)?;
    let hold = range::at_least_zero(&at.key("hold"), form.hold)?;
    let fall = range::at_least_zero(&at.key("fall"), form.fall.unwrap_or(form.rise))?;
    let busy = rise + hold + fall;
    let paths = ["hold", "fall", "period", "frequency"].map(|key| at.key(key).path());
    let at = at.key("rise");
    if busy > period * (1.0 + 1e-12) {
        let [busy, period] = [busy, period].map(range::short);
        let message = format!("rise, hold and fall take {busy} s, the period is {period} s");
        let fault = at.fault(message).help("the remaining time of the period is the rest");
        return Err(paths.into_iter().fold(fault, Fault::against_path));
    }
    if busy == 0.0 {
        let fault = at.fault("rise, hold and fall take no time");
        return Err(paths.into_iter().fold(fault, Fault::against_path));
    }
    Ok(Shape::Trapezoid { stroke, rise, hold, fall })
}

pub(super) fn s_curve(
    at: &At<'_>,
    form: &SCurveForm,
    period: f64,
    values: &mut Values<'_>,
) -> Result<Shape, Fault> {
    let flyback = half_flyback(at, form.flyback, period)?;
    let stroke = values.take(&at.key("stroke"), form.stroke)?;
    let rounding = range::above_zero(&at.key("rounding"), form.rounding)?;
    let most = 0.25 * flyback.min(period - flyback);
    if rounding > most * (1.0 + 1e-12) {
        let most = range::short(most);
        let paths = ["flyback", "period", "frequency"].map(|key| at.key(key).path());
        let fault = at
            .key("rounding")
            .expected(format_args!("at most a quarter of the shorter stroke time, {most} s"));
        return Err(paths.into_iter().fold(fault, Fault::against_path));
    }
    Ok(Shape::SCurve { stroke, flyback, rounding })
}

pub(super) fn chirp(
    at: &At<'_>,
    form: &ChirpForm,
    values: &mut Values<'_>,
) -> Result<(Shape, Timing), Fault> {
    let amplitude = values.take(&at.key("amplitude"), form.amplitude)?;
    let offset = values.take(&at.key("offset"), form.offset)?;
    let from = range::at_least_zero(&at.key("from"), form.from)?;
    let to = range::at_least_zero(&at.key("to"), form.to)?;
    if from == 0.0 && to == 0.0 {
        let fault = at.key("to").expected("a frequency above 0 Hz").against_path(at.key("from").path());
        return Err(fault.help("a chirp from 0 Hz to 0 Hz is constant"));
    }
    let duration = range::above_zero(&at.key("duration"), form.duration)?;
    let delay = range::at_least_zero(&at.key("delay"), form.delay)?;
    let sweep = Sweep { amplitude, offset, phase: form.phase.si, from, to, duration };
    Ok((Shape::Chirp(sweep), once(delay)))
}

pub(super) fn step(at: &At<'_>, form: &StepForm, values: &mut Values<'_>) -> Result<(Shape, Timing), Fault> {
    let height = values.take(&at.key("height"), form.height)?;
    let at = range::at_least_zero(&at.key("at"), form.at)?;
    // The time is a delay, so that the check of delays finds runs that end before the step.
    Ok((Shape::Step { height, at: 0.0 }, once(at)))
}

/// Returns the timing of a non-periodic shape.
fn once(delay: f64) -> Timing {
    Timing { delay, ..Timing::every(1.0) }
}
