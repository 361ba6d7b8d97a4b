//! Measures time integration alone, without reading files and writing rows, for use under a profiler. The file `.ci/instructions.csv`
//! records the instructions of whole runs.
//!
//! `instructions NAME KEY=VALUE…` runs one benchmark, or the scenario of a file, with keys replaced. The benchmark prints counts and run
//! time. Example: `valgrind --tool=callgrind --toggle-collect='*measured*' BINARY p1 run.cycles=200`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use stickslip_drive::{Model, Plan, State, run};
use stickslip_scenario::Scenario;

/// Key and value of a replaced value.
type Setting = (&'static str, &'static str);

/// Benchmarks: name, scenario, and replaced values.
const BENCHMARKS: [(&str, &str, &[Setting]); 7] = [
    ("p1", "p1", &[("run.stepper.event.tolerance", "1e-4"), ("run.cycles", "200")]),
    ("p1-fine", "p1", &[("run.stepper.event.tolerance", "1e-8"), ("run.cycles", "200")]),
    ("ruby", "ruby_drive", &[("run.stepper.event.tolerance", "1e-6")]),
    ("stage", "three_ball_stage", &[("run.stepper.event.tolerance", "1e-6")]),
    ("ball", "bouncing_ball", &[("run.stepper.event.tolerance", "1e-6")]),
    ("impact", "oblique_impact", &[("run.stepper.event.tolerance", "1e-6")]),
    ("vibration", "vibrated_slider", &[("run.stepper.event.tolerance", "1e-6")]),
];

#[inline(never)]
fn measured(model: &Model, plan: &Plan, state: &mut State) {
    run(model, plan, state, &mut ()).unwrap();
}

/// Runs one scenario and prints counts and run time.
fn benchmark(name: &str, file: &str, set: &[(&str, &str)]) {
    let mut scenario = Scenario::load_with(file, set).unwrap();
    scenario.plan.every = None;
    let model = Model::new(&scenario.scene).unwrap();
    let mut state = model.start(&scenario.plan).unwrap();
    let begun = std::time::Instant::now();
    measured(&model, &scenario.plan, &mut state);
    let took = begun.elapsed().as_secs_f64();
    let counts = state.counts();
    println!(
        "{name}: {} evaluations, {} steps, {} rejected, {} events, {:.3} ms, ends at {:?}",
        counts.evaluations,
        counts.steps,
        counts.rejected,
        counts.events,
        1e3 * took,
        (0..3).filter_map(|body| state.body(&model, body)).map(|(x, _)| x).collect::<Vec<_>>(),
    );
}

fn main() {
    // Cargo's own arguments begin with dashes.
    let mut asked = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let name = asked.next();
    let sets: Vec<(String, String)> =
        asked.filter_map(|set| set.split_once('=').map(|(a, b)| (a.to_owned(), b.to_owned()))).collect();
    let sets: Vec<(&str, &str)> = sets.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    if let Some(file) = name.as_deref().filter(|name| name.ends_with(".json")) {
        return benchmark(file, file, &sets);
    }
    for (known, file, set) in BENCHMARKS {
        if name.as_deref().is_none_or(|name| name == known) {
            let file = format!("{}/../../scenarios/{file}.json", env!("CARGO_MANIFEST_DIR"));
            benchmark(known, &file, &[set, &sets].concat());
        }
    }
}
