//! Plot of velocity over displacement.

use super::{Kind, Sources, Undrawn};
use crate::look::{Pen, Picture};
use stickslip_drive::scene::{Axis, Freedom};
use stickslip_plot::{Coordinate, PhasePath, phase_figure};
use stickslip_run::Job;
use stickslip_run::Kept;
use stickslip_run::Periods;
use stickslip_run::Trail;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "velocity over displacement of each free coordinate; for a travelling body, the last period",
    needs,
    draw,
};

/// Minimum stroke of a body relative to the largest in a coordinate; smaller strokes are rounding errors.
const REST: f64 = 1e-9;

/// Coordinate of a body.
struct Mover<'a> {
    body: &'a str,
    axis: Axis,
    is_free: bool,
}

/// Draws all free coordinates; if there are none, all coordinates that move. For a travelling body only the last period is shown in all its
/// coordinates, with x counted from its start. Other bodies show the whole run.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let trails: Vec<(Mover<'_>, Trail)> = movers(job)
        .into_iter()
        .map(|mover| {
            let trail = trail(&mover, kept);
            (mover, trail)
        })
        .collect();
    let largest = |axis: Axis| {
        let strokes = trails.iter().filter(|(mover, _)| mover.axis == axis).map(|(_, trail)| trail.stroke());
        strokes.fold(0.0, f64::max)
    };
    // Small prescribed motions are not rounding errors.
    let is_prescribed = trails.iter().all(|(mover, _)| !mover.is_free);
    let rest = if is_prescribed { 0.0 } else { REST };
    let is_moving = |(mover, trail): &&(Mover<'_>, Trail)| trail.stroke() > rest * largest(mover.axis);
    let moving: Vec<&(Mover<'_>, Trail)> = trails.iter().filter(is_moving).collect();
    let waveform = job.scenario.figures.waveform.and_then(|place| job.scenario.scene.waveforms.get(place));
    let periods = waveform.and_then(|waveform| Periods::until(&waveform.part, kept.end()));
    let travels = |body: &str, periods: Periods| {
        let mut trails = moving.iter().filter(|(mover, _)| mover.body == body);
        trails.any(|(_, trail)| !trail.part(periods.last()).is_closed())
    };
    let shown = moving.iter().map(|(mover, trail)| match periods {
        Some(periods) if travels(mover.body, periods) => (
            mover.axis,
            format!("{}, period {}", mover.body, periods.count),
            last(mover.axis, trail, periods),
        ),
        _ => (mover.axis, mover.body.to_owned(), trail.clone()),
    });
    let shown: Vec<(Axis, String, Trail)> = shown.collect();
    let paths = shown.iter().map(|(axis, name, Trail { x, y, .. })| PhasePath {
        name,
        coordinate: beside(*axis),
        displacement: x,
        velocity: y,
    });
    let paths: Vec<PhasePath<'_>> = paths.collect();
    Ok(pen.draw(PlotName::Phase, phase_figure(job.title(), &paths))?)
}

fn trail(mover: &Mover<'_>, kept: &Kept) -> Trail {
    let [x, v] = quantities(mover.axis).map(|quantity| kept.series.column(mover.body, quantity).to_vec());
    Trail { t: kept.series.time().to_vec(), x, y: v }
}

/// Returns the columns that the plot requires.
fn needs(job: &Job) -> Vec<String> {
    let columns =
        |mover: Mover<'_>| quantities(mover.axis).map(|quantity| format!("{}.{quantity}", mover.body));
    movers(job).into_iter().flat_map(columns).collect()
}

/// Returns the columns of a coordinate and its rate.
fn quantities(axis: Axis) -> [&'static str; 2] {
    match axis {
        Axis::X => ["x_m", "vx_m_s"],
        Axis::Z => ["z_m", "vz_m_s"],
        Axis::Pitch => ["pitch_rad", "vpitch_rad_s"],
    }
}

/// Returns the coordinate of the plot; `None` for the position along the slide.
fn beside(axis: Axis) -> Option<Coordinate> {
    match axis {
        Axis::X => None,
        Axis::Z => Some(Coordinate::Height),
        Axis::Pitch => Some(Coordinate::Pitch),
    }
}

/// Number of interpolated points between two samples.
const BETWEEN: u32 = 4;
/// Minimum interval for interpolation, as a fraction of the mean interval.
const CLOSE: f64 = 0.05;
/// Number of samples above which nothing is interpolated.
const MANY: usize = 100_000;

/// Returns the last period of a path. If the body does not return to its start, x counts from the start of the period.
fn last(axis: Axis, whole: &Trail, periods: Periods) -> Trail {
    let last = whole.part(periods.last());
    smooth(&if axis == Axis::X && !last.is_closed() { last.counted_from_start() } else { last })
}

/// Interpolates positions and velocities by the cubic Hermite polynomials.
fn smooth(trail: &Trail) -> Trail {
    if trail.t.len() > MANY {
        return trail.clone();
    }
    let span = trail.t.last().unwrap_or(&0.0) - trail.t.first().unwrap_or(&0.0);
    // Very short intervals are not interpolated, as rounding errors would be visible.
    let least = CLOSE * span / trail.t.len() as f64;
    let mut fine = Trail::default();
    for i in 0..trail.t.len() {
        if i > 0 && trail.t[i] - trail.t[i - 1] > least {
            let h = trail.t[i] - trail.t[i - 1];
            let (from, rise) = (trail.x[i - 1], trail.x[i] - trail.x[i - 1]);
            // Excess of the end velocities over the mean velocity, as displacements.
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

/// Returns the free coordinates of all bodies; if there are none, all coordinates that are not fixed.
fn movers(job: &Job) -> Vec<Mover<'_>> {
    let of = |wanted: fn(&Freedom) -> bool| -> Vec<Mover<'_>> {
        let bodies = job.scenario.scene.bodies.iter();
        let moving = bodies.flat_map(|body| {
            let coordinates = body.part.coordinates().into_iter().filter(move |(_, c)| wanted(&c.freedom));
            coordinates.map(|(axis, c)| Mover { body: &body.name, axis, is_free: c.freedom == Freedom::Free })
        });
        moving.collect()
    };
    let free = of(|freedom| *freedom == Freedom::Free);
    if free.is_empty() { of(|freedom| *freedom != Freedom::Fixed) } else { free }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_motion_has_its_points_on_the_curve() {
        // The cubic Hermite polynomial is exact for x = t³ - 2t.
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
