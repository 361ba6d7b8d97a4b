//! Errors of frames relative to an accurate run.

use super::walk::Walk;
use super::{FramesScene, stopped, turn};
use crate::error::BenchError;
use crate::norm::{self, Norm};
use crate::samples::Samples;
use stickslip_drive::Stepper;
use stickslip_realtime::Plant;
use stickslip_run::Watcher;

/// Frame lengths, s. Each divides the longest one.
pub(super) const LENGTHS: [f64; 10] = [1e-6, 2e-6, 5e-6, 10e-6, 20e-6, 50e-6, 100e-6, 200e-6, 500e-6, 1e-3];
/// Longest frame, s.
const LONGEST: f64 = 1e-3;
/// Tolerance of the reference run.
pub(super) const EXACT: f64 = 1e-11;
/// Maximum change of an input in the longest frame, relative to half its range. Some changes are larger than the gross slip displacement.
const SHARE: f64 = 0.5;

/// Largest difference of any free coordinate at the sample times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Off {
    /// Difference in units of the smallest u_c of all contacts; not finite without contacts.
    pub(super) natural: f64,
    /// Difference relative to the stroke or the largest displacement.
    pub(super) stroke: f64,
}

/// Errors at one frame length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rung {
    /// Frame length, s.
    pub(super) length: f64,
    /// Number of steps per frame of `frames`.
    pub(super) steps: f64,
    /// Error of each stepper.
    pub(super) off: [Off; 2],
}

/// Change of the inputs while errors are measured.
#[derive(Clone, Copy)]
enum Feeding {
    /// Random change in every frame.
    EachFrame,
    /// Linear over each millisecond, so that the problem is the same for all frame lengths.
    Straight,
}

/// Returns positions at the sample times, computed by frames of a length.
fn places(
    scene: &FramesScene<'_>,
    stepper: Stepper,
    (length, frames, stride): (f64, u64, u64),
    feeding: Feeding,
    watcher: &dyn Watcher,
) -> Result<Samples, BenchError> {
    let mut drive = scene.drive(stepper, length)?;
    let channels = scene.outputs.len();
    let (mut samples, mut values) = (Samples::new(channels), vec![0.0; channels]);
    let mut walk = match feeding {
        Feeding::EachFrame => turn::walk(&scene.inputs),
        Feeding::Straight => Walk::new(&scene.inputs, SHARE),
    };
    let cell = (LONGEST / length).round() as u64;
    let (mut from, mut now) = (walk.values().to_vec(), walk.values().to_vec());
    for frame in 0..frames {
        if !watcher.goes_on() {
            return Err(BenchError::Interrupted(scene.job.name.clone()));
        }
        match feeding {
            Feeding::EachFrame => now.copy_from_slice(walk.values()),
            Feeding::Straight => {
                if frame.is_multiple_of(cell) {
                    from.copy_from_slice(walk.values());
                    walk.step();
                }
                let part = (frame % cell + 1) as f64 / cell as f64;
                // A held input jumps at the start of the millisecond.
                for ((now, held), (from, to)) in
                    now.iter_mut().zip(&scene.held).zip(from.iter().zip(walk.values()))
                {
                    *now = if *held { *from } else { from + part * (to - from) };
                }
            }
        }
        drive.frame(&now, &mut values).map_err(|error| stopped(scene.job, &error))?;
        if let Feeding::EachFrame = feeding {
            walk.step();
        }
        if (frame + 1).is_multiple_of(stride) {
            values.iter().for_each(|value| samples.push(*value));
        }
    }
    Ok(samples)
}

/// Returns the difference of two runs.
fn apart(scene: &FramesScene<'_>, samples: &Samples, exact: &Samples) -> Off {
    let model = &scene.job.model;
    let scales = (0..).map_while(|c| model.contact_natural(c)).map(|scale| scale.displacement);
    let natural = scales.reduce(f64::min).unwrap_or(f64::NAN);
    let (parts, figures) = (&scene.job.scenario.scene, scene.job.scenario.figures);
    let norm = Norm::new(parts, figures, norm::coordinates(parts), exact);
    norm.map_or(Off { natural: f64::NAN, stroke: f64::NAN }, |norm| {
        let stroke = norm.errors(samples, exact).trajectory;
        Off { natural: stroke * norm.length / natural, stroke }
    })
}

/// Returns the error of a stepper with inputs that change in each frame. The run lasts as long as the scenario's, but at most `most`
/// frames.
///
/// # Errors
/// A run that fails, or an interruption by the watcher.
pub(super) fn of(
    scene: &FramesScene<'_>,
    stepper: Stepper,
    (length, most): (f64, u64),
    watcher: &dyn Watcher,
) -> Result<Off, BenchError> {
    let frames = ((scene.job.scenario.plan.duration / length).round() as u64).clamp(1, most);
    let grid = (length, frames, frames.div_ceil(200));
    let exact = whole(scene, grid, Feeding::EachFrame, watcher)?;
    Ok(apart(scene, &places(scene, stepper, grid, Feeding::EachFrame, watcher)?, &exact))
}

/// Returns the reference run. Without inputs, the reference run is not divided into frames of this length.
fn whole(
    scene: &FramesScene<'_>,
    (length, frames, stride): (f64, u64, u64),
    feeding: Feeding,
    watcher: &dyn Watcher,
) -> Result<Samples, BenchError> {
    let stepper = Stepper::Event { tolerance: EXACT };
    let grid = match (scene.inputs.is_empty(), feeding) {
        (true, _) => (length * stride as f64, frames / stride, 1),
        (false, Feeding::EachFrame) => (length, frames, stride),
        // Inputs are linear over a millisecond, so frames of a millisecond are sufficient.
        (false, Feeding::Straight) => (LONGEST, frames / stride, 1),
    };
    places(scene, stepper, grid, feeding, watcher)
}

/// Returns the errors of both steppers at all frame lengths.
///
/// # Errors
/// A run that fails, or an interruption by the watcher.
pub(super) fn ladder(
    scene: &FramesScene<'_>,
    steppers: impl Fn(f64) -> [Stepper; 2],
    watcher: &dyn Watcher,
) -> Result<Vec<Rung>, BenchError> {
    let moments = ((scene.job.scenario.plan.duration.min(0.1) / LONGEST).round() as u64).max(1);
    let exact = whole(scene, (LONGEST, moments, 1), Feeding::Straight, watcher)?;
    let rung = |length: f64| {
        let stride = (LONGEST / length).round() as u64;
        let [frames, event] = steppers(length);
        let off = |stepper| {
            let grid = (length, moments * stride, stride);
            let found = places(scene, stepper, grid, Feeding::Straight, watcher)?;
            Ok::<Off, BenchError>(apart(scene, &found, &exact))
        };
        let steps = match frames {
            Stepper::Frames { length, accuracy } => scene.job.model.substeps(length, accuracy),
            _ => f64::NAN,
        };
        Ok(Rung { length, steps, off: [off(frames)?, off(event)?] })
    };
    LENGTHS.into_iter().map(rung).collect()
}

/// Returns the order of convergence: the least-squares slope of the errors in logarithmic coordinates. Returns `None` for fewer than two
/// different lengths with a finite error above 0.
pub(super) fn order(points: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let points: Vec<(f64, f64)> = points
        .filter(|(x, y)| *x > 0.0 && *y > 0.0 && y.is_finite())
        .map(|(x, y)| (math::ln(x), math::ln(y)))
        .collect();
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (sxy, sxx) = points.iter().fold((0.0, 0.0), |(sxy, sxx), point| {
        (sxy + (point.0 - x) * (point.1 - y), sxx + (point.0 - x).powi(2))
    });
    (points.len() > 1 && sxx > 1e-9).then(|| sxy / sxx)
}

#[cfg(test)]
mod tests {
    use super::order;

    #[test]
    fn the_order_of_a_power_is_its_exponent() {
        let points = |p: f64| [1e-6, 3e-6, 1e-5, 1e-3].map(|h: f64| (h, 7.0 * h.powf(p))).into_iter();
        assert!((order(points(2.0)).unwrap() - 2.0).abs() < 1e-9);
        assert!((order(points(4.0)).unwrap() - 4.0).abs() < 1e-9);
        assert_eq!(order([(1e-6, f64::NAN), (2e-6, 0.0), (1e-6, 1e-3), (1e-6, 2e-3)].into_iter()), None);
    }
}
