//! A drive made ready, and loops of it.

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

/// Number of the scenario in packets.
pub(crate) const SCENARIO: u64 = 0x5ca1_ab1e;
/// Length of a frame, s.
pub(crate) const PERIOD: f64 = 200e-6;

/// What a loop steps by unless another stepper is asked for.
pub(crate) const FRAMES: Stepper = Stepper::Frames { length: PERIOD, accuracy: 1e-3 };

/// A foot that is fed from outside, straight from value to value, under a slider.
pub(crate) const LINEAR: &str =
    r#"{"input": {"initial": 0, "range": ["-1 um", "1 um"], "interpolation": "linear"}}"#;
/// The same by jumps.
pub(crate) const HELD: &str = r#"{"input": {"initial": 0, "range": ["-1 um", "1 um"]}}"#;

/// A drive made ready.
pub(crate) struct Rig {
    pub(crate) job: Job,
    pub(crate) plan: Plan,
    pub(crate) inputs: Vec<Input>,
    pub(crate) outputs: Vec<Output>,
}

impl Rig {
    /// An example whose drive is an input, or is left as it is.
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

    /// Judges who keep silent for `silent` frames and give another client a chance after `owner` ones.
    pub(crate) fn intake(&self, silence: Silence, silent_after: u64, owner: u64) -> Intake {
        Intake::new(SCENARIO, &self.inputs, Patience { silence, silent_after, owner })
    }

    /// Values that are told of frame after frame.
    pub(crate) fn width(&self) -> usize {
        self.outputs.len()
    }

    /// Runs a loop whose outputs are also kept as bytes.
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

/// Nothing comes in, nothing goes out.
pub(crate) fn wiring(source: Source, intake: Intake) -> Wiring {
    Wiring { source, intake, sinks: Vec::new(), log: None, recording: None }
}

/// So many frames after a clock, or without one.
pub(crate) fn order(frames: u64, overrun: Option<Overrun>) -> Order {
    let pace = Pace { period: PERIOD, overrun, spin: 0.0 };
    Order { pace, frames, favours: Favours::default(), floor: 0, wait: 0.0 }
}

/// What is written, for whoever looks later.
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

/// Inputs that differ from frame to frame, as a recording: within ±0.5 µm.
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
