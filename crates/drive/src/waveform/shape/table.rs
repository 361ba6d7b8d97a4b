//! Table: linear between points, constant before the first point and after the last.

use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth};
use crate::waveform::{Timing, WaveformError};

/// Returns the chain of linear pieces between points. Two points at one time are a jump.
pub(super) fn course(points: &[(f64, f64)], timing: &Timing) -> Result<Course, WaveformError> {
    check(points, timing)?;
    let ends = [points.first(), points.last()].map(|end| end.copied().unwrap_or_default());
    let rising = points.windows(2).filter(|pair| pair[0].0 < pair[1].0);
    let legs: Vec<Leg> = rising.map(|pair| Leg::straight(pair[0].0, (pair[0].1, pair[1].1))).collect();
    let chain = match Corners::once(&legs, ends[1].0, timing.delay) {
        Some(corners) => Chain::Corners(corners),
        None => Chain::Step(timing.delay + ends[0].0),
    };
    Ok(Course {
        chain,
        ends: Some((ends[0].1, ends[1].1)),
        period: None,
        range: points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |range, point| {
            (range.0.min(point.1), range.1.max(point.1))
        }),
        wave: f64::INFINITY,
        has_jumps: points.windows(2).any(|pair| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1),
    })
}

pub(super) fn check(points: &[(f64, f64)], timing: &Timing) -> Result<(), WaveformError> {
    timing.check_single()?;
    if points.is_empty() {
        return Err(WaveformError::Empty { key: "points" });
    }
    for (time, value) in points {
        finite("points", *time)?;
        finite("points", *value)?;
    }
    for (i, pair) in points.windows(2).enumerate() {
        let (before, got) = (pair[0].0, pair[1].0);
        let time = if got > before { got - before } else { 1.0 };
        smooth("points", pair[1].1, (pair[1].1 - pair[0].1) / time)?;
        // Compared after adding the delay, which may absorb a short interval.
        if got < before || got > before && timing.delay + got <= timing.delay + before {
            return Err(WaveformError::Times { place: i + 1, before, got });
        }
    }
    match points.windows(3).position(|three| three[0].0 == three[2].0) {
        Some(i) => Err(WaveformError::Crowd { place: i + 2, time: points[i].0 }),
        None => Ok(()),
    }
}
