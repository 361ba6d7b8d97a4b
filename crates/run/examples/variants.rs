//! Runs a hundred variants of the quickstart in memory and prints a table of step length versus stroke.
//!
//! `cargo run --release -p stickslip-run --example variants`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use stickslip_run::{Job, Summary};
use stickslip_scenario::Scenario;

const QUICKSTART: &str = include_str!("../../../scenarios/quickstart.json");
const VARIANTS: u32 = 100;

/// Returns the quickstart with another stroke, ready to run.
fn variant(number: u32) -> Result<Job, Box<dyn Error>> {
    let stroke = format!("{} nm", 50 + 10 * number);
    let overrides = [("waveforms.drive.sawtooth.stroke", stroke.as_str()), ("plots", "[]")];
    let scenario = Scenario::from_str_with(QUICKSTART, "quickstart", "", &overrides)?;
    Ok(Job::new(scenario, stroke, "".into())?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let jobs = (0..VARIANTS).map(variant).collect::<Result<Vec<_>, _>>()?;
    println!("{:>8} {:>11} {:>8} {:>8}", "stroke", "step", "events", "rows");
    for (number, job) in jobs.iter().enumerate() {
        let outcome = job.run(&());
        let summary = Summary::new(job, &outcome);
        let steady = summary.steps.and_then(|steps| steps.steady);
        let step = steady.map_or("not settled".to_owned(), |steady| format!("{:.1} nm", 1e9 * steady.step.0));
        if number % 10 == 0 {
            let (events, rows) = (outcome.state.counts().events, outcome.rows);
            println!("{:>8} {step:>11} {events:>8} {rows:>8}", job.name);
        }
    }
    Ok(())
}
