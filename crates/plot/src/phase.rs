//! Phase portraits: velocity over displacement.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};
use crate::{Coordinate, Label};
use std::ops::Range;

/// Motion of a body in one coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhasePath<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// Coordinate; `None` for the position along the slide.
    pub coordinate: Option<Coordinate>,
    /// Displacement, m or rad.
    pub displacement: &'a [f64],
    /// Velocity, m/s or rad/s, one per displacement.
    pub velocity: &'a [f64],
}

/// Maximum ratio of displacement and velocity ranges of bodies that share a panel.
const COMPARABLE: f64 = 8.0;
/// Minimum number of full cycles for which earlier cycles are pale.
const MANY: usize = 3;
/// Hysteresis of the cycle count: the velocity must pass the lower and the upper quarter of its range.
const SWING: f64 = 0.25;

const NOTHING: &str = "nothing moves";

/// Draws velocity over displacement, one curve per body and coordinate. Coordinates and bodies with much larger
/// ranges have panels of their own. A body has the same colour in all panels. For an oscillation about a fixed
/// position the cycles before the last full one are pale.
pub fn phase_figure<'a>(title: &str, paths: &[PhasePath<'a>]) -> Figure<'a> {
    let mut names: Vec<&str> = Vec::new();
    for path in paths {
        if !names.contains(&path.name) {
            names.push(path.name);
        }
    }
    let mut groups: Vec<Vec<(usize, &PhasePath<'a>)>> = Vec::new();
    for path in paths {
        let place = names.iter().position(|name| *name == path.name).unwrap_or(0);
        match groups.iter_mut().find(|group| group.iter().all(|(_, other)| is_comparable(path, other))) {
            Some(group) => group.push((place, path)),
            None => groups.push(vec![(place, path)]),
        }
    }
    if groups.is_empty() {
        return Figure::without_data(title, NOTHING);
    }
    groups.sort_by_key(|group| group.first().and_then(|(_, path)| path.coordinate));
    let panels: Vec<Panel<'a>> = groups.iter().map(|group| panel(group)).collect();
    let each = if panels.len() == 1 { 760 } else { 440 };
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(240, each, panels.len()),
        panels,
        arrangement: Arrangement::Column { share_x: false },
        ..Figure::default()
    }
    .with_room_for_legends()
}

fn panel<'a>(group: &[(usize, &PhasePath<'a>)]) -> Panel<'a> {
    let last: Vec<usize> = group.iter().map(|(_, path)| last_cycle(path)).collect();
    let mut series = Vec::new();
    for ((place, path), &from) in group.iter().zip(&last).filter(|(_, from)| **from > 0) {
        series.push(curve("", path, 0..from + 1, Ink::Pale(*place)));
    }
    for ((place, path), &from) in group.iter().zip(&last) {
        series.push(curve(path.name, path, from..path.velocity.len(), Ink::Palette(*place)));
    }
    if let Some(((place, path), _)) = group.iter().zip(&last).find(|(_, from)| **from > 0) {
        // A series without points at the end of the list: its legend entry comes last, while the pale curves are drawn first.
        series.push(curve("earlier cycles", path, 0..0, Ink::Pale(*place)));
    }
    let [x, y] = match group.first().and_then(|(_, path)| path.coordinate) {
        None => [("displacement x", "m"), ("velocity v", "m/s")],
        Some(Coordinate::Height) => [("height z", "m"), ("velocity dz/dt", "m/s")],
        Some(Coordinate::Pitch) => [("pitch θ", "rad"), ("rate dθ/dt", "rad/s")],
    }
    .map(|(label, unit)| Axis::new(Label::plain(label), unit));
    Panel { x, y, series, absence: Label::plain(NOTHING), ..Panel::default() }
}

fn curve<'a>(name: &str, path: &PhasePath<'a>, part: Range<usize>, ink: Ink) -> Series<'a> {
    let slice = |values: &'a [f64]| values.get(part.clone()).unwrap_or(values);
    let style = Style { ink: Some(ink), dash: Some(Dash::Solid), width: 1.0 };
    Series { style, ..Series::new(name, slice(path.displacement), slice(path.velocity)) }
}

fn is_comparable(a: &PhasePath<'_>, b: &PhasePath<'_>) -> bool {
    let ratio = |a: &[f64], b: &[f64]| {
        let (a, b) = (range(a), range(b));
        let (a, b) = (a.1 - a.0, b.1 - b.0);
        a == b || a.max(b) < COMPARABLE * a.min(b)
    };
    a.coordinate == b.coordinate && ratio(a.displacement, b.displacement) && ratio(a.velocity, b.velocity)
}

/// Returns the smallest and largest finite value.
fn range(values: &[f64]) -> (f64, f64) {
    let finite = values.iter().copied().filter(|v| v.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// Returns the index at which the last full cycle begins if most earlier points are within its displacement range; otherwise 0. A cycle
/// starts where the velocity becomes high after it was low.
fn last_cycle(path: &PhasePath<'_>) -> usize {
    let (low, high) = range(path.velocity);
    let (fall, rise) = (low + SWING * (high - low), high - SWING * (high - low));
    let mut starts = Vec::new();
    let mut was_low = false;
    for (i, &v) in path.velocity.iter().enumerate() {
        if v < fall {
            was_low = true;
        } else if v > rise && was_low {
            was_low = false;
            starts.push(i);
        }
    }
    let [_, .., start, _] = starts[..] else { return 0 };
    let Some((before, last)) = path.displacement.split_at_checked(start) else { return 0 };
    let (left, right) = range(last);
    let under = before.iter().filter(|x| (left..=right).contains(*x)).count();
    if starts.len() > MANY && 2 * under > before.len() { start } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_cycle_of_a_round_trip_is_found_and_a_journey_has_none() {
        // Ten rounds of 100 points. The velocity becomes high 17 points (60 degrees) after its zero.
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 100.0;
        let (x, v): (Vec<f64>, Vec<f64>) = (0..1000).map(|i| (-angle(i).cos(), angle(i).sin())).unzip();
        let start = last_cycle(&PhasePath { name: "", coordinate: None, displacement: &x, velocity: &v });
        assert!(start == 800 + 9 || start == 800 + 8, "{start}");
        let journey: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + 0.1 * i as f64).collect();
        assert_eq!(
            last_cycle(&PhasePath { name: "", coordinate: None, displacement: &journey, velocity: &v }),
            0
        );
        let few = PhasePath { name: "", coordinate: None, displacement: &x[..250], velocity: &v[..250] };
        assert_eq!(last_cycle(&few), 0);
        let gaps = [f64::NAN; 5];
        assert_eq!(
            last_cycle(&PhasePath { name: "", coordinate: None, displacement: &gaps, velocity: &gaps }),
            0
        );
    }
}
