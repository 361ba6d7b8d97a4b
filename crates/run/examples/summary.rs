//! Runs a scenario in memory and prints its summary, without values about files and wall time.
//!
//! `cargo run --release -p stickslip-run --example summary -- scenarios/p1.json`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use serde_json::Value;
use std::error::Error;
use std::path::Path;
use stickslip_run::Job;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("expected the file of a scenario")?;
    let job = Job::prepare(Path::new(&file), &[], Path::new(""))?;
    let outcome = job.run(&());
    let (summary, _) = stickslip_study::summary(&job, &outcome, &|| true);
    let mut report: Value = serde_json::from_str(&summary.pretty()?)?;
    if let Value::Object(report) = &mut report {
        report.retain(|key, _| !["timing", "files", "tables"].contains(&key.as_str()));
    }
    println!("{}", serde_json::to_string_pretty(&report)?);
    Ok(())
}
