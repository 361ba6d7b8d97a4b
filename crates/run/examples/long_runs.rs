//! Runs scenarios over many periods and checks whether the last tenth takes as long as the first one.
//!
//! `cargo run --release -p stickslip-run --example long_runs -- 10000 [FILE…]`. Without files, all examples with a number of cycles run.
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;
use stickslip_drive::Run;
use stickslip_run::Job;

/// Number of parts of a run that are timed separately.
const PARTS: u32 = 10;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let cycles: u32 = arguments.next().map_or(Ok(1000), |n| n.parse())?;
    let mut files: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    if files.is_empty() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
        files = std::fs::read_dir(folder)?.map(|entry| entry.map(|e| e.path())).collect::<Result<_, _>>()?;
        files.retain(|file| std::fs::read_to_string(file).is_ok_and(|text| text.contains("\"cycles\"")));
        files.sort();
    }
    println!(
        "{:20} {:>9} {:>9} {:>9} {:>9} {:>7}  end",
        "", "µs/period", "first", "last", "events", "detours"
    );
    for file in files {
        go(&file, cycles)?;
    }
    Ok(())
}

/// Runs one scenario in parts.
fn go(file: &Path, cycles: u32) -> Result<(), Box<dyn Error>> {
    let set = [("run.cycles".to_owned(), cycles.to_string()), ("output.every".to_owned(), "1e3".to_owned())];
    let job = Job::prepare(file, &set, Path::new(""))?;
    let plan = job.scenario.plan;
    let mut run = Run::new(&job.model, &plan, job.start.clone())?;
    let mut spent = Vec::new();
    let mut outcome = Ok(());
    for part in 1..=PARTS {
        let begun = Instant::now();
        outcome = match part {
            PARTS => run.finish(&mut ()),
            _ => run.advance(plan.duration * f64::from(part) / f64::from(PARTS), &mut ()),
        };
        spent.push(1e6 * begun.elapsed().as_secs_f64() * f64::from(PARTS) / f64::from(cycles));
        if outcome.is_err() {
            break;
        }
    }
    let (first, last) = (spent[0], spent[spent.len() - 1]);
    let mean = spent.iter().sum::<f64>() / f64::from(PARTS);
    let counts = run.state().counts();
    let end = outcome.map_or_else(|error| error.to_string(), |()| format!("{:.4} s", run.state().time()));
    println!(
        "{:20} {mean:9.1} {first:9.1} {last:9.1} {:9} {:7}  {end}",
        job.name, counts.events, counts.detours
    );
    Ok(())
}
