//! Contour lines on a grid by marching squares.

use std::collections::BTreeMap;

/// Grid edge from the point (i, j) to the next point in x (third number 0) or in y (third number 1).
pub(super) type Edge = (usize, usize, u8);

/// Returns the lines that separate inside from outside points, as lists of crossed edges. The last edge of a closed line is its first one.
///
/// Cells with an unknown corner have no lines. In a saddle cell, the lower left corner is separated from the others.
pub(super) fn lines(
    [columns, rows]: [usize; 2],
    inside: &dyn Fn(usize, usize) -> Option<bool>,
) -> Vec<Vec<Edge>> {
    let mut next: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for (i, j) in (1..columns).flat_map(|i| (1..rows).map(move |j| (i - 1, j - 1))) {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| inside(i, j));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
        let around = [(a, d, (i, j, 1)), (a, b, (i, j, 0)), (b, c, (i + 1, j, 1)), (c, d, (i, j + 1, 0))];
        let crossed: Vec<Edge> =
            around.iter().filter(|(from, to, _)| from != to).map(|(.., edge)| *edge).collect();
        for pair in crossed.chunks_exact(2) {
            next.entry(pair[0]).or_default().push(pair[1]);
            next.entry(pair[1]).or_default().push(pair[0]);
        }
    }
    let mut lines = Vec::new();
    // Open lines are followed first, then closed lines.
    for is_open in [true, false] {
        let starts: Vec<Edge> = next.keys().copied().collect();
        for start in starts {
            let degree = next.get(&start).map_or(0, Vec::len);
            if degree == 0 || is_open && degree != 1 {
                continue;
            }
            lines.push(follow(&mut next, start));
        }
    }
    lines
}

/// Returns the line that starts at an edge, and removes the links of this line from `next`.
fn follow(next: &mut BTreeMap<Edge, Vec<Edge>>, start: Edge) -> Vec<Edge> {
    let mut line = vec![start];
    let mut here = start;
    while let Some(to) = next.get_mut(&here).and_then(Vec::pop) {
        if let Some(back) = next.get_mut(&to)
            && let Some(place) = back.iter().position(|edge| *edge == here)
        {
            back.swap_remove(place);
        }
        line.push(to);
        here = to;
    }
    line
}

/// Returns the contour lines of values (column by column) at a level, as fractions of the axes, by linear interpolation.
pub(super) fn contour(values: &[f64], points: [usize; 2], level: f64) -> Vec<Vec<[f64; 2]>> {
    let [columns, rows] = points;
    let value = |i: usize, j: usize| values.get(i * rows + j).copied().filter(|value| value.is_finite());
    let inside = |i: usize, j: usize| value(i, j).map(|value| value > level);
    let place = |(i, j, way): Edge| {
        let (k, l) = if way == 0 { (i + 1, j) } else { (i, j + 1) };
        let [from, to] = [value(i, j), value(k, l)].map(|value| value.unwrap_or(level));
        let part = if from == to { 0.5 } else { (level - from) / (to - from) };
        let (x, y) = if way == 0 { (i as f64 + part, j as f64) } else { (i as f64, j as f64 + part) };
        [x / (columns - 1) as f64, y / (rows - 1) as f64]
    };
    lines(points, &inside).into_iter().map(|line| line.into_iter().map(place).collect()).collect()
}

/// Returns approximately `about` contour levels between smallest and largest value: multiples of 1, 2 or 5 times a power of ten.
pub(super) fn levels(values: &[f64], about: f64) -> Vec<f64> {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let span = high - low;
    // A result that is constant except for rounding has no contour levels.
    if !(span > 1e-9 * low.abs().max(high.abs()) && span.is_finite()) {
        return Vec::new();
    }
    let decade = math::powf(10.0, math::log10(span / about).floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].into_iter().map(|digit| digit * decade).find(|step| span / step <= about);
    let step = step.unwrap_or(10.0 * decade);
    let (first, last) = ((low / step).floor() as i64 + 1, (high / step).ceil() as i64 - 1);
    (first..=last).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_one_closed_line() {
        let n = 41;
        let at = |k: usize| 2.0 * k as f64 / (n - 1) as f64 - 1.0;
        let values: Vec<f64> = (0..n * n).map(|k| at(k / n).powi(2) + at(k % n).powi(2)).collect();
        let lines = contour(&values, [n, n], 0.25);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        let radius = |p: &[f64; 2]| ((2.0 * p[0] - 1.0).powi(2) + (2.0 * p[1] - 1.0).powi(2)).sqrt();
        assert!(lines[0].len() > 40 && lines[0].iter().all(|p| (radius(p) - 0.5).abs() < 2e-3));
        // Half of the circle, with no values on the other side.
        let half: Vec<f64> =
            values.iter().enumerate().map(|(k, v)| if k / n < 20 { f64::NAN } else { *v }).collect();
        let lines = contour(&half, [n, n], 0.25);
        assert!(lines.len() == 1 && lines[0].first() != lines[0].last());
    }

    #[test]
    fn levels_are_round_and_inside() {
        assert_eq!(levels(&[0.0, 1.0], 7.0), [0.2, 0.4, 0.6000000000000001, 0.8]);
        assert_eq!(levels(&[3.0, f64::NAN, 3.0], 7.0), [0.0; 0]);
        assert_eq!(levels(&[-30.0, 22.0], 7.0), [-20.0, -10.0, 0.0, 10.0, 20.0]);
    }
}
