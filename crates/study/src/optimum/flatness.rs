//! Decrease of a result near its optimum: sections along each coordinate.

use super::search::Judge;
use super::space::Space;
use crate::each::each;

/// Distances from the optimum at which the result is evaluated, relative to the range of a coordinate.
const DISTANCES: [f64; 5] = [1.0 / 512.0, 1.0 / 128.0, 1.0 / 32.0, 1.0 / 8.0, 1.0 / 2.0];

/// The result along one coordinate, with all other coordinates at the optimum.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Name of the coordinate.
    pub name: String,
    /// SI unit; empty for a coordinate of a waveform shape, whose values are fractions of a range.
    pub unit: &'static str,
    /// Value at the optimum.
    pub best: f64,
    /// Values of the coordinate in ascending order, each with the worst result; NaN without result.
    pub points: Vec<(f64, f64)>,
    /// Searched range.
    pub bounds: [f64; 2],
    /// Whether the optimum is at the lower and at the upper bound.
    pub at_bound: [bool; 2],
}

impl Section {
    pub(super) fn signed(mut self, sign: f64) -> Self {
        self.points.iter_mut().for_each(|(_, value)| *value *= sign);
        self
    }

    /// Returns the points as (distance from the optimum relative to the range, result).
    #[must_use]
    pub fn distances(&self) -> Vec<(f64, f64)> {
        let [low, high] = self.bounds;
        self.points.iter().map(|(x, value)| ((x - self.best) / (high - low), *value)).collect()
    }

    /// Returns the range in which the result is within a fraction of the optimum, by linear interpolation. An end of the range is `None` if
    /// the search range ends first.
    #[must_use]
    pub fn range(&self, share: f64) -> [Option<f64>; 2] {
        let Some(at) = self.points.iter().position(|(x, _)| *x == self.best) else { return [None; 2] };
        let optimum = self.points[at].1;
        let loss = |value: f64| if value.is_nan() { f64::INFINITY } else { (value - optimum).abs() };
        let most = share * optimum.abs();
        let end = |points: &mut dyn Iterator<Item = &(f64, f64)>| {
            let (mut x, mut before) = (self.best, 0.0);
            for (next, value) in points {
                let lost = loss(*value);
                if lost > most {
                    let part = if lost.is_finite() { (most - before) / (lost - before) } else { 0.0 };
                    return Some(x + (next - x) * part);
                }
                (x, before) = (*next, lost);
            }
            None
        };
        [end(&mut self.points[..at].iter().rev()), end(&mut self.points[at + 1..].iter())]
    }
}

/// Returns the maximum number of evaluations of all sections.
pub(super) fn most(dimensions: usize) -> usize {
    2 * DISTANCES.len() * dimensions
}

/// Returns the sections through a point, and the best point on these sections with its result. The best point is `None` without results.
pub(super) fn sections(
    space: &Space,
    point: &[f64],
    threads: usize,
    judge: &Judge<'_>,
) -> (Vec<Section>, Option<(Vec<f64>, f64)>) {
    let places: Vec<Vec<f64>> = point.iter().map(|share| places(*share)).collect();
    let all: Vec<(usize, f64)> = places
        .iter()
        .enumerate()
        .flat_map(|(i, places)| places.iter().map(move |place| (i, *place)))
        .collect();
    let moved = |k: usize| {
        let mut moved = point.to_vec();
        moved[all[k].0] = all[k].1;
        moved
    };
    let values = each(all.len(), threads, |k| judge(&moved(k)));
    let known = (0..all.len()).filter(|k| !values[*k].is_nan());
    let best = known.max_by(|a, b| values[*a].total_cmp(&values[*b])).map(|k| (moved(k), values[k]));
    let numbers = space.numbers();
    let section = |(i, name): (usize, String)| Section {
        name,
        unit: numbers.get(i).map_or("", |(_, unit, _)| unit),
        best: space.value(i, point[i]),
        points: all
            .iter()
            .zip(&values)
            .filter(|((coordinate, _), _)| *coordinate == i)
            .map(|((_, share), value)| (space.value(i, *share), *value))
            .collect(),
        bounds: numbers.get(i).map_or([0.0, 1.0], |(.., range)| *range),
        at_bound: [point[i] <= 0.0, point[i] >= 1.0],
    };
    (space.names().into_iter().enumerate().map(section).collect(), best)
}

/// Returns the coordinates at which a section is evaluated, in ascending order and within the bounds.
fn places(share: f64) -> Vec<f64> {
    let mut places = vec![share];
    places.extend(
        DISTANCES.iter().flat_map(|distance| [(share - distance).max(0.0), (share + distance).min(1.0)]),
    );
    places.sort_by(f64::total_cmp);
    places.dedup();
    places
}
