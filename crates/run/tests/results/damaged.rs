//! Damaged states give an error, or a state from which a run continues or stops with an error. They never cause a panic or an endless run.
//!
//! States of all examples, both engines and all integrators are randomly changed. With the old checksum all are rejected. With a corrected
//! checksum, accepted states are run on within limits. `STICKSLIP_DAMAGES` is the number of changes of each kind.

use crate::shared::{Lottery, Stage, rk4, scenarios, verlet};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use stickslip_drive::{BytesError, Limits, Plan, Run, RunError, State, Stepper};

/// Default number of changes of each kind.
const DAMAGES: usize = 6000;
/// Limits of a run from a changed state.
const LIMITS: Limits = Limits { steps: 3000, events: 1000, wall: Some(1.0) };
/// Maximum duration of one case, s.
const PATIENCE: u64 = 20;
/// Number of bytes before the words of a state.
const HEAD: usize = 56;

/// A saved state.
struct Saved {
    stage: Arc<Stage>,
    title: String,
    plan: Plan,
    bytes: Vec<u8>,
}

/// Returns states of all examples, with three integrators and both engines.
fn saved() -> Vec<Saved> {
    let mut all = Vec::new();
    for (k, file) in scenarios().iter().enumerate() {
        let base = Stage::of(file, &[]).unwrap();
        let mut rows = vec![("plots".to_owned(), "[]".to_owned())];
        rows.push(("output".to_owned(), r#"{"every":"1 s"}"#.to_owned()));
        let contacts = base.job.scenario.scene.contacts.iter();
        let engine = r#"{"springs":{"count":12}}"#;
        rows.extend(contacts.map(|c| (format!("contacts.{}.engine", c.name), engine.to_owned())));
        for set in [Vec::new(), rows] {
            let stage = Arc::new(Stage::of(file, &set).unwrap());
            let event = Stepper::Event { tolerance: 1e-5 };
            let fixed = [verlet, rk4].into_iter().filter_map(|make| stage.step(0.5, make));
            for stepper in fixed.chain([event]) {
                let duration = stage.job.scenario.plan.duration;
                let plan = Plan { limits: LIMITS, ..stage.plan(stepper, 0.3 * duration) };
                let mut run = Run::new(&stage.job.model, &plan, stage.start(&plan).unwrap()).unwrap();
                // Usually within a leap or a time step.
                let _ = run.advance((0.11 + 0.003 * k as f64) * duration, &mut ());
                let bytes = run.state().to_bytes(&stage.job.model, &stage.key);
                let title = format!("{} {set:?} {stepper:?} at {:e} s", file.display(), run.state().time());
                all.push(Saved { stage: Arc::clone(&stage), title, plan, bytes });
            }
        }
    }
    all
}

/// Returns a word that replaces another one.
fn word(lottery: &mut Lottery, bytes: &[u8], old: u64) -> u64 {
    let random = lottery.bits();
    match lottery.draw(9) {
        0 => random,
        1 => random % 6,
        2 | 3 => old ^ (1 << (random % 64)),
        4 => old.wrapping_add(1).wrapping_sub(2 * (random % 2)),
        5 => (f64::from_bits(old) * [-1.0, 2.0, 1e-3, 1e6][random as usize % 4]).to_bits(),
        6 => {
            let place = HEAD + 8 * (random as usize % (bytes.len().saturating_sub(HEAD) / 8).max(1));
            bytes.get(place..place + 8).map_or(0, |word| u64::from_le_bytes(word.try_into().unwrap()))
        }
        7 => u64::MAX >> (random % 40),
        _ => {
            let odd =
                [f64::NAN, f64::INFINITY, -f64::INFINITY, -0.0, 0.0, 5e-324, 1e-300, 1e300, f64::MAX, -1e300];
            odd[random as usize % odd.len()].to_bits()
        }
    }
}

/// Changes bytes at a random position and returns a description.
fn damage(lottery: &mut Lottery, bytes: &mut Vec<u8>, from: usize) -> String {
    if bytes.len() <= from {
        return "nothing left".to_owned();
    }
    let place = from + lottery.draw(bytes.len() - from);
    let start = place - place % 8;
    match lottery.draw(8) {
        0 => {
            bytes.truncate(place);
            format!("cut at {place}")
        }
        1 => {
            let count = 1 + lottery.draw(24);
            let with = lottery.bits() as u8;
            bytes.splice(place..place, vec![with; count]);
            format!("{count} bytes {with} inserted at {place}")
        }
        2 => {
            let end = (start + 8 * (1 + lottery.draw(4))).min(bytes.len());
            bytes.drain(start..end);
            format!("{start}..{end} left out")
        }
        3 | 4 => {
            let other = from + lottery.draw(bytes.len() - from);
            let other = other - other % 8;
            if start.max(other) + 8 <= bytes.len() {
                (0..8).for_each(|i| bytes.swap(start + i, other + i));
            }
            format!("words at {start} and {other} swapped")
        }
        5 => {
            let bit = lottery.draw(8);
            bytes[place] ^= 1 << bit;
            format!("bit {bit} of {place} flipped")
        }
        _ if start + 8 <= bytes.len() => {
            let old = u64::from_le_bytes(bytes[start..start + 8].try_into().unwrap());
            let new = word(lottery, bytes, old);
            bytes[start..start + 8].copy_from_slice(&new.to_le_bytes());
            format!("{new:#x} at {start}")
        }
        _ => String::new(),
    }
}

/// Corrects the count and the checksum of whole words.
fn repair(bytes: &mut Vec<u8>) {
    bytes.truncate(bytes.len() - bytes.len() % 8);
    bytes.resize(bytes.len().max(HEAD + 8), 0);
    let end = bytes.len() - 8;
    bytes[48..56].copy_from_slice(&((end as u64 - HEAD as u64) / 8).to_le_bytes());
    let sum = u64::from(crc32fast::hash(&bytes[..end]));
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
}

fn damages() -> usize {
    std::env::var("STICKSLIP_DAMAGES").map_or(DAMAGES, |damages| damages.parse().unwrap())
}

/// Returns the kind of an error, or "Ok".
fn kind<T: std::fmt::Debug>(outcome: &Result<(), T>) -> String {
    let told = outcome.as_ref().map_or_else(|error| format!("{error:?}"), |()| "Ok".to_owned());
    told.split(|letter: char| !letter.is_alphabetic()).next().unwrap_or_default().to_owned()
}

#[test]
fn damaged_bytes_are_refused() {
    let (saved, mut lottery, mut kinds) = (saved(), Lottery(0xda_0a6e), BTreeMap::<String, usize>::new());
    for k in 0..damages() {
        let Saved { stage, title, bytes, .. } = &saved[k % saved.len()];
        let mut damaged = bytes.clone();
        let told: Vec<String> =
            (0..=lottery.draw(3)).map(|_| damage(&mut lottery, &mut damaged, 0)).collect();
        if damaged == *bytes || damaged.is_empty() {
            continue;
        }
        let read = || State::from_bytes(&stage.job.model, &stage.key, &damaged).map(drop);
        let read = catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|_| panic!("{title}: {told:?}"));
        assert!(read.is_err(), "{title}: {told:?} is a state");
        *kinds.entry(kind(&read)).or_default() += 1;
    }
    println!("refused: {kinds:?}");
    assert!(kinds.len() >= 4, "{kinds:?}");
}

/// Reads changed bytes and continues the run from an accepted state.
fn run_on(saved: &Saved, bytes: &[u8]) -> Option<Result<(), RunError>> {
    let (model, key) = (&saved.stage.job.model, &saved.stage.key);
    let state = match State::from_bytes(model, key, bytes) {
        Ok(state) => state,
        Err(error) => {
            assert!(matches!(error, BytesError::Unfit), "{error}");
            return None;
        }
    };
    let plan = saved.plan;
    let until = state.time() + 0.1 * plan.duration;
    let mut run = Run::resume(model, &plan, state).unwrap();
    let mut row = Vec::new();
    let outcome = run.advance(until, &mut ()).and_then(|()| run.finish(&mut ()));
    run.row(&mut row);
    // The resulting state can be saved, too.
    let _ = run.state().to_bytes(model, key);
    Some(outcome)
}

/// Ends the program if a case takes too long, and prints it.
fn watchdog() -> Arc<Mutex<(Instant, String)>> {
    let present = Arc::new(Mutex::new((Instant::now(), String::new())));
    let watched = Arc::downgrade(&present);
    std::thread::spawn(move || {
        while let Some(watched) = watched.upgrade() {
            let (began, told) = watched.lock().unwrap().clone();
            if began.elapsed() > Duration::from_secs(PATIENCE) {
                eprintln!("for ever: {told}");
                std::process::abort();
            }
            drop(watched);
            std::thread::sleep(Duration::from_millis(200));
        }
    });
    present
}

#[test]
fn forged_states_are_refused_or_run() {
    let (saved, mut lottery, mut kinds) = (saved(), Lottery(0xf0_46ed), BTreeMap::<String, usize>::new());
    let (present, mut slowest, mut largest, mut faults) = (watchdog(), 0.0_f64, 0, Vec::new());
    for k in 0..damages() {
        let one = &saved[k % saved.len()];
        let mut forged = one.bytes.clone();
        // The words without their checksum.
        forged.truncate(forged.len() - 8);
        let told: Vec<String> =
            (0..=lottery.draw(2)).map(|_| damage(&mut lottery, &mut forged, HEAD)).collect();
        forged.extend([0; 8]);
        repair(&mut forged);
        let told = format!("{}: {told:?}", one.title);
        *present.lock().unwrap() = (Instant::now(), told.clone());
        let (began, mut outcome) = (Instant::now(), Ok(None));
        let info = allocation_counter::measure(|| {
            outcome = catch_unwind(AssertUnwindSafe(|| run_on(one, &forged)));
        });
        slowest = slowest.max(began.elapsed().as_secs_f64());
        largest = largest.max(info.bytes_max);
        match outcome {
            Ok(None) => *kinds.entry("refused".to_owned()).or_default() += 1,
            Ok(Some(outcome)) => *kinds.entry(kind(&outcome)).or_default() += 1,
            Err(_) => faults.push(told),
        }
    }
    println!("forged: {kinds:?}; slowest {slowest:.2} s, largest {largest} bytes");
    faults.iter().for_each(|told| println!("panic: {told}"));
    assert!(faults.is_empty(), "{} panics", faults.len());
    assert!(kinds.get("Ok").is_some_and(|ran| *ran > damages() / 20), "{kinds:?}");
    assert!(largest < 1 << 28, "{largest} bytes");
}
