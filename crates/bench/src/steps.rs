//! Tolerances and steps of the methods, from coarse to fine.

use stickslip_drive::Scene;

/// Number of fixed steps, each half the previous one.
const LEVELS: i32 = 16;
/// Maximum number of corners considered per waveform.
const CORNERS: usize = 200;
/// Time differences below this fraction of the run are rounding errors.
const ROUNDING: f64 = 1e-10;

/// Returns the tolerances 1e-1 to 1e-12.
pub(crate) fn tolerances() -> Vec<f64> {
    (1..=12).map(|exponent| 10_f64.powi(-exponent)).collect()
}

/// Returns fixed steps from at most half of `longest`, s, each half the previous one. If the corners of the waveforms have a common
/// divisor, all corners lie on steps. A step across a corner would lower the order of convergence.
pub(crate) fn fixed(scene: &Scene, duration: f64, longest: f64) -> Vec<f64> {
    let measure = common_measure(scene, duration, longest);
    let first = (measure / (0.5 * longest).min(measure)).ceil();
    (0..LEVELS).map(|level| measure / (first * 2_f64.powi(level))).collect()
}

/// Returns the longest time step, s, that divides the times of all corners and the end, or the whole run if that step is too short.
fn common_measure(scene: &Scene, duration: f64, longest: f64) -> f64 {
    let mut measure = duration;
    for waveform in &scene.waveforms {
        let mut piece = waveform.part.piece_at(0.0);
        for _ in 0..CORNERS {
            if piece.end >= duration {
                break;
            }
            measure = divisor(measure, piece.end, ROUNDING * duration);
            // Removes the rounding error of the remainder, which would grow.
            measure = duration / (duration / measure).round();
            piece = waveform.part.after(&piece);
        }
    }
    if measure < 1e-3 * longest.min(duration) { duration } else { measure }
}

/// Returns the greatest common divisor by Euclid's algorithm; remainders below `rounding` count as 0.
fn divisor(a: f64, b: f64, rounding: f64) -> f64 {
    let (mut a, mut b) = (a, b);
    while b > rounding {
        let rest = a % b;
        (a, b) = (b, if b - rest < rounding { 0.0 } else { rest });
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::scene::Named;
    use stickslip_drive::{Shape, Timing, Waveform};

    fn scene(flyback: f64, period: f64) -> Scene {
        let shape = Shape::Sawtooth { stroke: 1e-6, flyback };
        let part = Waveform::new(shape, Timing::every(period)).unwrap();
        Scene { waveforms: vec![Named { name: "drive".into(), part }], ..Scene::default() }
    }

    #[test]
    fn corners_fall_on_steps() {
        let steps = fixed(&scene(0.1e-3, 1e-3), 20e-3, 150e-6);
        assert!((steps[0] - 50e-6).abs() < 1e-15 && (steps[1] - 25e-6).abs() < 1e-15, "{steps:?}");
        let steps = fixed(&scene(10e-6, 10e-3), 0.12, 90e-6);
        assert!((steps[0] - 10e-6).abs() < 1e-15, "{steps:?}");
    }

    #[test]
    fn corners_without_a_common_measure_are_left_to_chance() {
        let steps = fixed(&scene(0.1e-3 / 2_f64.sqrt(), 1e-3), 20e-3, 150e-6);
        assert!(steps[0] > 70e-6 && (20e-3 / steps[0]).fract() < 1e-9, "{steps:?}");
    }
}
