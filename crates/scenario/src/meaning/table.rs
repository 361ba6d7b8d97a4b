//! Waveforms given by points. Points of files have already been read.

use super::range;
use super::waveform::Values;
use crate::fault::Fault;
use crate::form::{JoinForm, Point, TableForm};
use crate::guide::Help;
use crate::path::At;
use stickslip_drive::{Shape, Timing};

/// Returns the waveform of a table, with gain, offset, cubic interpolation and repetition.
pub(super) fn shape(
    at: &At<'_>,
    form: &TableForm,
    values: &mut Values<'_>,
) -> Result<(Shape, Timing), Fault> {
    let Some(points) = &form.points else {
        return Err(at
            .missing("points")
            .against_path(at.path())
            .help("or \"file\" with the names of its columns \"time\" and \"value\""));
    };
    let delay = range::at_least_zero(&at.key("delay"), form.delay)?;
    let table = at;
    let at = at.key("points");
    if points.len() < 2 {
        let fault = at.fault(format!("expected at least two points, got {}", points.len()));
        return Err(fault.ask(Help::Shape));
    }
    let pairs = self::points(&at, points, values)?;
    let points = scaled(pairs, table, form, values)?;
    let timing = Timing { period: 1.0, delay, phase: 0.0, cycles: None };
    let smooth = form.interpolation == JoinForm::Cubic;
    if !smooth && !form.repeat {
        return Ok((Shape::Table { points }, timing));
    }
    if form.repeat && points.first().map(|point| point.0) == points.last().map(|point| point.0) {
        return Err(at.fault("all points have the same time: there is no period to repeat"));
    }
    Ok((Shape::Curve { points, smooth, repeated: form.repeat }, timing))
}

/// Returns points in ascending order of time.
fn points(at: &At<'_>, points: &[Point], values: &mut Values<'_>) -> Result<Vec<(f64, f64)>, Fault> {
    let list = at.path();
    let mut pairs: Vec<(f64, f64)> = Vec::with_capacity(points.len());
    for (i, &Point(time, value)) in points.iter().enumerate() {
        let at = at.index(i);
        if pairs.last().is_some_and(|last| time.si < last.0) {
            let fault =
                at.index(0).expected("a time not before the point before it").against_path(list.clone());
            return Err(fault.help("times ascend; two points at the same time are a jump"));
        }
        if pairs.len() > 1 && pairs[i - 2].0 == time.si {
            let fault = at.index(0).fault("three points have the same time").against_path(list.clone());
            return Err(fault.help("two points at the same time are a jump; a third one has no effect"));
        }
        pairs.push((time.si, values.take(&at.index(1), value)?));
    }
    Ok(pairs)
}

/// Applies gain and offset to points.
fn scaled(
    mut pairs: Vec<(f64, f64)>,
    at: &At<'_>,
    form: &TableForm,
    values: &mut Values<'_>,
) -> Result<Vec<(f64, f64)>, Fault> {
    let offset = values.take(&at.key("offset"), form.offset)?;
    if !form.gain.is_finite() || form.gain == 0.0 {
        return Err(at.key("gain").expected("a number other than 0"));
    }
    if form.gain != 1.0 || offset != 0.0 {
        for pair in &mut pairs {
            pair.1 = form.gain * pair.1 + offset;
        }
    }
    Ok(pairs)
}
