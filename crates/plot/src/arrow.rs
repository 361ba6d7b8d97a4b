//! Arrowheads on curves that show the direction of traversal.

use crate::PlotError;
use crate::paint::Painter;
use crate::theme::Stroke;
use crate::thin::Point;
use plotters_backend::DrawingBackend;

/// Length and half width of an arrowhead, in line widths.
const LENGTH: f64 = 5.5;
const HALF: f64 = 2.4;
/// Minimum length of a section with an arrowhead, in lengths of arrowheads.
const LEAST: f64 = 6.0;

impl<B: DrawingBackend> Painter<'_, B> {
    /// Draws one arrowhead on the longest section to the right and one on the longest section to the left.
    pub(crate) fn arrows(&mut self, lines: &[Vec<Point>], stroke: Stroke) -> Result<(), PlotError> {
        let head = LENGTH * stroke.width * self.sizes.scale;
        let ways = lines.iter().flat_map(|line| ways(line));
        let mut longest: [Option<&[Point]>; 2] = [None; 2];
        for way in ways {
            let slot = &mut longest[usize::from(way[way.len() - 1].0 < way[0].0)];
            if slot.is_none_or(|other| length(other) < length(way)) {
                *slot = Some(way);
            }
        }
        for way in longest.into_iter().flatten().filter(|way| length(way) > LEAST * head) {
            let middle = length(way) / 2.0;
            let [tail, tip] = [middle - head / 2.0, middle + head / 2.0].map(|gone| at(way, gone));
            let (dx, dy) = (tip.0 - tail.0, tip.1 - tail.1);
            let share = HALF / LENGTH * head / math::hypot(dx, dy).max(f64::MIN_POSITIVE);
            let corner = |sign: f64| (tail.0 - sign * share * dy, tail.1 + sign * share * dx);
            self.canvas.polygon(&[tip, corner(1.0), corner(-1.0)], stroke.colour)?;
        }
        Ok(())
    }
}

/// Splits a polyline where its horizontal direction changes.
fn ways(line: &[Point]) -> Vec<&[Point]> {
    let mut ways = Vec::new();
    let (mut start, mut sense) = (0, 0.0);
    for i in 1..line.len() {
        let step = line[i].0 - line[i - 1].0;
        if step * sense < 0.0 {
            ways.push(&line[start..i]);
            start = i - 1;
        }
        if step != 0.0 {
            sense = step;
        }
    }
    if line.len() > start + 1 {
        ways.push(&line[start..]);
    }
    ways
}

/// Returns the length of a polyline, px.
fn length(way: &[Point]) -> f64 {
    way.windows(2).map(|pair| math::hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1)).sum()
}

/// Returns the point at a distance `gone` along a polyline, px.
fn at(way: &[Point], gone: f64) -> Point {
    let mut left = gone;
    for pair in way.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let step = math::hypot(to.0 - from.0, to.1 - from.1);
        if step >= left && step > 0.0 {
            let share = left / step;
            return (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
        }
        left -= step;
    }
    way.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_parted_where_it_turns() {
        let line = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (5.0, 4.0), (1.0, 4.0), (1.0, 0.0), (2.0, 0.0)];
        let parts: Vec<(usize, f64)> = ways(&line).into_iter().map(|way| (way.len(), length(way))).collect();
        assert_eq!(parts, [(4, 9.0), (3, 8.0), (2, 1.0)]);
        assert_eq!([2.0, 5.0, 99.0].map(|gone| at(&line[..4], gone)), [(2.0, 0.0), (3.0, 2.0), (5.0, 4.0)]);
        assert!(ways(&line[..1]).is_empty());
    }
}
