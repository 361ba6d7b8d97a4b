//! Inputs: waveforms whose values a caller supplies.

use super::range;
use super::waveform::Values;
use crate::fault::Fault;
use crate::form::{InputForm, InterpolationForm};
use crate::path::At;
use crate::units::Kind;
use stickslip_drive::{Interpolation, Shape};

/// Returns an input whose initial value lies in its range.
pub(super) fn shape(at: &At<'_>, form: &InputForm, values: &mut Values<'_>) -> Result<Shape, Fault> {
    let initial = values.take(&at.key("initial"), form.initial)?;
    let bounds = at.key("range");
    let low = values.take(&bounds.index(0), form.range.0)?;
    let high = values.take(&bounds.index(1), form.range.1)?;
    if high < low {
        let fault = bounds.index(1).expected(format_args!("a value of at least {}", shown(low, values.kind)));
        return Err(fault.against_path(bounds.path()).help("a range is [smallest, largest]"));
    }
    if initial < low || initial > high {
        let (low, high) = (shown(low, values.kind), shown(high, values.kind));
        let fault = at.key("initial").expected(format_args!("a value in the range, {low} to {high}"));
        return Err(fault.against_path(bounds.path()).help("widen the range, or start inside it"));
    }
    let interpolation = match form.interpolation {
        InterpolationForm::Held => Interpolation::Held,
        InterpolationForm::Linear => Interpolation::Linear,
    };
    Ok(Shape::Input { initial, range: (low, high), interpolation })
}

/// Formats a value in SI, with its unit if the dimension is known.
pub(super) fn shown(value: f64, kind: Option<Kind>) -> String {
    let value = range::short(value);
    match kind {
        Some(kind) => format!("{value} {}", kind.si()),
        None => value,
    }
}
