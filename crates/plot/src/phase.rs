//! Phase pictures: velocity over displacement.

use crate::Label;
use crate::figure::Figure;
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// The path of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhasePath<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// Displacement, m.
    pub displacement: &'a [f64],
    /// Velocity, m/s, as many.
    pub velocity: &'a [f64],
}

/// Cycles from which on the earlier ones are drawn pale.
const MANY: usize = 3;
/// A cycle counts when the velocity has been in the lower and in the upper share of its range.
const SWING: f64 = 0.25;

/// Velocity over displacement, one curve per body. Where a body goes round more than a few times, all but its last
/// cycle is pale and lies behind.
pub fn phase_figure<'a>(title: &str, paths: &[PhasePath<'a>]) -> Figure<'a> {
    let last: Vec<usize> = paths.iter().map(|path| last_cycle(path.velocity).unwrap_or(0)).collect();
    let mut series = Vec::new();
    for (place, (path, &from)) in paths.iter().zip(&last).enumerate().filter(|(_, (_, from))| **from > 0) {
        let to = (from + 1).min(path.velocity.len());
        series.push(curve("earlier cycles", path, 0..to, Ink::Pale(place)));
    }
    for (place, (path, &from)) in paths.iter().zip(&last).enumerate() {
        series.push(curve(path.name, path, from..path.velocity.len(), Ink::Palette(place)));
    }
    let panel = Panel {
        x: Axis::new(Label::plain("displacement x"), "m"),
        y: Axis::new(Label::plain("velocity v"), "m/s"),
        series,
        absence: Label::plain("nothing moves"),
        ..Panel::default()
    };
    Figure { title: Label::plain(title), panels: vec![panel], ..Figure::default() }
}

fn curve<'a>(name: &str, path: &PhasePath<'a>, part: std::ops::Range<usize>, ink: Ink) -> Series<'a> {
    let slice = |values: &'a [f64]| values.get(part.clone()).unwrap_or(values);
    let style = Style { ink: Some(ink), dash: Some(Dash::Solid), width: 1.0 };
    Series { style, ..Series::new(name, slice(path.displacement), slice(path.velocity)) }
}

/// Where the last full cycle begins: the last but one place at which the velocity, after it was low, becomes high.
/// None where there are only a few cycles.
fn last_cycle(velocity: &[f64]) -> Option<usize> {
    let finite = velocity.iter().copied().filter(|v| v.is_finite());
    let (low, high) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let (fall, rise) = (low + SWING * (high - low), high - SWING * (high - low));
    let mut starts = Vec::new();
    let mut was_low = false;
    for (i, &v) in velocity.iter().enumerate() {
        if v < fall {
            was_low = true;
        } else if v > rise && was_low {
            was_low = false;
            starts.push(i);
        }
    }
    (starts.len() > MANY).then(|| starts[starts.len() - 2])
}
