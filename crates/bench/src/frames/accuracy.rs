//! How far frames are from the whole run.

use super::walk::Walk;
use super::{FramesScene, stopped, turn};
use crate::error::BenchError;
use crate::norm::{self, Norm};
use crate::samples::Samples;
use stickslip_drive::Stepper;
use stickslip_realtime::Plant;
use stickslip_run::Watcher;

/// Lengths of frames, s: each divides the longest.
pub(super) const LENGTHS: [f64; 10] = [1e-6, 2e-6, 5e-6, 10e-6, 20e-6, 50e-6, 100e-6, 200e-6, 500e-6, 1e-3];
/// The longest.
const LONGEST: f64 = 1e-3;
/// Tolerance of what they are held against.
pub(super) const EXACT: f64 = 1e-11;
/// Share of half its range by which an input goes in the longest frame, at most: some go beyond gross slip.
const SHARE: f64 = 0.5;

/// Largest difference of any free coordinate at common moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Off {
    /// In the smallest u_c of the scene's contacts; not finite where it has none.
    pub(super) natural: f64,
    /// In strokes, or largest travels.
    pub(super) stroke: f64,
}

/// Frames of one length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rung {
    /// Length of a frame, s.
    pub(super) length: f64,
    /// Steps of a frame by `frames`.
    pub(super) steps: f64,
    /// Error by each stepper.
    pub(super) off: [Off; 2],
}

/// How inputs go while errors are measured.
#[derive(Clone, Copy)]
enum Feeding {
    /// Another step in every frame.
    EachFrame,
    /// Straight from millisecond to millisecond, whatever the frame: all lengths then have one problem.
    Straight,
}

/// Places at common moments, by frames of a length.
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
                // A held input jumps where the millisecond begins, and stays.
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

/// Distances of two runs.
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

/// Errors of a stepper in frames of a length whose inputs change each frame, over the scenario's time but at most so many frames.
///
/// # Errors
/// What a run says, or the watcher's wish.
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

/// The run that frames are held against: where nothing is fed it is not cut into any.
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
        // Inputs go straight for a millisecond: so do the frames.
        (false, Feeding::Straight) => (LONGEST, frames / stride, 1),
    };
    places(scene, stepper, grid, feeding, watcher)
}

/// Errors of both steppers over lengths of frames.
///
/// # Errors
/// What a run says, or the watcher's wish.
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

/// Order of errors in lengths: the slope of least squares in the logarithms. None where there are not two different lengths with an error.
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
        // What is not there has no say, and one length has no slope.
        assert_eq!(order([(1e-6, f64::NAN), (2e-6, 0.0), (1e-6, 1e-3), (1e-6, 2e-3)].into_iter()), None);
    }
}
