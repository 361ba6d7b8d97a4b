//! An input that follows a table of times and values, as an oscilloscope or a controller writes it.
//!
//! `cargo run --release -p stickslip-run --example fed_from_table`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::Path;
use stickslip_drive::Run;
use stickslip_run::Job;

/// Times in ms, displacements of the foot in nm.
const TABLE: &str = "\
9.99   200
10.00  0
14.00  80
19.99  200
20.00  0
30.00  150
30.02  0
40.00  0";

fn main() -> Result<(), Box<dyn Error>> {
    let input = r#"{"input": {"initial": 0, "range": [0, "250 nm"], "interpolation": "linear"}}"#;
    let set = [("waveforms.drive".to_owned(), input.to_owned())];
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/quickstart.json");
    let job = Job::prepare(&file, &set, Path::new(""))?;
    let mut run = Run::new(&job.model, &job.scenario.plan, job.start.clone())?;
    for line in TABLE.lines() {
        let mut numbers = line.split_whitespace().map(str::parse::<f64>);
        let (Some(time), Some(value)) = (numbers.next(), numbers.next()) else { continue };
        let (until, value) = (1e-3 * time?, 1e-9 * value?);
        run.lead(0, until, value)?;
        run.advance(until, &mut ())?;
        let (x, _) = run.state().body(&job.model, 1).ok_or("no such body")?;
        println!("{:6.2} ms  foot {:6.1} nm  slider {:7.2} nm", 1e3 * until, 1e9 * value, 1e9 * x);
    }
    Ok(())
}
