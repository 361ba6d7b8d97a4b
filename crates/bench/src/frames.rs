//! Frames of drives in real time: how long they take by both steppers, what is counted in them, and what they lose.
//!
//! [`measure`] computes frames of every scene, of every period, by the stepper of [`Stepper::Frames`] and by the event stepper, as
//! many as asked for without waiting, and some seconds after a clock; inputs of a scene change in every frame. Beside them
//! the empty loop shows what the machine takes by itself. Errors are against the event stepper at 1e-11.
//!
//! In reading order: `walk` (inputs), `turn` (frames), `accuracy` (errors), `sheet` (tables), `picture`, `page`.

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
/// Name of the table of the worst frames.
pub const WORST: &str = "worst_frames.csv";
/// Name of the table of counts.
pub const HISTOGRAMS: &str = "histograms.csv";
/// Name of the table of errors.
pub const ACCURACY: &str = "accuracy.csv";
/// Name of the picture's files, without ending; it stands for the whole in messages, too.
pub const PICTURE: &str = "frames";
/// What `frames` may lose of a stroke in a stroke: as `stickslip realtime` has it by default.
const LOSS: f64 = 1e-3;
/// Tolerance of the event stepper in frames: as `stickslip realtime` has it by default.
const TOLERANCE: f64 = 1e-8;
/// Most frames over which the error of a loop is measured.
const COMPARED: u64 = 50_000;
/// Names of the steppers, in the order of all pairs.
pub(crate) const STEPPERS: [&str; 2] = ["frames", "event"];

/// What is asked to be measured, and where to.
#[derive(Debug, Clone, PartialEq)]
pub struct FramesRequest {
    /// Scenario files.
    pub files: Vec<PathBuf>,
    /// Values put into every scenario: key path and value.
    pub set: Vec<(String, String)>,
    /// Lengths of frames, s.
    pub periods: Vec<f64>,
    /// Frames of every loop that nothing paces.
    pub frames: u64,
    /// How long each paced loop goes on, s; none where 0.
    pub paced: f64,
    /// Folder of what is measured.
    pub out: PathBuf,
    /// A page in Markdown with the tables and the picture, where one is wanted.
    pub page: Option<PathBuf>,
}

/// A scene made ready.
struct FramesScene<'a> {
    job: &'a Job,
    inputs: Vec<Input>,
    /// Whether each value is held, and not led: those that command a generator are.
    held: Vec<bool>,
    outputs: Vec<Output>,
}

/// Frames of a scene, of a length, by a stepper.
struct Loop {
    /// Place of the scene.
    scene: usize,
    /// Place of the period.
    period: usize,
    /// Place of the stepper.
    stepper: usize,
    /// Steps of a frame where nothing happens in it; none by the event stepper.
    steps: Option<f64>,
    timing: Timing,
    works: Works,
    /// The same after a clock.
    paced: Option<Timing>,
    off: Off,
}

/// What was measured.
struct Findings<'a> {
    request: &'a FramesRequest,
    scenes: Vec<FramesScene<'a>>,
    loops: Vec<Loop>,
    /// Errors over lengths, of each scene.
    ladders: Vec<Vec<Rung>>,
    /// The empty loop, unpaced.
    empty: Timing,
    /// The empty loop of each period, paced.
    floors: Vec<Timing>,
}

/// How many times a watcher is told that something is done.
pub fn turns(request: &FramesRequest) -> f64 {
    (request.files.len() * (1 + STEPPERS.len() * request.periods.len())) as f64
}

/// Measures and writes tables, picture and page; the watcher is told what is done, of [`turns`].
///
/// # Errors
/// A scene in which nothing is free, a run that stops itself, a file that cannot be written, or the watcher's wish.
pub fn measure(jobs: &[Job], request: &FramesRequest, watcher: &dyn Watcher) -> Result<(), BenchError> {
    let scenes = jobs.iter().map(FramesScene::new).collect::<Result<Vec<_>, _>>()?;
    // Nothing else stops what computes nothing.
    let empty = |period: f64, asked: (u64, bool)| {
        turn::empty(period, asked, watcher).map_err(|_| BenchError::Interrupted("the empty loop".to_owned()))
    };
    // What the system does not grant shows in the times of the empty loop.
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

/// Both steppers for frames of a length.
fn steppers(length: f64) -> [Stepper; 2] {
    [Stepper::Frames { length, accuracy: LOSS }, Stepper::Event { tolerance: TOLERANCE }]
}

/// A scene that says why it does not go on.
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

    /// The drive at its start.
    fn drive(&self, stepper: Stepper, length: f64) -> Result<Drive<'_>, BenchError> {
        let plan = Plan { stepper, ..self.job.scenario.plan };
        let start = self.job.model.start(&plan).map_err(|error| stopped(self.job, &error))?;
        Drive::new(&self.job.model, &plan, (start, 0), length, (&self.inputs, &self.outputs))
            .map_err(|error| stopped(self.job, &error))
    }

    /// Frames of a length by a stepper, unpaced and paced, and their error.
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

    /// Name of a loop's scene.
    fn name(&self, of: &Loop) -> &str {
        &self.scenes[of.scene].job.name
    }

    /// Length of a loop's frames, s.
    fn length(&self, of: &Loop) -> f64 {
        self.request.periods[of.period]
    }

    /// The file of a scene.
    fn file(&self, scene: usize) -> &Path {
        &self.request.files[scene]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Somebody who has had enough after so many looks.
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
