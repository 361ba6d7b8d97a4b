//! Generators: waveforms whose parameters a caller commands.

use super::input::shown;
use super::range;
use super::waveform::Values;
use crate::fault::Fault;
use crate::form::{Bounds, CycleForm, GeneratorForm, HeadingForm};
use crate::path::At;
use crate::quantity::Frequency;
use stickslip_drive::{Command, Cycle, Generator, Heading, Shape, Steps};

/// Returns a generator. Initial values must lie in their ranges, and the shortest period must exceed the flyback.
pub(super) fn shape(at: &At<'_>, form: &GeneratorForm, values: &mut Values<'_>) -> Result<Shape, Fault> {
    let bounds = at.key("range");
    let frequencies = frequencies(&bounds.key("frequency"), &form.range.frequency)?;
    let cycle = match &form.shape {
        CycleForm::Triangle => Cycle::Triangle,
        CycleForm::Sawtooth(sawtooth) => {
            let at = at.key("shape");
            let at = at.key("sawtooth");
            let flyback = range::above_zero(&at.key("flyback"), sawtooth.flyback)?;
            let highest = bounds.key("frequency");
            room(&highest.index(1), flyback, frequencies.1)
                .map_err(|fault| fault.against_path(at.key("flyback").path()))?;
            Cycle::Sawtooth { flyback }
        }
    };
    let stroke = values.take(&at.key("stroke"), form.stroke)?;
    let strokes = strokes(&bounds.key("stroke"), &form.range.stroke, values)?;
    if stroke < strokes.0 || stroke > strokes.1 {
        let [low, high] = [strokes.0, strokes.1].map(|bound| shown(bound, values.kind));
        let fault = at.key("stroke").expected(format_args!("a value in its range, {low} to {high}"));
        let fault = fault.against_path(bounds.path());
        return Err(fault.help("widen range.stroke, or start inside it"));
    }
    let frequency = range::at_least_zero(&at.key("frequency"), form.frequency)?;
    if frequency < frequencies.0 || frequency > frequencies.1 {
        let [low, high] = [frequencies.0, frequencies.1].map(range::short);
        let fault =
            at.key("frequency").expected(format_args!("a frequency in its range, {low} Hz to {high} Hz"));
        let fault = fault.against_path(bounds.path());
        return Err(fault.help("widen range.frequency, or start inside it"));
    }
    let heading = match form.heading {
        HeadingForm::Forward => Heading::Forward,
        HeadingForm::Backward => Heading::Backward,
    };
    let steps = form.steps.map_or(Steps::Endless, |count| Steps::Left(count.0));
    let initial = Command { stroke, frequency, heading, steps };
    Ok(Shape::Generator(Generator { cycle, initial, strokes, frequencies }))
}

fn strokes(at: &At<'_>, bounds: &Bounds, values: &mut Values<'_>) -> Result<(f64, f64), Fault> {
    let low = values.take(&at.index(0), bounds.0)?;
    let high = values.take(&at.index(1), bounds.1)?;
    if high < low {
        let fault = at.index(1).expected(format_args!("a value of at least {}", shown(low, values.kind)));
        let fault = fault.against_path(at.path());
        return Err(fault.help("a range is [smallest, largest]"));
    }
    Ok((low, high))
}

fn frequencies(at: &At<'_>, bounds: &Bounds<Frequency>) -> Result<(f64, f64), Fault> {
    let low = range::at_least_zero(&at.index(0), bounds.0)?;
    let high = bounds.1.si;
    if high < low {
        let what = format!("a frequency of at least {} Hz", range::short(low));
        return Err(at
            .index(1)
            .expected(what)
            .against_path(at.path())
            .help("a range is [smallest, largest]"));
    }
    Ok((low, high))
}

/// Checks that the shortest period is longer than the flyback.
fn room(at: &At<'_>, flyback: f64, highest: f64) -> Result<(), Fault> {
    if highest.recip() - flyback > 0.0 {
        return Ok(());
    }
    let below = range::short(flyback.recip());
    let fault = at.expected(format_args!("a frequency below {below} Hz, the reciprocal of the flyback"));
    Err(fault.help("reduce it, or shorten the flyback"))
}
