//! Commanded generators in the loop.

use crate::rig::{PERIOD, Rig, SCENARIO, order, wiring};
use stickslip_drive::{Command, Heading, Limits, Plan, Run, Stepper, Steps};
use stickslip_realtime::intake::{Client, Silence};
use stickslip_realtime::plant::Takes;
use stickslip_realtime::source::{Recording, Source, recording_head};
use stickslip_realtime::wire::{self, Stamp};
use stickslip_realtime::{Overrun, Plant};
use tempfile::tempdir;

const STEPPERS: [Stepper; 3] = [
    Stepper::Frames { length: PERIOD, accuracy: 1e-3 },
    Stepper::Event { tolerance: 1e-6 },
    Stepper::Verlet { step: 2e-6 },
];
const FRAMES: usize = 800;

/// Returns the command of a frame: stroke, m, frequency, Hz, heading, number of cycles. Corners at 100 Hz coincide with frame ends.
fn said(frame: usize) -> [f64; 4] {
    let backward = if frame % 300 < 150 { 1.0 } else { -1.0 };
    match frame {
        0..30 => [200e-9, 100.0, 1.0, 6.0],
        30..250 => [150e-9 + 1e-9 * (frame / 50) as f64, 100.0, backward, 4.0],
        250..330 => [250e-9, 400.0, backward, 0.0],
        330..420 => [250e-9, 333.0, backward, 3.0],
        420..700 => [10e-9 * (frame % 30) as f64, 500.0 + frame as f64, backward, -1.0],
        _ => [250e-9, 0.0, 1.0, 2.0],
    }
}

fn rig(stepper: Stepper) -> Rig {
    Rig::of("commanded", None, stepper)
}

#[test]
fn a_generator_has_four_inputs_within_its_ranges() {
    let inputs = rig(STEPPERS[0]).inputs;
    let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(names, ["drive.stroke", "drive.frequency", "drive.heading", "drive.steps"]);
    let initial: Vec<f64> = inputs.iter().map(|input| input.initial).collect();
    assert_eq!(initial, [200e-9, 100.0, 1.0, 6.0]);
    let takes: Vec<Takes> = inputs.iter().map(|input| input.takes).collect();
    assert_eq!(takes[..2], [Takes::Range(0.0, 300e-9), Takes::Range(0.0, 2e3)]);
    for (place, good, bad) in [
        (0, [0.0, 300e-9], [-1e-9, 301e-9]),
        (1, [0.0, 2e3], [-1.0, 2001.0]),
        (2, [1.0, -1.0], [0.0, 0.5]),
        (3, [-1.0, 7.0], [-2.0, 1.5]),
    ] {
        assert!(good.iter().all(|value| takes[place].has(*value)), "{place}");
        assert!(bad.iter().all(|value| !takes[place].has(*value)) && !takes[place].has(f64::NAN), "{place}");
    }
}

#[test]
fn a_packet_with_another_heading_or_half_a_step_is_refused() {
    let rig = rig(STEPPERS[0]);
    let mut intake = rig.intake(Silence::Hold, 100, 100);
    let mut offer = |sequence, values: [f64; 4]| {
        let mut bytes = vec![0; wire::length(4)];
        wire::encode(&mut bytes, SCENARIO, Stamp { sequence, time: 0.0 }, &values);
        intake.offer(Client::Only, &bytes);
        (intake.received().good, intake.received().out_of_range)
    };
    assert_eq!(offer(1, [1e-7, 50.0, -1.0, -1.0]), (1, 0));
    assert_eq!(offer(2, [1e-7, 50.0, 0.0, -1.0]), (1, 1));
    assert_eq!(offer(2, [1e-7, 50.0, 1.0, 0.5]), (1, 2));
    assert_eq!(offer(2, [1e-7, 2500.0, 1.0, 1.0]), (1, 3));
    assert_eq!(offer(2, [1e-7, 50.0, 1.0, 1.0]), (2, 3));
}

/// The reference gives a command by hand whenever a value changes, with the remaining number of cycles if this number is unchanged.
#[test]
fn commands_through_the_loop_are_those_of_the_run_to_the_bit() {
    for stepper in STEPPERS {
        let rig = rig(stepper);
        let mut drive = rig.drive((rig.start(), 0));
        let limits = Limits { steps: u64::MAX, events: u64::MAX, wall: None };
        let plan = Plan { every: None, until_steady: None, limits, ..rig.plan };
        let mut run = Run::new(&rig.job.model, &plan, rig.start()).unwrap();
        let mut outputs = vec![0.0; rig.width()];
        let mut before = said(0);
        for frame in 0..FRAMES {
            let now = said(frame);
            let [stroke, frequency, heading, steps] = now;
            if now != before {
                let count = match steps {
                    -1.0 => Steps::Endless,
                    _ if steps == before[3] => run.state().generated(0).unwrap().left,
                    _ => Steps::Left(steps as u64),
                };
                let heading = if heading == 1.0 { Heading::Forward } else { Heading::Backward };
                run.command(0, Command { stroke, frequency, heading, steps: count }).unwrap();
            }
            before = now;
            run.advance((frame + 1) as f64 * PERIOD, &mut ()).unwrap();
            drive.frame(&now, &mut outputs).unwrap();
            assert!(drive.state() == run.state(), "{stepper:?} {frame}");
        }
        // The slider has moved in both directions and is at rest in between.
        assert!(run.state().generated(0).unwrap().begun > 30, "{stepper:?}");
    }
}

/// Six requested cycles are executed exactly, whatever else is commanded meanwhile, even at the times at which cycles start.
#[test]
fn a_number_of_steps_that_is_repeated_is_no_new_one() {
    for stepper in STEPPERS {
        let rig = rig(stepper);
        let mut drive = rig.drive((rig.start(), 0));
        let mut outputs = vec![0.0; rig.width()];
        let mut begun =
            |drive: &mut stickslip_realtime::Drive<'_>, frames: usize, say: &dyn Fn(usize) -> [f64; 4]| {
                (0..frames).for_each(|frame| drive.frame(&say(frame), &mut outputs).map(|_| ()).unwrap());
                drive.state().generated(0).unwrap().begun
            };
        // A different stroke in every frame; cycles of 10 ms start at every 50th frame.
        let six = begun(&mut drive, 500, &|frame| [100e-9 + 1e-9 * (frame % 7) as f64, 100.0, 1.0, 6.0]);
        assert_eq!(six, 6, "{stepper:?}");
        assert_eq!(begun(&mut drive, 100, &|_| [100e-9, 100.0, 1.0, 2.0]), 8, "{stepper:?}");
        // The same number again, with another one in between.
        assert_eq!(
            begun(&mut drive, 100, &|frame| [100e-9, 100.0, 1.0, if frame == 0 { 0.0 } else { 2.0 }]),
            10
        );
        assert_eq!(begun(&mut drive, 100, &|_| [100e-9, 100.0, 1.0, -1.0]), 12, "{stepper:?}");
    }
}

fn replayed(rig: &Rig, folder: &std::path::Path) -> Source {
    let head = recording_head(SCENARIO, PERIOD, 4).into_iter();
    let values = (0..FRAMES).flat_map(said).map(f64::to_bits);
    let bytes: Vec<u8> = head.chain(values).flat_map(u64::to_le_bytes).collect();
    let path = folder.join("commands.rec");
    std::fs::write(&path, bytes).unwrap();
    Source::Recording(Recording::read(&path, SCENARIO, PERIOD, &rig.inputs).unwrap())
}

#[test]
fn recorded_commands_make_the_same_outputs_with_a_clock_and_without() {
    let folder = tempdir().unwrap();
    for stepper in STEPPERS {
        let rig = rig(stepper);
        let traces = [Some(Overrun::Skip), None].map(|overrun| {
            let mut drive = rig.drive((rig.start(), 0));
            let wiring = wiring(replayed(&rig, folder.path()), rig.intake(Silence::Hold, 10, 10));
            let (ended, bytes) = rig.run(&mut drive, wiring, &order(FRAMES as u64, overrun));
            assert_eq!((ended.outcome, ended.unsent), (Ok(()), 0));
            bytes
        });
        assert!(traces[0].len() == FRAMES * wire::length(rig.width()) && traces[0] == traces[1]);
    }
}

/// A drive that is resumed from its state with the last inputs continues as if it had not been interrupted.
#[test]
fn put_down_between_two_steps_and_taken_up_it_counts_on() {
    let rig = rig(STEPPERS[0]);
    let mut outputs = [vec![0.0; rig.width()], vec![0.0; rig.width()]];
    let mut whole = rig.drive((rig.start(), 0));
    (0..101).for_each(|frame| whole.frame(&said(frame), &mut outputs[0]).map(|_| ()).unwrap());
    let mut half = rig.drive((whole.state().clone(), 101)).after(&said(100));
    for frame in 101..FRAMES {
        whole.frame(&said(frame), &mut outputs[0]).unwrap();
        half.frame(&said(frame), &mut outputs[1]).unwrap();
        assert_eq!(outputs[0], outputs[1], "{frame}");
    }
}

#[test]
fn commands_allocate_nothing() {
    for stepper in STEPPERS {
        let rig = rig(stepper);
        let mut drive = rig.drive((rig.start(), 0));
        let mut outputs = vec![0.0; rig.width()];
        (0..200).for_each(|frame| drive.frame(&said(frame), &mut outputs).map(|_| ()).unwrap());
        let info = allocation_counter::measure(|| {
            (200..FRAMES).for_each(|frame| drive.frame(&said(frame), &mut outputs).map(|_| ()).unwrap());
        });
        assert_eq!(info.count_total, 0, "{stepper:?}");
    }
}
