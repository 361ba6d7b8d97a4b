//! Velocity over displacement.

use crate::job::Job;
use crate::kept::Kept;
use crate::look::{Pen, Picture};
use crate::periods::Periods;
use crate::trail::Trail;
use stickslip_drive::scene::Freedom;
use stickslip_plot::{PhasePath, PlotError, phase_figure};
use stickslip_scenario::PlotName;

/// A body whose stroke is a smaller share of the largest one is at rest: what moves it is rounding.
const REST: f64 = 1e-9;

/// The free bodies, or else all that move. A body that comes back to its start in the last period is shown all the way;
/// of one that travels on that period alone, counted from its start, as in the picture of loops.
pub(super) fn draw(job: &Job, kept: &Kept, pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let waveform = job.scenario.figures.waveform.and_then(|place| job.scenario.scene.waveforms.get(place));
    let periods = waveform.and_then(|waveform| Periods::until(&waveform.part, kept.end()));
    let trails: Vec<(&str, Trail)> = bodies(job).into_iter().map(|name| (name, trail(name, kept))).collect();
    let largest = trails.iter().map(|(_, trail)| trail.stroke()).fold(0.0, f64::max);
    let moving = trails.into_iter().filter(|(_, trail)| trail.stroke() > REST * largest);
    let shown: Vec<(String, Trail)> = moving.map(|(name, trail)| shown(name, trail, periods)).collect();
    let paths =
        shown.iter().map(|(name, Trail { x, y, .. })| PhasePath { name, displacement: x, velocity: y });
    let paths: Vec<PhasePath<'_>> = paths.collect();
    pen.draw(PlotName::Phase, phase_figure(job.title(), &paths))
}

fn trail(body: &str, kept: &Kept) -> Trail {
    let [x, v] = ["x_m", "vx_m_s"].map(|quantity| kept.series.column(body, quantity).to_vec());
    Trail { t: kept.series.time().to_vec(), x, y: v }
}

/// Points between two samples of a smooth curve.
const BETWEEN: u32 = 4;
/// Samples closer than this share of the mean interval are as good as one.
const CLOSE: f64 = 0.05;
/// Samples from which on there are enough of them.
const MANY: usize = 100_000;

/// What is shown of a body, and under what name.
fn shown(body: &str, whole: Trail, periods: Option<Periods>) -> (String, Trail) {
    if let Some(periods) = periods {
        let last = whole.part(periods.last());
        if !last.is_closed() {
            return (format!("{body}, period {}", periods.count), smooth(&last.counted_from_start()));
        }
    }
    (body.to_owned(), whole)
}

/// A trail of positions and velocities with points between its samples, on the cubics through both.
fn smooth(trail: &Trail) -> Trail {
    if trail.t.len() > MANY {
        return trail.clone();
    }
    let span = trail.t.last().unwrap_or(&0.0) - trail.t.first().unwrap_or(&0.0);
    // Samples much closer than the others need no points between; divided by next to nothing, rounding would show.
    let least = CLOSE * span / trail.t.len() as f64;
    let mut fine = Trail::default();
    for i in 0..trail.t.len() {
        if i > 0 && trail.t[i] - trail.t[i - 1] > least {
            let h = trail.t[i] - trail.t[i - 1];
            let (from, rise) = (trail.x[i - 1], trail.x[i] - trail.x[i - 1]);
            // Excess of the velocities at both ends over the mean one, as ways.
            let (a, b) = (h * trail.y[i - 1] - rise, h * trail.y[i] - rise);
            for k in 1..=BETWEEN {
                let s = f64::from(k) / f64::from(BETWEEN + 1);
                let r = 1.0 - s;
                let velocity = (rise + a * r * (r - 2.0 * s) + b * s * (s - 2.0 * r)) / h;
                fine.push(trail.t[i - 1] + s * h, from + s * rise + s * r * (r * a - s * b), velocity);
            }
        }
        fine.push(trail.t[i], trail.x[i], trail.y[i]);
    }
    fine
}

/// Names of the bodies that are shown.
pub(super) fn bodies(job: &Job) -> Vec<&str> {
    let free = job.scenario.scene.bodies.iter().filter(|body| body.part.x.freedom == Freedom::Free);
    let free: Vec<&str> = free.map(|body| body.name.as_str()).collect();
    if free.is_empty() { super::moving(job) } else { free }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_motion_has_its_points_on_the_curve() {
        // x = t³ - 2t has no error in the cubic of positions and velocities.
        let (x, v) = (|t: f64| t.powi(3) - 2.0 * t, |t: f64| 3.0 * t * t - 2.0);
        let t = [0.0, 0.5, 1.0, 1.0 + 1e-15, 1.7];
        let trail = Trail { t: t.to_vec(), x: t.map(x).to_vec(), y: t.map(v).to_vec() };
        let fine = smooth(&trail);
        assert_eq!(fine.t.len(), 5 + 3 * 4);
        for i in 0..fine.t.len() {
            assert!((fine.x[i] - x(fine.t[i])).abs() < 1e-14, "{i}: {}", fine.x[i]);
            assert!((fine.y[i] - v(fine.t[i])).abs() < 1e-13, "{i}: {}", fine.y[i]);
        }
    }
}
