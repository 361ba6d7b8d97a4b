//! Random waveforms.

use super::draw::Draw;
use serde_json::{Value, json};

/// Number of points of a table.
const POINTS: u64 = 12;

/// Restriction of a waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Course {
    /// Any waveform, sometimes with jumps.
    Any,
    /// Waveform with bounded velocity, which a damper may follow.
    Continuous,
    /// Waveform that is never negative.
    Above,
}

/// Draws a waveform of a stroke, in the unit of the quantity that follows it, and a period, s. For [`Course::Above`], `mean` is the mean,
/// which is at least half the stroke.
pub(super) fn waveform(draw: &mut Draw, course: Course, stroke: f64, period: f64, mean: f64) -> Value {
    let kind = draw.below(6);
    if course == Course::Above {
        return above(draw, kind, stroke, period, mean);
    }
    let mut form = match kind {
        0 => {
            let jumps = course == Course::Any && draw.chance(0.06);
            let flyback = if jumps { 0.0 } else { draw.spread(0.01, 0.5) * period };
            return timed(
                draw,
                "sawtooth",
                json!({ "stroke": stroke, "period": period, "flyback": flyback }),
                period,
            );
        }
        1 => return timed(draw, "triangle", json!({ "stroke": stroke, "period": period }), period),
        2 => {
            let offset = if draw.chance(0.3) { draw.between(-stroke, stroke) } else { 0.0 };
            json!({ "amplitude": 0.5 * stroke, "period": period, "offset": offset })
        }
        3 => return harmonics(draw, stroke, period),
        4 => {
            let flyback = draw.between(0.1, 0.9) * period;
            return timed(
                draw,
                "cycloid",
                json!({ "stroke": stroke, "period": period, "flyback": flyback }),
                period,
            );
        }
        _ => return table(draw, (-0.5 * stroke, 0.5 * stroke), period),
    };
    if draw.chance(0.7) {
        form["phase"] = json!(draw.phase());
    }
    json!({ "sine": form })
}

/// Draws a waveform that is never negative.
fn above(draw: &mut Draw, kind: u64, stroke: f64, period: f64, mean: f64) -> Value {
    match kind {
        // These waveforms start at 0, where a contact loses its load.
        0 => timed(draw, "triangle", json!({ "stroke": stroke, "period": period }), period),
        1 => {
            let flyback = draw.between(0.05, 0.5) * period;
            timed(draw, "sawtooth", json!({ "stroke": stroke, "period": period, "flyback": flyback }), period)
        }
        2 => table(draw, (mean - 0.5 * stroke, mean + 0.5 * stroke), period),
        _ => {
            let phase = if draw.chance(0.7) { draw.phase() } else { 0.0 };
            json!({ "sine": { "amplitude": 0.5 * stroke, "offset": mean, "period": period, "phase": phase } })
        }
    }
}

fn harmonics(draw: &mut Draw, stroke: f64, period: f64) -> Value {
    let count = 2 + draw.below(3);
    let terms: Vec<Value> = (1..=count)
        .map(|order| {
            let amplitude = draw.between(0.2, 0.5) * stroke / order as f64;
            json!({ "amplitude": amplitude, "order": order, "phase": draw.phase() })
        })
        .collect();
    json!({ "harmonics": { "terms": terms, "period": period } })
}

/// Draws a table: linear between random points, over four periods.
fn table(draw: &mut Draw, (low, high): (f64, f64), period: f64) -> Value {
    let points: Vec<Value> = (0..=POINTS)
        .map(|i| json!([4.0 * period * i as f64 / POINTS as f64, draw.between(low, high)]))
        .collect();
    json!({ "table": { "points": points } })
}

/// Sometimes adds a phase, a delay or a number of cycles.
fn timed(draw: &mut Draw, kind: &str, mut form: Value, period: f64) -> Value {
    if draw.chance(0.4) {
        form["phase"] = json!(draw.phase());
    }
    if draw.chance(0.1) {
        form["delay"] = json!(draw.between(0.0, 0.7) * period);
    }
    if draw.chance(0.1) {
        form["cycles"] = json!(draw.between(0.5, 3.0));
    }
    json!({ kind: form })
}
