//! Reduction of long series to the points that are visible in a picture.

use std::collections::{HashMap, HashSet};

/// Point in the picture, px.
pub(crate) type Point = (f64, f64);

/// Width of a column, px. Inside a column only the outermost points are kept.
const COLUMN: f64 = 0.5;
/// Polylines with more points than this are searched for repeated pieces.
const LONG: usize = 20_000;
/// Tolerance of the simplification, px: half a unit of the drawing coordinates.
const STRAIGHT: f64 = 1.0 / 16.0;
/// Polylines with at most this many points are not simplified.
const FEW: usize = 64;
/// Number of points that are simplified at once, as the cost grows with its square.
const STRETCH: usize = 256;
/// Length of the most recent part of a curve that is not compared for retracing, px.
const RECENT: f64 = 10.0;

/// Converts a series of points with gaps (`None`) to polylines. Of consecutive points inside one column only the
/// first, the last and the four outermost are kept. A spike of a single sample is therefore drawn in full height.
pub(crate) fn thinned(points: impl Iterator<Item = Option<Point>>) -> Vec<Vec<Point>> {
    let mut lines = Vec::new();
    let mut line = Vec::new();
    let mut run: Option<Run> = None;
    for point in points {
        let Some(point) = point else {
            run.take().into_iter().for_each(|run| run.finish(&mut line));
            if !line.is_empty() {
                lines.push(std::mem::take(&mut line));
            }
            continue;
        };
        match &mut run {
            Some(run) if run.column == column(point) => run.include(point),
            _ => {
                run.take().into_iter().for_each(|run| run.finish(&mut line));
                run = Some(Run::new(point));
            }
        }
    }
    run.into_iter().for_each(|run| run.finish(&mut line));
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Simplifies polylines with a tolerance of 1/16 px (Douglas and Peucker, Cartographica 10 (1973) 112, in sections).
/// Fewer corners make drawing faster and files smaller. Short polylines are unchanged.
pub(crate) fn straightened(lines: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let straighter = |line: Vec<Point>| if line.len() > FEW { straightened_line(line) } else { line };
    lines.into_iter().map(straighter).collect()
}

fn straightened_line(line: Vec<Point>) -> Vec<Point> {
    if line.len() < 3 {
        return line;
    }
    let mut kept = vec![line[0]];
    let mut open = Vec::new();
    for start in (0..line.len() - 1).step_by(STRETCH) {
        open.push((start, (start + STRETCH).min(line.len() - 1)));
        while let Some((from, to)) = open.pop() {
            let piece = (line[from], line[to]);
            let between = (from + 1..to).map(|i| (i, square_distance(line[i], piece)));
            let farthest = between.reduce(|far, other| if other.1 > far.1 { other } else { far });
            match farthest {
                Some((i, far)) if far > STRAIGHT * STRAIGHT => open.extend([(i, to), (from, i)]),
                _ => kept.push(line[to]),
            }
        }
    }
    kept
}

/// Returns the squared distance of a point from a line segment, px².
fn square_distance((x, y): Point, ((x0, y0), (x1, y1)): (Point, Point)) -> f64 {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = dx * dx + dy * dy;
    let share = if length > 0.0 { (((x - x0) * dx + (y - y0) * dy) / length).clamp(0.0, 1.0) } else { 0.0 };
    let (away_x, away_y) = (x - x0 - share * dx, y - y0 - share * dy);
    away_x * away_x + away_y * away_y
}

/// Drops segments that repeat earlier segments within a quarter of a pixel, as in cycles of a closed loop. Short polylines are unchanged.
pub(crate) fn without_repeats(lines: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    if lines.iter().map(Vec::len).sum::<usize>() <= LONG {
        return lines;
    }
    let spot = |(x, y): Point| ((x * 4.0).round() as i64, (y * 4.0).round() as i64);
    let mut seen = HashSet::new();
    let mut kept = Vec::new();
    for line in lines {
        let Some(&start) = line.first() else { continue };
        let mut piece = vec![start];
        for pair in line.windows(2) {
            if seen.insert((spot(pair[0]), spot(pair[1]))) {
                piece.push(pair[1]);
                continue;
            }
            if piece.len() > 1 {
                kept.push(std::mem::take(&mut piece));
            }
            piece.clear();
            piece.push(pair[1]);
        }
        if piece.len() > 1 || line.len() == 1 {
            kept.push(piece);
        }
    }
    kept
}

/// Returns the parts of polylines that do not retrace the same curve within about a pixel. Otherwise dashes of a second cycle would fill
/// the gaps of the first.
pub(crate) fn without_retraced(lines: &[Vec<Point>]) -> Vec<Vec<Point>> {
    let mut trail: HashMap<(i64, i64), f64> = HashMap::new();
    let mut gone = 0.0;
    let mut kept = Vec::new();
    for line in lines {
        let mut piece: Vec<Point> = line.first().copied().into_iter().collect();
        for pair in line.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let way = math::hypot(to.0 - from.0, to.1 - from.1);
            let steps = way.ceil().max(1.0);
            for k in 1..=steps as usize {
                let share = k as f64 / steps;
                let at = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
                gone += way / steps;
                if retraced(&trail, at, gone) {
                    if piece.len() > 1 {
                        kept.push(std::mem::take(&mut piece));
                    }
                    piece.clear();
                } else {
                    trail.entry(cell(at)).or_insert(gone);
                }
                // Steps along one segment add no corners. After a retraced step a new piece begins.
                if piece.is_empty() || k as f64 == steps {
                    piece.push(at);
                }
            }
        }
        if piece.len() > 1 || line.len() == 1 {
            kept.push(piece);
        }
    }
    kept
}

/// Returns whether the curve passed this cell or a neighbour before its last [`RECENT`] px.
fn retraced(trail: &HashMap<(i64, i64), f64>, at: Point, gone: f64) -> bool {
    let (x, y) = cell(at);
    let near = |dx: i64, dy: i64| trail.get(&(x + dx, y + dy)).is_some_and(|before| gone - before > RECENT);
    (-1..=1).any(|dx| (-1..=1).any(|dy| near(dx, dy)))
}

fn cell((x, y): Point) -> (i64, i64) {
    (x.floor() as i64, y.floor() as i64)
}

/// Returns the total length of polylines, px.
pub(crate) fn length(lines: &[Vec<Point>]) -> f64 {
    let way = |pair: &[Point]| math::hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
    lines.iter().flat_map(|line| line.windows(2)).map(way).sum()
}

fn column((x, _): Point) -> i64 {
    (x / COLUMN).floor() as i64
}

/// Consecutive points in one column, reduced to six, each with its rank in the drawing order.
struct Run {
    column: i64,
    count: usize,
    first: Point,
    last: Point,
    outermost: [(usize, Point); 4],
}

impl Run {
    fn new(point: Point) -> Self {
        Self { column: column(point), count: 1, first: point, last: point, outermost: [(0, point); 4] }
    }

    fn include(&mut self, point: Point) {
        let place = self.count;
        self.count += 1;
        self.last = point;
        let [left, right, top, bottom] = &mut self.outermost;
        let replace = |slot: &mut (usize, Point), further: bool| {
            if further {
                *slot = (place, point);
            }
        };
        replace(left, point.0 < left.1.0);
        replace(right, point.0 > right.1.0);
        replace(top, point.1 < top.1.1);
        replace(bottom, point.1 > bottom.1.1);
    }

    fn finish(self, line: &mut Vec<Point>) {
        let mut points = [(0, self.first); 6];
        points[1..5].copy_from_slice(&self.outermost);
        points[5] = (self.count - 1, self.last);
        points.sort_by_key(|&(place, _)| place);
        let mut before = None;
        for (place, point) in points {
            if before != Some(place) {
                line.push(point);
            }
            before = Some(place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn extremes(points: impl Iterator<Item = Point>) -> [f64; 4] {
        points.fold(
            [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY],
            |[a, b, c, d], (x, y)| [a.min(x), b.max(x), c.min(y), d.max(y)],
        )
    }

    #[test]
    fn a_million_points_become_thousands_and_keep_a_single_spike() {
        let n = 1_000_000;
        let points: Vec<Point> = (0..n)
            .map(|i| {
                (1000.0 * f64::from(i) / f64::from(n), if i == 654_321 { -300.0 } else { f64::from(i % 7) })
            })
            .collect();
        let lines = thinned(points.iter().copied().map(Some));
        assert_eq!(lines.len(), 1);
        assert!(lines[0].len() <= 6 * 2000 + 6, "{}", lines[0].len());
        assert!(lines[0].contains(&points[654_321]));
        assert_eq!(lines[0].first(), points.first());
        assert_eq!(lines[0].last(), points.last());
    }

    #[test]
    fn gaps_stay_gaps() {
        let lines =
            thinned([Some((0.0, 0.0)), None, None, Some((5.0, 1.0)), Some((9.0, 1.0)), None].into_iter());
        assert_eq!(lines, [vec![(0.0, 0.0)], vec![(5.0, 1.0), (9.0, 1.0)]]);
    }

    #[test]
    fn repeated_cycles_are_drawn_once() {
        let circle = |i: usize| {
            let angle = std::f64::consts::TAU * (i % 400) as f64 / 400.0;
            (500.0 + 300.0 * angle.cos(), 400.0 + 300.0 * angle.sin())
        };
        let lines = thinned((0..400_000).map(|i| Some(circle(i))));
        assert!(lines[0].len() > 300_000);
        let kept = without_repeats(lines);
        assert!(kept.iter().map(Vec::len).sum::<usize>() < 1300);
        let (all, drawn) = (extremes((0..400).map(circle)), extremes(kept.into_iter().flatten()));
        assert_eq!(all, drawn);
    }

    #[test]
    fn a_second_cycle_is_not_traced_again() {
        // Circles with different sampling in each round: one circumference 2π·300 px remains.
        let circle = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 399.3;
            (500.0 + 300.0 * angle.cos(), 400.0 + 300.0 * angle.sin())
        };
        let once = without_retraced(&thinned((0..2000).map(|i| Some(circle(i)))));
        let expected = std::f64::consts::TAU * 300.0;
        assert!((length(&once) / expected - 1.0).abs() < 0.02, "{} of {expected}", length(&once));
        // A curve that does not retrace itself keeps its length.
        let spiral = |i: usize| {
            (
                500.0 + 0.02 * i as f64 * (0.01 * i as f64).cos(),
                400.0 + 0.02 * i as f64 * (0.01 * i as f64).sin(),
            )
        };
        let lines = thinned((0..10_000).map(|i| Some(spiral(i))));
        assert!((length(&without_retraced(&lines)) / length(&lines) - 1.0).abs() < 0.02);
    }

    #[test]
    fn a_smooth_curve_needs_few_corners() {
        // For a circle of radius r, a chord of √(8rs) = 22.4 px has the sagitta s: at least 281 corners.
        let radius = 1000.0;
        let circle: Vec<Point> = (0..=10_000)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 1e4)
            .map(|a| (radius * a.cos(), radius * a.sin()))
            .collect();
        let line = straightened_line(circle);
        assert!((280..800).contains(&line.len()), "{}", line.len());
        // A line that goes back and forth keeps the turns beyond its ends.
        let turning = vec![(0.0, 0.0), (1.0, 0.0), (5.0, 0.0), (2.0, 0.0), (-2.0, 0.0), (3.0, 0.0)];
        let turns = straightened_line(turning);
        assert_eq!(turns, [(0.0, 0.0), (5.0, 0.0), (-2.0, 0.0), (3.0, 0.0)]);
    }

    proptest! {
        /// Every point left out is within the tolerance of the segment between the kept points around it.
        #[test]
        fn straightened_lines_pass_all_their_points(
            steps in proptest::collection::vec((-2.0..2.0_f64, -0.3..0.3_f64), 1..900)
        ) {
            let mut at = (0.0, 0.0);
            let line: Vec<Point> = steps.into_iter().map(|(x, y)| { at = (at.0 + x, at.1 + y); at }).collect();
            let kept = straightened_line(line.clone());
            prop_assert_eq!((kept.first(), kept.last()), (line.first(), line.last()));
            let mut k = 0;
            for &point in &line {
                let next = kept.get(k + 1);
                let away = square_distance(point, (kept[k], *next.unwrap_or(&kept[k]))).sqrt();
                prop_assert!(away <= STRAIGHT + 1e-9);
                if next == Some(&point) {
                    k += 1;
                }
            }
            prop_assert_eq!(k + 1, kept.len());
        }

        #[test]
        fn extremes_of_every_stretch_stay(
            points in proptest::collection::vec(proptest::option::weighted(0.95, (0.0..40.0_f64, -50.0..50.0_f64)), 0..300)
        ) {
            // Between gaps no point is added, the order stays, and the bounding box is the same.
            let lines = thinned(points.iter().copied());
            let stretches: Vec<&[Option<Point>]> = points.split(Option::is_none).filter(|s| !s.is_empty()).collect();
            prop_assert_eq!(lines.len(), stretches.len());
            for (line, stretch) in lines.iter().zip(stretches) {
                let mut rest = stretch.iter().flatten();
                prop_assert!(line.iter().all(|p| rest.any(|q| q == p)));
                prop_assert_eq!(extremes(line.iter().copied()), extremes(stretch.iter().flatten().copied()));
            }
        }
    }
}
