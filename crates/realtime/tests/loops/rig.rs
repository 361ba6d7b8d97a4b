//! Prepared drives and their loops for the tests.

use std::path::Path;
use std::sync::{Arc, Mutex};
use stickslip_drive::{Plan, State, Stepper};
use stickslip_realtime::intake::{Patience, Silence};
use stickslip_realtime::plant::{Input, Output, inputs, outputs};
use stickslip_realtime::session::{self, Ended, Order, Wiring};
use stickslip_realtime::system::Favours;
use stickslip_realtime::tape::{Form, Reel, tape};
use stickslip_realtime::wire;
use stickslip_realtime::{Drive, Intake, Overrun, Pace, Sink, Source};
use stickslip_run::Job;

/// Scenario number in packets.
pub(crate) const SCENARIO: u64 = 0x5ca1_ab1e;
/// Length of a frame, s.
pub(crate) const PERIOD: f64 = 200e-6;

/// Default integrator of a loop.
pub(crate) const FRAMES: Stepper = Stepper::Frames { length: PERIOD, accuracy: 1e-3 };

/// Input for the foot with linear interpolation.
pub(crate) const LINEAR: &str =
    r#"{"input": {"initial": 0, "range": ["-1 um", "1 um"], "interpolation": "linear"}}"#;
/// Input for the foot with held values.
pub(crate) const HELD: &str = r#"{"input": {"initial": 0, "range": ["-1 um", "1 um"]}}"#;

/// A prepared drive.
pub(crate) struct Rig {
    pub(crate) job: Job,
    pub(crate) plan: Plan,
    pub(crate) inputs: Vec<Input>,
    pub(crate) outputs: Vec<Output>,
}

impl Rig {
    /// Prepares an example. `drive` replaces its waveform.
    pub(crate) fn of(example: &str, drive: Option<&str>, stepper: Stepper) -> Self {
        let file =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(format!("{example}.json"));
        let mut set: Vec<(String, String)> =
            drive.map(|drive| ("waveforms.drive".to_owned(), drive.to_owned())).into_iter().collect();
        if drive.is_some() {
            set.push(("run".to_owned(), r#"{"duration": "1 s"}"#.to_owned()));
        }
        let job = Job::prepare(&file, &set, Path::new("")).unwrap();
        let plan = Plan { stepper, ..job.scenario.plan };
        let inputs = inputs(&job.scenario.scene).unwrap();
        let outputs = outputs(&job.model, None).unwrap();
        Self { job, plan, inputs, outputs }
    }

    pub(crate) fn start(&self) -> State {
        self.job.model.start(&self.plan).unwrap()
    }

    pub(crate) fn drive(&self, at: (State, u64)) -> Drive<'_> {
        Drive::new(&self.job.model, &self.plan, at, PERIOD, (&self.inputs, &self.outputs)).unwrap()
    }

    /// Returns a validator with these time limits in frames.
    pub(crate) fn intake(&self, silence: Silence, silent_after: u64, owner: u64) -> Intake {
        Intake::new(SCENARIO, &self.inputs, Patience { silence, silent_after, owner })
    }

    /// Returns the number of outputs.
    pub(crate) fn width(&self) -> usize {
        self.outputs.len()
    }

    /// Runs a loop and returns its outputs as bytes, too.
    pub(crate) fn run(&self, drive: &mut Drive<'_>, wiring: Wiring, order: &Order) -> (Ended, Vec<u8>) {
        let (mut wiring, kept) = (wiring, Kept::default());
        let words = wire::length(self.width()) / 8;
        let (end, reel) = tape(words, Form::Binary, kept.clone());
        wiring.sinks.push(Sink::File(end));
        let mut start = vec![0.0; self.width()];
        drive.tell(&mut start);
        let mut reels = [reel];
        let ended = session::run(drive, wiring, &start, order, &mut reels, &());
        assert!(reels.iter().all(|reel: &Reel<'_>| reel.failure().is_none()));
        let bytes = kept.0.lock().unwrap().clone();
        (ended, bytes)
    }
}

/// Returns inputs and outputs without sinks.
pub(crate) fn wiring(source: Source, intake: Intake) -> Wiring {
    Wiring { source, intake, sinks: Vec::new(), log: None, recording: None }
}

/// Returns the settings of a loop with or without pacing.
pub(crate) fn order(frames: u64, overrun: Option<Overrun>) -> Order {
    let pace = Pace { period: PERIOD, overrun, spin: 0.0 };
    Order { pace, frames, favours: Favours::default(), floor: 0, wait: 0.0 }
}

/// A shared buffer for written bytes.
#[derive(Clone, Default)]
pub(crate) struct Kept(pub(crate) Arc<Mutex<Vec<u8>>>);

impl std::io::Write for Kept {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Returns a recording of inputs within ±0.5 µm that differ from frame to frame.
pub(crate) fn recording(rig: &Rig, frames: usize, folder: &Path) -> Source {
    use stickslip_realtime::source::{Recording, recording_head};
    let mut bytes: Vec<u8> = recording_head(SCENARIO, PERIOD, rig.inputs.len())
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .collect();
    let mut drawn = 0x2545_f491_4f6c_dd1d_u64;
    for _ in 0..frames * rig.inputs.len() {
        drawn ^= drawn << 13;
        drawn ^= drawn >> 7;
        drawn ^= drawn << 17;
        let value = 1e-6 * ((drawn >> 11) as f64 / (1_u64 << 53) as f64 - 0.5);
        bytes.extend(value.to_le_bytes());
    }
    let path = folder.join("inputs.rec");
    std::fs::write(&path, bytes).unwrap();
    Source::Recording(Recording::read(&path, SCENARIO, PERIOD, &rig.inputs).unwrap())
}
