//! Pacing and interruption do not change the results.

use crate::rig::{FRAMES, HELD, Kept, LINEAR, PERIOD, Rig, SCENARIO, order, recording, wiring};
use std::collections::HashMap;
use std::io::Write;
use std::time::Duration;
use stickslip_drive::{State, Stepper};
use stickslip_realtime::intake::Silence;
use stickslip_realtime::pace::Stop;
use stickslip_realtime::plant::Empty;
use stickslip_realtime::source::{Recording, Source};
use stickslip_realtime::tape::{Form, tape};
use stickslip_realtime::{Overrun, Sink, wire};
use tempfile::tempdir;

const EVENT: Stepper = Stepper::Event { tolerance: 1e-6 };
const VERLET: Stepper = Stepper::Verlet { step: 1e-6 };
const COUNT: usize = 1500;

#[test]
fn a_clock_changes_no_bit() {
    let folder = tempdir().unwrap();
    for (drive, stepper) in
        [(LINEAR, FRAMES), (HELD, FRAMES), (LINEAR, EVENT), (LINEAR, VERLET), (HELD, EVENT)]
    {
        let rig = Rig::of("p1", Some(drive), stepper);
        let traces = [Some(Overrun::Skip), None].map(|overrun| {
            let source = recording(&rig, COUNT, folder.path());
            let mut drive = rig.drive((rig.start(), 0));
            let wiring = wiring(source, rig.intake(Silence::Hold, 10, 10));
            let (ended, bytes) = rig.run(&mut drive, wiring, &order(COUNT as u64, overrun));
            assert_eq!((ended.outcome, ended.unsent), (Ok(()), 0));
            assert_eq!(ended.wiring.intake.received().good, COUNT as u64);
            bytes
        });
        assert_eq!(traces[0].len(), COUNT * wire::length(rig.width()));
        assert!(traces[0] == traces[1], "{stepper:?}");
        // The inputs have moved the slider.
        let mut values = vec![0.0; rig.width()];
        let last = &traces[0][traces[0].len() - wire::length(rig.width())..];
        let stamp = wire::decode(last, SCENARIO, &mut values).unwrap();
        assert_eq!((stamp.sequence, stamp.time), (COUNT as u64, COUNT as f64 * PERIOD));
        let x = rig.outputs.iter().position(|output| output.name == "slider.x_m").unwrap();
        assert!(values[x].abs() > 1e-12, "{values:?}");
    }
}

#[test]
fn what_was_recorded_is_fed_again_to_the_same_bits() {
    for stepper in [FRAMES, EVENT] {
        records_and_feeds_again(&Rig::of("p1", Some(LINEAR), stepper));
    }
}

fn records_and_feeds_again(rig: &Rig) {
    let folder = tempdir().unwrap();
    let once = || {
        let kept = Kept::default();
        let (tape, reel) = tape(rig.inputs.len(), Form::Binary, kept.clone());
        let mut wiring = wiring(recording(rig, COUNT, folder.path()), rig.intake(Silence::Hold, 10, 10));
        wiring.recording = Some(tape);
        let mut drive = rig.drive((rig.start(), 0));
        let order = order(COUNT as u64, None);
        let mut reels = [reel];
        let start = vec![0.0; rig.width()];
        let ended = stickslip_realtime::session::run(&mut drive, wiring, &start, &order, &mut reels, &());
        assert_eq!((ended.outcome, ended.wiring.recording.unwrap().lost()), (Ok(()), 0));
        let bytes = kept.0.lock().unwrap().clone();
        (bytes, drive.state().clone())
    };
    let (recorded, state) = once();
    let path = folder.path().join("inputs.rec");
    // The recording equals the inputs and can be replayed from a file.
    let head = std::fs::read(&path).unwrap()[..32].to_vec();
    assert_eq!(std::fs::read(&path).unwrap()[32..], recorded);
    std::fs::write(&path, [head, recorded].concat()).unwrap();
    assert!(once().1 == state);
}

#[test]
fn a_recording_that_does_not_fit_is_refused() {
    let folder = tempdir().unwrap();
    let rig = Rig::of("p1", Some(LINEAR), EVENT);
    recording(&rig, COUNT, folder.path());
    let path = folder.path().join("inputs.rec");
    let other = Recording::read(&path, SCENARIO + 1, PERIOD, &rig.inputs).map(|_| ()).unwrap_err();
    assert!(other.to_string().contains("another scenario"), "{other}");
    let other = Recording::read(&path, SCENARIO, 2.0 * PERIOD, &rig.inputs).map(|_| ()).unwrap_err();
    assert!(other.to_string().contains("frames of"), "{other}");
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[32 + 8 * 7..40 + 8 * 7].copy_from_slice(&2e-6_f64.to_le_bytes());
    std::fs::write(&path, bytes).unwrap();
    let other = Recording::read(&path, SCENARIO, PERIOD, &rig.inputs).map(|_| ()).unwrap_err();
    assert!(other.to_string().contains("frame 7 has 2e-6 for input drive"), "{other}");
}

/// The first half of the frames runs here, the second half in another process from the stored state.
#[test]
fn put_down_in_one_process_and_taken_up_in_another_it_goes_on_to_the_same_bits() {
    goes_on_elsewhere(
        EVENT,
        "pacing::put_down_in_one_process_and_taken_up_in_another_it_goes_on_to_the_same_bits",
    );
}

#[test]
fn put_down_and_taken_up_frames_of_bounded_work_go_on_to_the_same_bits() {
    goes_on_elsewhere(FRAMES, "pacing::put_down_and_taken_up_frames_of_bounded_work_go_on_to_the_same_bits");
}

/// `name` is the name of the calling test, which the other process runs.
fn goes_on_elsewhere(stepper: Stepper, name: &str) {
    const FOLDER: &str = "STICKSLIP_REALTIME_PUT_DOWN";
    let key = [7; 32];
    let half = COUNT as u64 / 2;
    let rig = Rig::of("p1", Some(LINEAR), stepper);
    let model = &rig.job.model;
    if let Ok(folder) = std::env::var(FOLDER) {
        let folder = std::path::Path::new(&folder);
        let bytes = std::fs::read(folder.join("state")).unwrap();
        let mut drive = rig.drive((State::from_bytes(model, &key, &bytes).unwrap(), half));
        let mut values = feed(&recording(&rig, COUNT, folder), &rig);
        let told = go(&mut drive, &rig, &values.split_off(half as usize));
        std::fs::write(folder.join("told"), told).unwrap();
        return;
    }
    let folder = tempdir().unwrap();
    let values = feed(&recording(&rig, COUNT, folder.path()), &rig);
    let mut drive = rig.drive((rig.start(), 0));
    go(&mut drive, &rig, &values[..half as usize]);
    std::fs::write(folder.path().join("state"), drive.state().to_bytes(model, &key)).unwrap();
    let here = go(&mut drive, &rig, &values[half as usize..]);
    let mut other = std::process::Command::new(std::env::current_exe().unwrap());
    let output = other.args(["--exact", name]).env(FOLDER, folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(here == std::fs::read(folder.path().join("told")).unwrap());
}

/// Returns the values of a recording with one input.
fn feed(source: &Source, rig: &Rig) -> Vec<f64> {
    assert!(matches!(source, Source::Recording(_)) && rig.inputs.len() == 1);
    let mut drawn = 0x2545_f491_4f6c_dd1d_u64;
    let draw = |_| {
        drawn ^= drawn << 13;
        drawn ^= drawn >> 7;
        drawn ^= drawn << 17;
        1e-6 * ((drawn >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    (0..COUNT).map(draw).collect()
}

fn go(drive: &mut stickslip_realtime::Drive<'_>, rig: &Rig, values: &[f64]) -> Vec<u8> {
    use stickslip_realtime::Plant;
    let (mut outputs, mut told) = (vec![0.0; rig.width()], Vec::new());
    for value in values {
        drive.frame(&[*value], &mut outputs).unwrap();
        told.extend(outputs.iter().flat_map(|output| output.to_le_bytes()));
    }
    told
}

/// The overruns in the report equal those in the log of all frames. Sleeping frames ensure that there are some.
#[test]
fn overruns_are_those_of_the_log() {
    let rig = Rig::of("p1", None, EVENT);
    let log = Kept::default();
    let (log_tape, reel) = tape(4, Form::Csv, log.clone());
    let mut wiring = wiring(Source::None, rig.intake(Silence::Hold, 10, 10));
    wiring.log = Some(log_tape);
    let mut drive = rig.drive((rig.start(), 0));
    let mut start = vec![0.0; rig.width()];
    drive.tell(&mut start);
    let mut reels = [reel];
    // No machine that sleeps between frames can keep frames of 200 ns.
    let mut order = order(20_000, Some(Overrun::Skip));
    order.pace.period = 200e-9;
    let ended = stickslip_realtime::session::run(&mut drive, wiring, &start, &order, &mut reels, &());
    let text = String::from_utf8(log.0.lock().unwrap().clone()).unwrap();
    let rows: Vec<Vec<u64>> =
        text.lines().map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    assert_eq!((rows.len(), ended.wiring.log.unwrap().lost()), (20_000, 0));
    assert!(rows.iter().enumerate().all(|(k, row)| row[0] == k as u64));
    let over = rows.iter().filter(|row| row[1] + row[2] > 200).count() as u64;
    println!("{over} of 20000 frames");
    assert!(over > 0);
    assert_eq!((ended.timing.overruns, ended.timing.left_out), (over, rows.iter().map(|row| row[3]).sum()));
    // The histograms contain the same latencies and execution times.
    let sums: HashMap<_, u64> = [1, 2].map(|i| (i, rows.iter().map(|row| row[i]).sum())).into();
    let means = [&ended.timing.latency, &ended.timing.execution].map(|h| h.mean() * h.total() as f64);
    assert!((means[0] - sums[&1] as f64).abs() < 1.0 && (means[1] - sums[&2] as f64).abs() < 1.0);
}

#[test]
fn a_loop_that_is_to_stop_at_an_overrun_does() {
    let rig = Rig::of("p1", None, EVENT);
    let wiring = wiring(Source::None, rig.intake(Silence::Hold, 10, 10));
    let mut order = order(20_000, Some(Overrun::Stop));
    order.pace.period = 200e-9;
    let (ended, bytes) = rig.run(&mut rig.drive((rig.start(), 0)), wiring, &order);
    assert_eq!((ended.outcome, ended.timing.overruns), (Err(Stop::Overrun), 1));
    // All computed frames were reported.
    assert_eq!(bytes.len() as u64, ended.timing.frames() * wire::length(rig.width()) as u64);
}

/// Without pacing no record is lost, although the frames exceed the buffer and are faster than the writing.
#[test]
fn without_a_clock_the_loop_waits_for_what_is_written_down() {
    /// A writer that is slow at first, so that the loop could fill the buffer.
    struct Slow(u64, Duration);

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            std::thread::sleep(std::mem::take(&mut self.1));
            self.0 += bytes.len() as u64;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    let count = 300_000;
    let rig = Rig::of("p1", Some(LINEAR), EVENT);
    let mut slow = [(); 3].map(|()| Slow(0, Duration::from_millis(400)));
    let [told, logged, recorded] = &mut slow;
    let (width, start) = (wire::length(rig.width()) / 8, vec![0.0; rig.width()]);
    let (sink, a) = tape(width, Form::Binary, told);
    let (log, b) = tape(4, Form::Binary, logged);
    let (recording, c) = tape(1, Form::Binary, recorded);
    let mut wiring = wiring(Source::None, rig.intake(Silence::Hold, 10, 10));
    wiring.sinks.push(Sink::File(sink));
    (wiring.log, wiring.recording) = (Some(log), Some(recording));
    let order = order(count, None);
    let ended = stickslip_realtime::session::run(&mut Empty, wiring, &start, &order, &mut [a, b, c], &());
    let lost = [ended.wiring.log, ended.wiring.recording].map(|tape| tape.unwrap().lost());
    assert_eq!((ended.timing.frames(), ended.unsent, lost), (count, 0, [0, 0]));
    assert_eq!(slow.map(|slow| slow.0), [8 * count * width as u64, 32 * count, 8 * count]);
}

/// A watcher that stops the run once.
struct Once(std::sync::atomic::AtomicU64);

impl stickslip_drive::Watcher for Once {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed) < 100
    }
}

/// The observer of a frame with 200 000 steps is asked every 1024 steps.
#[test]
fn an_interruption_ends_a_frame_that_takes_long() {
    for stepper in [Stepper::Verlet { step: 1e-9 }, Stepper::Rk4 { step: 1e-9 }] {
        let rig = Rig::of("p1", None, stepper);
        let once = Once(97.into());
        let mut drive = rig.drive((rig.start(), 0)).heeding(&once);
        let wiring = wiring(Source::None, rig.intake(Silence::Hold, 10, 10));
        let start = vec![0.0; rig.width()];
        let order = order(1_000_000, None);
        let ended = stickslip_realtime::session::run(&mut drive, wiring, &start, &order, &mut [], &once);
        assert_eq!((ended.outcome, ended.timing.frames()), (Err(Stop::Interrupted), 0));
        // The observer is asked before the frame and after each 1024 steps; at the fourth time it stops the run.
        let reached = drive.state().time();
        assert!((reached / 3072e-9 - 1.0).abs() < 1e-9, "{stepper:?}: {reached}");
    }
}

#[test]
fn an_interruption_ends_the_empty_loop_at_once() {
    let rig = Rig::of("p1", None, EVENT);
    let mut drive = rig.drive((rig.start(), 0));
    let wiring = wiring(Source::None, rig.intake(Silence::Hold, 10, 10));
    let mut order = order(1_000_000_000, Some(Overrun::Skip));
    order.floor = (3600.0 / PERIOD) as u64;
    let start = vec![0.0; rig.width()];
    let once = Once(0.into());
    let ended = stickslip_realtime::session::run(&mut drive, wiring, &start, &order, &mut [], &once);
    assert_eq!(ended.outcome, Err(Stop::Interrupted));
    assert_eq!((ended.floor.frames(), ended.timing.frames()), (100, 0));
}
