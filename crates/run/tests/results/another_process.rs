//! A run that is saved and continued in another process gives identical states, rows, events and errors.
//!
//! Random variants of the examples are saved at random times, in frames or between time steps, with all supported integrators. They are
//! compared with uninterrupted runs. The other process is this program, started again. It reads only the scenario and the bytes from files.
//! `STICKSLIP_PAIRS` is the number of pairs.

use crate::shared::{Lottery, Stage, drawn, example, frames, rk4, scenarios, verlet};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use stickslip_drive::{Limits, Method, Plan, Run, RunError, State, Stepper, Trace};
use stickslip_scenario::Scenario;

/// Environment variable with the folder of the saved runs. The other process needs it.
const FOLDER: &str = "STICKSLIP_PUT_DOWN";
/// Default number of pairs of a scenario and a time.
const PAIRS: usize = 300;
/// Latest time of saving, and longest continuation, relative to the duration of the scenario.
const LATEST: f64 = 0.2;
const BEYOND: f64 = 0.1;
/// Limits of a run. Reaching them is no failure.
const LIMITS: Limits = Limits { steps: 20_000, events: 5_000, wall: None };

/// Data for the other process, in addition to the bytes.
#[derive(Debug, Serialize, Deserialize)]
struct Pair {
    file: String,
    set: Vec<(String, String)>,
    stepper: String,
    accuracy: f64,
    end: f64,
}

impl Pair {
    fn stage(&self) -> Option<Stage> {
        Stage::of(&example(&self.file), &self.set)
    }

    fn plan(&self, stage: &Stage) -> Plan {
        let stepper = match self.stepper.as_str() {
            "event" => Stepper::Event { tolerance: self.accuracy },
            "verlet" => verlet(self.accuracy),
            "frames" => frames(self.accuracy),
            _ => rk4(self.accuracy),
        };
        Plan { limits: LIMITS, ..stage.plan(stepper, self.end) }
    }
}

/// Returns the results of a run: its error, its state, and its rows and events after given numbers of them.
fn told(
    outcome: &Result<(), RunError>,
    bytes: &[u8],
    trace: &Trace,
    (rows, events): (usize, usize),
) -> Vec<u8> {
    let mut told = format!("{outcome:?}\n").into_bytes();
    told.extend(bytes);
    for row in trace.rows().skip(rows) {
        told.extend(row.iter().flat_map(|value| value.to_le_bytes()));
    }
    for (event, after) in trace.events().skip(events) {
        told.extend(format!("{event:?}\n").into_bytes());
        told.extend(after.iter().flat_map(|value| value.to_le_bytes()));
    }
    told
}

/// A saved run with the results of its uninterrupted continuation.
struct PutDown {
    state: State,
    comes_to: Vec<u8>,
}

/// Saves a run at a random time after several calls of `advance`.
fn at_a_moment(stage: &Stage, plan: &Plan, lottery: &mut Lottery) -> Option<PutDown> {
    let model = &stage.job.model;
    let mut run = Run::new(model, plan, stage.start(plan)?).ok()?;
    let moment = plan.duration * LATEST / (LATEST + BEYOND) * lottery.share();
    let frames = 1 + lottery.draw(4);
    for k in 1..=frames {
        run.advance(moment * k as f64 / frames as f64, &mut ()).ok()?;
    }
    let (state, mut trace) = (run.state().clone(), Trace::new(model));
    let outcome = run.finish(&mut trace);
    let bytes = run.state().to_bytes(model, &stage.key);
    Some(PutDown { state, comes_to: told(&outcome, &bytes, &trace, (0, 0)) })
}

/// Saves a run between two time steps, accepted or rejected.
fn after_steps(stage: &Stage, plan: &Plan, lottery: &mut Lottery) -> Option<PutDown> {
    let (model, start) = (&stage.job.model, stage.start(plan)?);
    let mut whole = Run::new(model, plan, start.clone()).ok()?;
    let mut trace = Trace::new(model);
    let outcome = whole.finish(&mut trace);
    let tries = whole.state().counts().steps + whole.state().counts().rejected;
    let steps = 1 + lottery.draw(usize::try_from(tries.max(2)).ok()? - 1) as u64;
    let short = Plan { limits: Limits { steps, ..LIMITS }, ..*plan };
    let mut first = Run::new(model, &short, start).ok()?;
    let mut before = Trace::new(model);
    if !matches!(first.approach(&mut before), Err(RunError::TooManySteps { .. })) {
        return None;
    }
    let written = (before.rows().len(), before.events().len());
    let bytes = whole.state().to_bytes(model, &stage.key);
    Some(PutDown { state: first.into_state(), comes_to: told(&outcome, &bytes, &trace, written) })
}

/// Returns a random variant of an example. Returns `None` if it is invalid.
fn draw(files: &[std::path::PathBuf], lottery: &mut Lottery) -> Option<(Pair, Stage)> {
    let file = &files[lottery.draw(files.len())];
    let base = Scenario::load(file).unwrap();
    let mut set = if lottery.draw(2) == 0 { Vec::new() } else { drawn(&base, lottery) };
    if lottery.draw(3) == 0 {
        // Spring rows have no memory curve to write or draw.
        set.extend(
            [("plots", "[]"), ("output", r#"{"every":"1 s"}"#)].map(|(k, v)| (k.to_owned(), v.to_owned())),
        );
        let engine = format!(r#"{{"springs":{{"count":{}}}}}"#, 8 << lottery.draw(4));
        let contacts = base.scene.contacts.iter();
        set.extend(contacts.map(|contact| (format!("contacts.{}.engine", contact.name), engine.clone())));
    }
    let file = file.file_name()?.to_str()?.to_owned();
    let end = (LATEST + BEYOND) * base.plan.duration;
    let mut pair = Pair { file, set, stepper: "event".to_owned(), accuracy: 1e-9, end };
    let stage = pair.stage()?;
    let share = 0.2 + 0.7 * lottery.share();
    let event = Stepper::Event { tolerance: 10_f64.powf(-3.0 - 8.0 * lottery.share()) };
    let stepper = match lottery.draw(5) {
        4 => frames(2e-4 * base.plan.duration * share),
        0 => stage.step(share, verlet).unwrap_or(event),
        1 => stage.step(share, rk4).unwrap_or(event),
        _ => event,
    };
    pair.stepper = stepper.name().to_owned();
    pair.accuracy = match stepper {
        Stepper::Verlet { step } | Stepper::Rk4 { step } => step,
        Stepper::Frames { length, .. } => length,
        Stepper::Event { tolerance } | Stepper::Dopri5 { tolerance } => tolerance,
    };
    Some((pair, stage))
}

/// Counts the kinds of states that occurred.
fn count(kinds: &mut BTreeMap<String, usize>, pair: &Pair, stage: &Stage, state: &State) {
    // The internal state is read here for the test only.
    let inside = format!("{state:?}");
    let contacts = || stage.job.scenario.scene.contacts.iter().map(|contact| &contact.part);
    let walks = state.tally().steps(Method::Walk) > 0;
    let is = [
        ("in a leap", inside.contains("leap: Some")),
        ("growing", inside.contains("Law(Grow)")),
        ("walking", walks),
        ("engine: springs", stage.has_rows()),
        ("engine: curve", !stage.has_rows()),
        ("damped contacts", contacts().any(|contact| contact.interface.damping() > 0.0)),
        ("no event counted yet", state.counts().events == 0),
        ("a rejected step behind", inside.contains("rejected: Some")),
    ];
    let names = is.iter().filter(|(_, is)| *is).map(|(name, _)| (*name).to_owned());
    let stepper = format!("stepper: {}", if walks { "event" } else { pair.stepper.as_str() });
    for name in names.chain([stepper, format!("example: {}", pair.file)]) {
        *kinds.entry(name).or_default() += 1;
    }
}

#[test]
fn another_process_comes_to_the_same_bits() {
    let pairs = std::env::var("STICKSLIP_PAIRS").map_or(PAIRS, |pairs| pairs.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    // After a change of the examples, use a seed that gives enough states of every required kind.
    let (files, mut lottery, mut kinds) = (scenarios(), Lottery(0x02e4_0e60), BTreeMap::new());
    let (mut comes_to, mut told_of, began) = (Vec::new(), Vec::new(), Instant::now());
    while comes_to.len() < pairs {
        let Some((pair, stage)) = draw(&files, &mut lottery) else { continue };
        let plan = pair.plan(&stage);
        let stand = if lottery.draw(2) == 0 { at_a_moment } else { after_steps };
        let Some(put_down) = stand(&stage, &plan, &mut lottery) else { continue };
        let place = folder.path().join(comes_to.len().to_string());
        let bytes = put_down.state.to_bytes(&stage.job.model, &stage.key);
        std::fs::write(place.with_extension("state"), bytes).unwrap();
        std::fs::write(place.with_extension("json"), serde_json::to_vec(&pair).unwrap()).unwrap();
        count(&mut kinds, &pair, &stage, &put_down.state);
        comes_to.push(put_down.comes_to);
        told_of.push(format!("{pair:?} at {:e} s", put_down.state.time()));
    }
    let here = began.elapsed().as_secs_f64();
    let mut command = Command::new(std::env::current_exe().unwrap());
    let command = command
        .args(["--exact", "another_process::the_other_process", "--nocapture"])
        .env(FOLDER, folder.path());
    let other = command.output().unwrap();
    assert!(other.status.success(), "{}", String::from_utf8_lossy(&other.stderr));
    for (k, comes_to) in comes_to.iter().enumerate() {
        let got = std::fs::read(folder.path().join(format!("{k}.end"))).unwrap();
        let (first, lengths) =
            (got.iter().zip(comes_to).position(|(a, b)| a != b), (got.len(), comes_to.len()));
        assert!(&got == comes_to, "{}: of {lengths:?} bytes {first:?} is the first other one", told_of[k]);
    }
    println!("{pairs} pairs, {here:.1} s here, {:.1} s in all", began.elapsed().as_secs_f64());
    kinds.iter().for_each(|(kind, count)| println!("  {count:6} {kind}"));
    let few = pairs / 50;
    for kind in [
        "in a leap",
        "growing",
        "walking",
        "engine: springs",
        "damped contacts",
        "stepper: rk4",
        "stepper: frames",
    ] {
        assert!(kinds.get(kind).is_some_and(|count| *count >= few), "{kind}: {kinds:?}");
    }
}

/// The other process: continues the saved runs.
#[test]
fn the_other_process() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    for k in 0.. {
        let place = Path::new(&folder).join(k.to_string());
        let Ok(pair) = std::fs::read(place.with_extension("json")) else { return };
        let pair: Pair = serde_json::from_slice(&pair).unwrap();
        let stage = pair.stage().unwrap();
        let (model, plan) = (&stage.job.model, pair.plan(&stage));
        let bytes = std::fs::read(place.with_extension("state")).unwrap();
        let state = State::from_bytes(model, &stage.key, &bytes).unwrap_or_else(|e| panic!("{e}: {pair:?}"));
        assert!(state.to_bytes(model, &stage.key) == bytes, "{pair:?}");
        let (mut run, mut trace) = (Run::resume(model, &plan, state).unwrap(), Trace::new(model));
        let outcome = run.finish(&mut trace);
        let end = told(&outcome, &run.state().to_bytes(model, &stage.key), &trace, (0, 0));
        std::fs::write(place.with_extension("end"), end).unwrap();
    }
}

/// Size and cost of saving and restoring. Each number takes eight bytes. Of a spring row, only touching springs are stored.
#[test]
fn a_state_is_small_and_quickly_saved() {
    let row = [("contacts.ball.engine", r#"{"springs":{"count":1000}}"#), ("plots", "[]")];
    let row = row.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec();
    let drives = [
        ("p1.json", Vec::new(), 1_100),
        ("three_ball_stage.json", Vec::new(), 5_000),
        ("p1.json", row, 8_900),
    ];
    for (file, set, most) in drives {
        let stage = Stage::of(&example(file), &set).unwrap();
        let (model, key, plan) = (&stage.job.model, &stage.key, stage.job.scenario.plan);
        let mut run = Run::new(model, &plan, stage.start(&plan).unwrap()).unwrap();
        run.advance(0.37 * plan.duration, &mut ()).unwrap();
        let (state, rounds) = (run.into_state(), 2000);
        let bytes = state.to_bytes(model, key);
        let began = Instant::now();
        let saved: usize = (0..rounds).map(|_| state.to_bytes(model, key).len()).sum();
        let save = began.elapsed().as_secs_f64() / f64::from(rounds);
        let began = Instant::now();
        let same = (0..rounds).filter(|_| State::from_bytes(model, key, &bytes).unwrap() == state).count();
        let restore = began.elapsed().as_secs_f64() / f64::from(rounds);
        println!(
            "{file} {set:?}: {} bytes, saved in {:.2} us, restored in {:.2} us",
            bytes.len(),
            1e6 * save,
            1e6 * restore
        );
        assert_eq!((saved, same), (rounds as usize * bytes.len(), rounds as usize));
        assert!(bytes.len() <= most, "{file} {set:?}: {} bytes", bytes.len());
    }
}
