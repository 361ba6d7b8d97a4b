//! Shape-preserving cubics through points, once or repeated.
//!
//! Between two points the value stays between their values, and is monotonic where the points are. Rates at the points are weighted
//! harmonic means of the adjacent slopes (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 300, 1984). Rates at the ends are limited
//! three-point differences (Moler, Numerical Computing with MATLAB, 2004, section 3.6). Only the second derivative jumps at a point.

use super::cubic::Cubic;
use super::{Way, table};
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::smooth;
use crate::waveform::{Timing, WaveformError};

/// Returns the chain of pieces between points. Two points at one time are a jump.
pub(super) fn course(
    points: &[(f64, f64)],
    smoothed: bool,
    repeated: bool,
    timing: &Timing,
) -> Result<Course, WaveformError> {
    table::check(points, timing)?;
    let ends = [points.first(), points.last()].map(|end| end.copied().unwrap_or_default());
    let time = ends[1].0 - ends[0].0;
    if repeated && !(time > 0.0 && time.is_finite()) {
        return Err(WaveformError::Span { got: time });
    }
    let closed = repeated && ends[0].1 == ends[1].1;
    let rates = if smoothed { rates(points, closed) } else { Vec::new() };
    for rate in &rates {
        smooth("points", rate.0, rate.0 + rate.1)?;
    }
    let origin = if repeated { ends[0].0 } else { 0.0 };
    let mut legs = Vec::new();
    for (i, pair) in points.windows(2).enumerate() {
        if pair[0].0 < pair[1].0 {
            let rates = rates.get(i).copied();
            let way = rates.map_or(Way::Straight, |(first, last)| Way::Cubic(Cubic::new(first, last)));
            legs.push(Leg { start: pair[0].0 - origin, values: (pair[0].1, pair[1].1), way });
        }
    }
    let chain = if repeated {
        Chain::Corners(Corners::periodic(&legs, &self::timing(points, timing)))
    } else {
        match Corners::once(&legs, ends[1].0, timing.delay) {
            Some(corners) => Chain::Corners(corners),
            None => Chain::Step(timing.delay + ends[0].0),
        }
    };
    let inside = points.windows(2).any(|pair| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1);
    Ok(Course {
        chain,
        ends: (!repeated).then_some((ends[0].1, ends[1].1)),
        period: repeated.then_some(time),
        range: points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |range, point| {
            (range.0.min(point.1), range.1.max(point.1))
        }),
        wave: f64::INFINITY,
        has_jumps: inside || repeated && !closed,
    })
}

/// Returns the timing of repeated points: the period is their duration, and the waveform starts at the first point.
pub(super) fn timing(points: &[(f64, f64)], given: &Timing) -> Timing {
    let [first, last] = [points.first(), points.last()].map(|end| end.map_or(0.0, |point| point.0));
    Timing { period: last - first, delay: given.delay + first, ..*given }
}

/// Returns the rates at start and end of each segment, per s. A segment that is a jump gets zeros.
fn rates(points: &[(f64, f64)], closed: bool) -> Vec<(f64, f64)> {
    let mut rates = vec![(0.0, 0.0); points.len().saturating_sub(1)];
    let mut first = 0;
    let jumps = points.windows(2).enumerate().filter(|(_, pair)| pair[0].0 == pair[1].0).map(|(i, _)| i);
    let whole = !points.windows(2).any(|pair| pair[0].0 == pair[1].0);
    for last in jumps.chain([points.len().saturating_sub(1)]) {
        let run = &points[first..=last];
        let knots = of_run(run, closed && whole);
        for (rate, pair) in rates[first..].iter_mut().zip(knots.windows(2)) {
            *rate = (pair[0], pair[1]);
        }
        first = last + 1;
    }
    rates
}

/// Returns the rates at the points of a curve without jumps; with `closed`, the curve is periodic.
fn of_run(run: &[(f64, f64)], closed: bool) -> Vec<f64> {
    let ways: Vec<(f64, f64)> = run
        .windows(2)
        .map(|pair| {
            let time = pair[1].0 - pair[0].0;
            (time, (pair[1].1 - pair[0].1) / time)
        })
        .collect();
    let (Some(&head), Some(&tail)) = (ways.first(), ways.last()) else { return vec![0.0; run.len()] };
    let inner = ways.windows(2).map(|pair| between(pair[0], pair[1]));
    let (start, end) = match ways.len() {
        1 => (head.1, tail.1),
        _ if closed => (between(tail, head), between(tail, head)),
        n => (at_end(head, ways[1]), at_end(tail, ways[n - 2])),
    };
    [start].into_iter().chain(inner).chain([end]).collect()
}

/// Returns the rate at a point between two segments (duration, slope); 0 at an extreme.
fn between(left: (f64, f64), right: (f64, f64)) -> f64 {
    if left.1 * right.1 <= 0.0 {
        return 0.0;
    }
    let (first, last) = (2.0 * right.0 + left.0, right.0 + 2.0 * left.0);
    (first + last) / (first / left.1 + last / right.1)
}

/// Returns the rate at the free end of a segment. It has the sign of the segment's slope and is at most three times as large.
fn at_end(own: (f64, f64), other: (f64, f64)) -> f64 {
    let rate = ((2.0 * own.0 + other.0) * own.1 - own.0 * other.1) / (own.0 + other.0);
    if rate * own.1 <= 0.0 {
        0.0
    } else if own.1 * other.1 <= 0.0 && rate.abs() > 3.0 * own.1.abs() {
        3.0 * own.1
    } else {
        rate
    }
}
