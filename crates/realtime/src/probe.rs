//! What a plant takes on this machine, before anything depends on it.

use crate::pace::{self, Cycle, Pace, Stop, Timing};
use crate::plant::{Drive, Input, Output, Plant, Work};
use crate::system::now;
use stickslip_drive::Watcher;
use stickslip_drive::scene::{EngineChoice, Scene};
use stickslip_drive::{Model, Plan, State, Stepper};

/// Longest that a measurement takes, ns.
const LONGEST: u64 = 500_000_000;
/// Numbers of springs of the rows that are measured.
const ROWS: [usize; 2] = [64, 256];
/// How often each row is measured, in turn: what disturbs one of them for a moment counts for neither.
const TURNS: usize = 3;
/// Fewer frames say nothing of what 99 % of them keep.
const LEAST: u64 = 100;
/// What frames of an event stepper are replaced by, on rows: how many events come is another thing on each row.
const ACCURACY: f64 = 1e-3;

/// What frames took that nothing paced.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// How many.
    pub frames: u64,
    /// The shortest time, ns, that half of them kept.
    pub median: u64,
    /// That 99 % of them kept.
    pub most: u64,
    /// The longest, ns; the first frame, which makes itself at home, is not counted.
    pub worst: u64,
}

/// The same inputs all the time.
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

/// Computes frames of a plant without waiting, until there are so many or it took long; none where not even one came, or the observer
/// ended it.
pub fn probe<P: Plant>(
    plant: &mut P,
    inputs: &[f64],
    outputs: usize,
    frames: u64,
    observer: &(dyn Watcher + Sync),
) -> Option<Probe> {
    let pace = Pace { period: 1.0, overrun: None, spin: 0.0 };
    let mut cycle = Steady { plant, inputs, outputs: vec![0.0; outputs], end: u64::MAX, observer };
    // The first frame opens the run, and finds all its memory cold.
    pace::run(&pace, 1, &mut cycle, &mut Timing::new()).ok()?;
    // However long that took: of frames that are longer than any measurement one is measured all the same.
    cycle.end = now() + LONGEST;
    let mut timing = Timing::new();
    // Whatever ends it, what was measured is measured.
    let _ = pace::run(&pace, frames, &mut cycle, &mut timing);
    let execution = &timing.execution;
    (timing.frames() > 0 && observer.goes_on()).then(|| Probe {
        frames: timing.frames(),
        median: execution.quantile(0.5),
        most: execution.quantile(0.99),
        worst: execution.worst(),
    })
}

/// How long frames take with rows of springs in the place of every contact's own engine.
#[derive(Debug, Clone, PartialEq)]
pub struct RowsProbe {
    /// Springs of each row, and the time, ns, that 99 % of the frames kept.
    pub measured: Vec<(usize, u64)>,
    /// The number for which a straight line through these comes to the period; none where it does not grow, or is beyond the
    /// period before the first spring.
    pub fits: Option<u64>,
}

/// Measures a scene on rows of two sizes, each the quietest of three turns, by steps whose number is known before; none where it has no
/// contact, does not run on rows, or comes to too few frames.
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

/// Where a straight line through two points comes to a value, if it does after the first spring.
fn line(points: &[(usize, u64)], value: f64) -> Option<u64> {
    let [(n, a), (m, b)] = points[..] else { return None };
    let slope = (b as f64 - a as f64) / (m as f64 - n as f64);
    let place = n as f64 + (value - a as f64) / slope;
    (slope > 0.0 && place >= 1.0).then_some(place as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames that are longer than the measurement.
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
