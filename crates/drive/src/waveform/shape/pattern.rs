//! Pattern: runs of a periodic shape and rests, repeated.

use super::law::Carrier;
use super::{Shape, Way};
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::within;
use crate::waveform::{Timing, WaveformError};

/// Run or rest of a pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Section {
    /// Whole cycles of the shape.
    Run {
        /// Number of cycles, at least 1.
        cycles: u32,
        /// Cycles reversed in time: fast forward stroke, slow return. Values stay in the same range, unlike with a reversed sign.
        reversed: bool,
    },
    /// Rest at the initial value of a cycle.
    Rest {
        /// Duration, s, above 0.
        duration: f64,
    },
}

/// Largest number of cycles in all runs together, because each cycle stores its corners.
const MOST_CYCLES: f64 = 10_000.0;

impl Section {
    /// Returns the duration of the section, s, for a given period of the shape.
    fn time(self, period: f64) -> f64 {
        match self {
            Self::Run { cycles, .. } => f64::from(cycles) * period,
            Self::Rest { duration } => duration,
        }
    }
}

/// Returns the timing of the pattern. The period is the duration of all sections; the phase counts cycles of the shape.
pub(super) fn timing(parts: &[Section], given: &Timing) -> Timing {
    let period: f64 = parts.iter().map(|part| part.time(given.period)).sum();
    Timing { period, phase: given.phase * (given.period / period), ..*given }
}

/// Returns the pieces of all cycles of the pattern; a run of sines is one piece.
pub(super) fn course(carrier: &Shape, parts: &[Section], timing: &Timing) -> Result<Course, WaveformError> {
    timing.check_period()?;
    let cycle = carrier.course(&Timing::every(timing.period))?;
    if cycle.period != Some(timing.period) {
        return Err(WaveformError::Carrier);
    }
    check(parts, cycle.has_jumps)?;
    let (legs, sines) = match &cycle.chain {
        Chain::Corners(corners) if !matches!(carrier, Shape::Limited { .. } | Shape::Pattern { .. }) => {
            (corners.legs().collect(), None)
        }
        Chain::Sines(sines) => (Vec::new(), Some(Carrier { sines: sines.clone(), period: timing.period })),
        Chain::Corners(_) | Chain::Step(_) | Chain::Supplied(_) => {
            return Err(WaveformError::Carrier);
        }
    };
    let rest = match &sines {
        Some(carrier) => carrier.at(0.0, false).value,
        None => legs.first().map_or(0.0, |leg: &Leg| leg.values.0),
    };
    let mut all = Vec::new();
    let mut start = 0.0;
    for part in parts {
        match *part {
            Section::Rest { .. } => all.push(Leg::straight(start, (rest, rest))),
            Section::Run { reversed, .. } if sines.is_some() => {
                all.push(Leg { start, values: (rest, rest), way: Way::Sines { reversed } });
            }
            Section::Run { cycles, reversed } => {
                let legs = if reversed { mirrored(&legs, timing.period) } else { legs.clone() };
                for k in 0..cycles {
                    let from = start + f64::from(k) * timing.period;
                    all.extend(legs.iter().map(|leg| Leg { start: from + leg.start, ..*leg }));
                }
            }
        }
        start += part.time(timing.period);
    }
    let whole = self::timing(parts, timing);
    let corners = Corners::periodic(&all, &whole).carried_by(sines);
    Ok(Course { chain: Chain::Corners(corners), ends: None, period: Some(whole.period), ..cycle })
}

fn check(parts: &[Section], has_jumps: bool) -> Result<(), WaveformError> {
    let mut cycles = 0.0;
    for part in parts {
        match *part {
            Section::Rest { duration } => within("dwell", duration, "a finite time above 0", duration > 0.0)?,
            Section::Run { cycles: count, reversed } => {
                cycles += f64::from(count);
                let wanted = "1 to 10000 cycles in all runs together";
                within("cycles", cycles, wanted, count > 0 && cycles <= MOST_CYCLES)?;
                if reversed && has_jumps {
                    // Two jumps at the same time would cancel.
                    return Err(WaveformError::Reversed);
                }
            }
        }
    }
    if cycles > 0.0 { Ok(()) } else { Err(WaveformError::Empty { key: "sequence" }) }
}

/// Returns one cycle reversed in time.
fn mirrored(legs: &[Leg], period: f64) -> Vec<Leg> {
    let ends = legs.iter().skip(1).map(|leg| leg.start).chain([period]);
    let mirror = |(leg, end): (&Leg, f64)| Leg {
        start: period - end,
        values: (leg.values.1, leg.values.0),
        way: leg.way.reversed(),
    };
    let mut back: Vec<Leg> = legs.iter().zip(ends).map(mirror).collect();
    back.reverse();
    back
}
