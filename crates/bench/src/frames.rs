//! Benchmark of real-time frames: computing times, counts and errors of both real-time steppers.
//!
//! [`measure`] computes frames of all scenarios and frame lengths with [`Stepper::Frames`] and with the event stepper. A number of frames
//! is computed without waiting, then frames paced by a clock for some seconds. Inputs change in every frame. An empty loop measures the
//! machine itself. Errors are relative to the event stepper at 1e-11.
//!
//! Reading order: `walk` (inputs), `turn` (frames), `accuracy` (errors), `sheet` (tables), `picture`, `page`.

mod accuracy;
mod page;
mod picture;
mod sheet;
mod turn;
mod walk;

use crate::error::BenchError;
use crate::norm;
use crate::problem::ProblemError;
use accuracy::{Off, Rung};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use stickslip_drive::{Plan, Stepper};
use stickslip_realtime::pace::Stop;
use stickslip_realtime::plant::{ChannelError, Input, Output, inputs, outputs};
use stickslip_realtime::system::Favours;
use stickslip_realtime::{Drive, Timing};
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Watcher};
use turn::Works;

/// Name of the table of all loops.
pub const TABLE: &str = "frames.csv";
/// Name of the table of the slowest frames.
pub const WORST: &str = "worst_frames.csv";
/// Name of the table of histograms.
pub const HISTOGRAMS: &str = "histograms.csv";
/// Name of the table of errors.
pub const ACCURACY: &str = "accuracy.csv";
/// Name of the plot files without extension, also used in messages.
pub const PICTURE: &str = "frames";
/// Accuracy of `frames`: error per stroke relative to the stroke, the default of `stickslip realtime`.
const LOSS: f64 = 1e-3;
/// Tolerance of the event stepper in frames, the default of `stickslip realtime`.
const TOLERANCE: f64 = 1e-8;
/// Maximum number of frames over which the error of a loop is measured.
const COMPARED: u64 = 50_000;
/// Names of the steppers, in the order of all pairs.
pub(crate) const STEPPERS: [&str; 2] = ["frames", "event"];

/// Request for a benchmark of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct FramesRequest {
    /// Scenario files.
    pub files: Vec<PathBuf>,
    /// Overrides of all scenarios: key path and value.
    pub set: Vec<(String, String)>,
    /// Frame lengths, s.
    pub periods: Vec<f64>,
    /// Number of frames of each loop without pacing.
    pub frames: u64,
    /// Duration of each paced loop, s; 0 for no paced loops.
    pub paced: f64,
    /// Output folder.
    pub out: PathBuf,
    /// Markdown page with tables and plot, if requested.
    pub page: Option<PathBuf>,
}

/// Scenario with its inputs and outputs.
struct FramesScene<'a> {
    job: &'a Job,
    inputs: Vec<Input>,
    /// Whether each input is held; otherwise it is interpolated. Commands of generators are held.
    held: Vec<bool>,
    outputs: Vec<Output>,
}

/// Measurement of a scenario, a frame length and a stepper.
struct Loop {
    /// Index of the scenario.
    scene: usize,
    /// Index of the frame length.
    period: usize,
    /// Index of the stepper.
    stepper: usize,
    /// Number of steps of a frame without events; `None` for the event stepper.
    steps: Option<f64>,
    timing: Timing,
    works: Works,
    /// Times of the paced loop.
    paced: Option<Timing>,
    off: Off,
}

/// Results of the benchmark.
struct Findings<'a> {
    request: &'a FramesRequest,
    scenes: Vec<FramesScene<'a>>,
    loops: Vec<Loop>,
    /// Errors at several frame lengths, for each scenario.
    ladders: Vec<Vec<Rung>>,
    /// Times of the empty loop without pacing.
    empty: Timing,
    /// Times of the paced empty loop, for each frame length.
    floors: Vec<Timing>,
}

/// Returns the number of progress reports that a watcher receives.
pub fn turns(request: &FramesRequest) -> f64 {
    (request.files.len() * (1 + STEPPERS.len() * request.periods.len())) as f64
}

/// Runs the benchmark and writes tables, plot and page. The watcher receives the number of finished parts; [`turns`] is their total.
///
/// # Errors
/// A model without free coordinates, a run that fails, a file that cannot be written, or an interruption by the watcher.
pub fn measure(jobs: &[Job], request: &FramesRequest, watcher: &dyn Watcher) -> Result<(), BenchError> {
    let scenes = jobs.iter().map(FramesScene::new).collect::<Result<Vec<_>, _>>()?;
    // The empty loop can only be stopped by the watcher.
    let empty = |period: f64, asked: (u64, bool)| {
        turn::empty(period, asked, watcher).map_err(|_| BenchError::Interrupted("the empty loop".to_owned()))
    };
    // A real-time priority that the system refuses appears in the times of the empty loop.
    let _ = Favours::default().ask();
    let paced = |period: f64| ((request.paced / period).round() as u64, true);
    let mut findings = Findings {
        request,
        scenes,
        loops: Vec::new(),
        ladders: Vec::new(),
        empty: empty(1.0, (request.frames, false))?,
        floors: request
            .periods
            .iter()
            .map(|period| empty(*period, paced(*period)))
            .collect::<Result<_, _>>()?,
    };
    let mut done = 0.0;
    let mut tick = || {
        done += 1.0;
        watcher.reached(done);
    };
    for place in 0..findings.scenes.len() {
        let scene = &findings.scenes[place];
        let ladder = accuracy::ladder(scene, steppers, watcher)?;
        tick();
        let mut loops = Vec::new();
        for (period, length) in request.periods.iter().enumerate() {
            for stepper in 0..STEPPERS.len() {
                let at = (place, period, stepper);
                loops.push(scene.measure(at, *length, (request.frames, paced(*length)), watcher)?);
                tick();
            }
        }
        findings.loops.extend(loops);
        findings.ladders.push(ladder);
    }
    findings.write()
}

/// Returns both steppers for a frame length.
fn steppers(length: f64) -> [Stepper; 2] {
    [Stepper::Frames { length, accuracy: LOSS }, Stepper::Event { tolerance: TOLERANCE }]
}

/// Returns the error of a scenario whose run failed.
fn stopped(job: &Job, error: &dyn Display) -> BenchError {
    BenchError::Stopped { name: job.name.clone(), why: error.to_string() }
}

impl<'a> FramesScene<'a> {
    fn new(job: &'a Job) -> Result<Self, BenchError> {
        let wrong = |error: ChannelError| stopped(job, &error);
        let coordinates = norm::coordinates(&job.scenario.scene);
        if coordinates.is_empty() {
            return Err(ProblemError::NothingFree(job.name.clone()).into());
        }
        let inputs = inputs(&job.scenario.scene).map_err(wrong)?;
        let held = inputs.iter().map(|input| !input.is_led()).collect();
        let channels: Vec<String> = coordinates.into_iter().map(|coordinate| coordinate.channel).collect();
        let outputs = outputs(&job.model, Some(&channels)).map_err(wrong)?;
        Ok(Self { job, inputs, held, outputs })
    }

    /// Returns the drive in its initial state.
    fn drive(&self, stepper: Stepper, length: f64) -> Result<Drive<'_>, BenchError> {
        let plan = Plan { stepper, ..self.job.scenario.plan };
        let start = self.job.model.start(&plan).map_err(|error| stopped(self.job, &error))?;
        Drive::new(&self.job.model, &plan, (start, 0), length, (&self.inputs, &self.outputs))
            .map_err(|error| stopped(self.job, &error))
    }

    /// Measures frames of one length with one stepper: times without and with pacing, and errors.
    fn measure(
        &self,
        (scene, period, stepper): (usize, usize, usize),
        length: f64,
        (frames, paced): (u64, (u64, bool)),
        watcher: &dyn Watcher,
    ) -> Result<Loop, BenchError> {
        let ended = |stop: Stop| match stop {
            Stop::Plant(error) => stopped(self.job, &error),
            _ => BenchError::Interrupted(self.job.name.clone()),
        };
        let chosen = steppers(length)[stepper];
        let channels = (&self.inputs[..], &self.outputs[..]);
        let compared = (length, frames.min(COMPARED));
        let off = accuracy::of(self, chosen, compared, watcher)?;
        let turn = |asked| {
            turn::frames(self.drive(chosen, length)?, channels, length, asked, watcher).map_err(ended)
        };
        let (timing, works) = turn((frames, false))?;
        let paced = if paced.0 == 0 { None } else { Some(turn(paced)?.0) };
        let steps = match chosen {
            Stepper::Frames { length, accuracy } => Some(self.job.model.substeps(length, accuracy)),
            _ => None,
        };
        Ok(Loop { scene, period, stepper, steps, timing, works, paced, off })
    }
}

impl Findings<'_> {
    fn write(&self) -> Result<(), BenchError> {
        let out = &self.request.out;
        let pictures =
            picture::draw(self).map_err(|source| BenchError::Picture { name: PICTURE.to_owned(), source })?;
        let failed = |source| BenchError::File { path: out.clone(), source };
        let mut folder = Folder::make(out).map_err(failed)?;
        for (name, text) in [
            (TABLE, sheet::loops(self)),
            (WORST, sheet::worst(self)),
            (HISTOGRAMS, sheet::histograms(self)),
            (ACCURACY, sheet::accuracy(self)),
        ] {
            folder.write(name, text.as_bytes()).map_err(failed)?;
        }
        pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
        folder.publish().map_err(failed)?;
        let Some(file) = &self.request.page else { return Ok(()) };
        page::write(self, file).map_err(|source| BenchError::File { path: file.clone(), source })
    }

    /// Returns the name of a loop's scenario.
    fn name(&self, of: &Loop) -> &str {
        &self.scenes[of.scene].job.name
    }

    /// Returns the frame length of a loop, s.
    fn length(&self, of: &Loop) -> f64 {
        self.request.periods[of.period]
    }

    /// Returns the file of a scenario.
    fn file(&self, scene: usize) -> &Path {
        &self.request.files[scene]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Watcher that interrupts after a number of calls.
    pub(super) struct After(std::cell::Cell<u64>);

    impl Watcher for After {
        fn reached(&self, _: f64) {}

        fn goes_on(&self) -> bool {
            let left = self.0.get();
            self.0.set(left.saturating_sub(1));
            left > 0
        }
    }

    fn job(file: &str, set: &[(&str, &str)]) -> Job {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
        let set: Vec<_> = set.iter().map(|(path, value)| ((*path).to_owned(), (*value).to_owned())).collect();
        Job::prepare(&file, &set, Path::new("")).unwrap()
    }

    #[test]
    fn each_value_of_a_generator_is_held_and_an_input_beside_it_as_it_says() {
        let linear = r#"{"input": {"initial": 0, "range": [-1, 1], "interpolation": "linear"}}"#;
        let job = job("docs/realtime/stage.json", &[("waveforms.a", linear)]);
        let scene = FramesScene::new(&job).unwrap();
        let held: Vec<_> =
            scene.inputs.iter().zip(&scene.held).map(|(input, held)| (input.name.as_str(), *held)).collect();
        assert_eq!((held.len(), scene.held.len()), (5, 5));
        assert!(held.iter().all(|(name, held)| *held == (*name != "a")), "{held:?}");
    }

    #[test]
    fn errors_over_lengths_hear_the_watcher() {
        let job = job("scenarios/p1.json", &[("run.cycles", "2")]);
        let scene = FramesScene::new(&job).unwrap();
        let found = accuracy::ladder(&scene, steppers, &After(1000.into())).map(|_| ());
        assert!(matches!(found, Err(BenchError::Interrupted(name)) if name == "p1"));
    }
}
