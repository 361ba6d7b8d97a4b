//! Measurement of the frame time of a plant on this machine, before a real-time run.

use crate::pace::{self, Cycle, Pace, Stop, Timing};
use crate::plant::{Drive, Input, Output, Plant, Work};
use crate::system::now;
use stickslip_drive::Watcher;
use stickslip_drive::scene::{EngineChoice, Scene};
use stickslip_drive::{Model, Plan, State, Stepper};

/// Maximum duration of a measurement, ns.
const LONGEST: u64 = 500_000_000;
/// Numbers of springs per contact for which the frame time is measured.
const ROWS: [usize; 2] = [64, 256];
/// Number of repetitions for each number of springs. The smallest result is used, so that short disturbances have no effect.
const TURNS: usize = 3;
/// Minimum number of frames for a 99 % quantile.
const LEAST: u64 = 100;
/// Accuracy of the stepper `frames` for spring rows. This stepper replaces the event-driven one, whose number of events depends on the row.
const ACCURACY: f64 = 1e-3;

/// Execution times of frames without pacing.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Number of frames.
    pub frames: u64,
    /// Median execution time, ns.
    pub median: u64,
    /// 99 % quantile of the execution time, ns.
    pub most: u64,
    /// Maximum execution time, ns, without the first frame.
    pub worst: u64,
}

/// Cycle of a loop that computes a plant with constant inputs.
struct Steady<'a, P> {
    plant: &'a mut P,
    inputs: &'a [f64],
    outputs: Vec<f64>,
    end: u64,
    observer: &'a (dyn Watcher + Sync),
}

impl<P: Plant> Cycle for Steady<'_, P> {
    fn act(&mut self, _: u64) -> Result<Work, Stop> {
        if now() > self.end || !self.observer.goes_on() {
            return Err(Stop::Interrupted);
        }
        Ok(self.plant.frame(self.inputs, &mut self.outputs)?)
    }
}

/// Computes frames of a plant without waiting, until `frames` frames or the maximum duration are reached.
///
/// Returns `None` if no frame was completed, or if the observer ended the measurement.
pub fn probe<P: Plant>(
    plant: &mut P,
    inputs: &[f64],
    outputs: usize,
    frames: u64,
    observer: &(dyn Watcher + Sync),
) -> Option<Probe> {
    let pace = Pace { period: 1.0, overrun: None, spin: 0.0 };
    let mut cycle = Steady { plant, inputs, outputs: vec![0.0; outputs], end: u64::MAX, observer };
    // The first frame is not measured, because it starts the run with cold caches.
    pace::run(&pace, 1, &mut cycle, &mut Timing::new()).ok()?;
    // The time limit starts after the first frame, so that at least one frame is measured.
    cycle.end = now() + LONGEST;
    let mut timing = Timing::new();
    // If the loop ends early, the measurement of the completed frames is valid.
    let _ = pace::run(&pace, frames, &mut cycle, &mut timing);
    let execution = &timing.execution;
    (timing.frames() > 0 && observer.goes_on()).then(|| Probe {
        frames: timing.frames(),
        median: execution.quantile(0.5),
        most: execution.quantile(0.99),
        worst: execution.worst(),
    })
}

/// Execution times of frames with a row of springs in each contact.
#[derive(Debug, Clone, PartialEq)]
pub struct RowsProbe {
    /// Number of springs per contact, and 99 % quantile of the execution time of a frame, ns, for each measurement.
    pub measured: Vec<(usize, u64)>,
    /// Number of springs per contact for which the frame time equals the period, by linear extrapolation.
    ///
    /// `None` if the frame time does not increase with the number of springs, or exceeds the period for any number.
    pub fits: Option<u64>,
}

/// Measures the frame time of a model with spring rows of two sizes.
///
/// Returns `None` if the model has no contact, does not run with spring rows, or completes too few frames.
pub fn rows(
    scene: &Scene,
    plan: &Plan,
    period: f64,
    (inputs, outputs): (&[Input], &[Output]),
    frames: u64,
    observer: &(dyn Watcher + Sync),
) -> Option<RowsProbe> {
    if scene.contacts.is_empty() {
        return None;
    }
    let initial: Vec<f64> = inputs.iter().map(|input| input.initial).collect();
    let stepper = match plan.stepper {
        Stepper::Event { .. } => Stepper::Frames { length: period, accuracy: ACCURACY },
        own => own,
    };
    let plan = &Plan { stepper, ..*plan };
    let measure = |count: usize| {
        let mut scene = scene.clone();
        scene
            .contacts
            .iter_mut()
            .for_each(|contact| contact.part.engine = EngineChoice::Springs { count, span: None });
        let model = Model::new(&scene).ok()?;
        let state: State = model.start(plan).ok()?;
        let mut drive =
            Drive::new(&model, plan, (state, 0), period, (inputs, outputs)).ok()?.heeding(observer);
        let probe = probe(&mut drive, &initial, outputs.len(), frames, observer)?;
        (probe.frames >= LEAST).then_some((count, probe.most))
    };
    let mut measured = ROWS.map(|count| (count, u64::MAX)).to_vec();
    for _ in 0..TURNS {
        for row in &mut measured {
            row.1 = row.1.min(measure(row.0)?.1);
        }
    }
    let fits = line(&measured, 1e9 * period);
    Some(RowsProbe { measured, fits })
}

/// Returns the position at which the line through two points has the value `value`. Returns `None` if the position is below 1.
fn line(points: &[(usize, u64)], value: f64) -> Option<u64> {
    let [(n, a), (m, b)] = points[..] else { return None };
    let slope = (b as f64 - a as f64) / (m as f64 - n as f64);
    let place = n as f64 + (value - a as f64) / slope;
    (slope > 0.0 && place >= 1.0).then_some(place as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plant whose frames exceed the duration of the measurement.
    struct Long;

    impl Plant for Long {
        fn frame(&mut self, _: &[f64], _: &mut [f64]) -> Result<Work, crate::plant::PlantError> {
            crate::system::sleep_until(now() + LONGEST + 50_000_000);
            Ok(Work::default())
        }
    }

    #[test]
    fn of_frames_longer_than_the_measurement_one_is_measured() {
        let probe = probe(&mut Long, &[], 0, 500, &()).unwrap();
        assert!(probe.frames == 1 && probe.median > LONGEST, "{probe:?}");
    }

    #[test]
    fn a_line_is_continued_to_the_period() {
        assert_eq!(line(&[(64, 7_400), (256, 26_600)], 51_000.0), Some(500));
        assert_eq!(line(&[(64, 7_400), (256, 26_600)], 500.0), None);
        assert_eq!(line(&[(64, 7_400), (256, 7_400)], 51_000.0), None);
    }
}
