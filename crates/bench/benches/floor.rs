//! Runs the benchmark drive by the program and by the minimal code, under a profiler.
//!
//! `floor NODES PERIODS` runs the minimal code with 4, 10, 16 or 32 nodes. `floor TOLERANCE PERIODS` runs the event stepper with a
//! recorder that discards everything. Example: `valgrind --tool=callgrind --toggle-collect='*measured*' BINARY 1e-6 200`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark prints, and fails by panicking")]

use stickslip_bench::floor::{Floor, Rule};
use stickslip_drive::{Model, Plan, State, run};
use stickslip_scenario::Scenario;

const P1: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/p1.json");

#[inline(never)]
fn measured_floor<const N: usize>(floor: &Floor, periods: u32, rule: &Rule<N>) -> f64 {
    floor.place(periods, rule)
}

#[inline(never)]
fn measured_run(model: &Model, plan: &Plan, state: &mut State) {
    run(model, plan, state, &mut ()).unwrap();
}

/// Returns the position of the slider by the event stepper, m.
fn stepped(tolerance: &str, periods: u32) -> f64 {
    let cycles = periods.to_string();
    let set = [("run.stepper.event.tolerance", tolerance), ("run.cycles", cycles.as_str())];
    let mut scenario = Scenario::load_with(P1, &set).unwrap();
    scenario.plan.every = None;
    let model = Model::new(&scenario.scene).unwrap();
    let mut state = model.start(&scenario.plan).unwrap();
    measured_run(&model, &scenario.plan, &mut state);
    state.body(&model, 1).unwrap().0
}

fn main() {
    // Cargo's own arguments begin with dashes.
    let asked: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let way = asked.first().map_or("1e-6", String::as_str);
    let periods = asked.get(1).map_or(200, |periods| periods.parse().unwrap());
    let floor = Floor::p1();
    let place = match way {
        "4" => measured_floor(&floor, periods, &Rule::<4>::default()),
        "10" => measured_floor(&floor, periods, &Rule::<10>::default()),
        "16" => measured_floor(&floor, periods, &Rule::<16>::default()),
        "32" => measured_floor(&floor, periods, &Rule::<32>::default()),
        tolerance => stepped(tolerance, periods),
    };
    println!("{way}: {place:e} m after {periods} periods");
}
