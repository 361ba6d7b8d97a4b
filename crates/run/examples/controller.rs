//! A position controller: it reads the position of the slider and chooses the next stroke until the target is reached.
//!
//! `cargo run --release -p stickslip-run --example controller`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::Path;
use stickslip_drive::Run;
use stickslip_run::Job;

/// Target position, m.
const TARGET: f64 = 1e-6;
/// Period and flyback of a stroke, s.
const PERIOD: f64 = 10e-3;
const FLYBACK: f64 = 10e-6;
/// Maximum stroke, m.
const LONGEST: f64 = 300e-9;

fn main() -> Result<(), Box<dyn Error>> {
    // The sawtooth of the example becomes an input, which this loop sets.
    let input = r#"{"input": {"initial": 0, "range": ["-300 nm", "300 nm"], "interpolation": "linear"}}"#;
    let set = [("waveforms.drive", input), ("run.duration", "1 s")];
    let set = set.map(|(path, value)| (path.to_owned(), value.to_owned()));
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/quickstart.json");
    let job = Job::prepare(&file, &set, Path::new(""))?;
    let (drive, slider) = (0, 1);
    let mut run = Run::new(&job.model, &job.scenario.plan, job.start.clone())?;
    // The part of a stroke that the contact springs take up. The controller learns it.
    let mut lost = 0.0;
    for step in 0..50 {
        let start = f64::from(step) * PERIOD;
        let (x, _) = run.state().body(&job.model, slider).ok_or("no such body")?;
        println!("{:4.0} ms  {:7.2} nm", 1e3 * start, 1e9 * x);
        let left = TARGET - x;
        if left.abs() < 1e-9 {
            return Ok(());
        }
        lost += 0.5 * left.clamp(-20e-9, 20e-9);
        let stroke = (left + lost).clamp(-LONGEST, LONGEST);
        for (until, value) in [(start + PERIOD - FLYBACK, stroke), (start + PERIOD, 0.0)] {
            run.lead(drive, until, value)?;
            run.advance(until, &mut ())?;
        }
    }
    Err("the slider did not arrive".into())
}
