//! Saves a run as bytes and restores it: the second half continues from a file with identical results.
//!
//! `cargo run --release -p stickslip-run --example save_and_restore`
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::Path;
use stickslip_drive::{Run, State};
use stickslip_run::Job;
use stickslip_run::checkpoint::model_key;

fn main() -> Result<(), Box<dyn Error>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
    let job = Job::prepare(&file, &[], Path::new(""))?;
    let plan = &job.scenario.plan;
    let key = model_key(&job.scenario);

    let mut first = Run::new(&job.model, plan, job.start.clone())?;
    first.advance(0.5 * plan.duration, &mut ())?;
    let saved = std::env::temp_dir().join("stickslip-example.state");
    std::fs::write(&saved, first.state().to_bytes(&job.model, &key))?;

    // Later, in another process: the same scenario and the bytes.
    let bytes = std::fs::read(&saved)?;
    let state = State::from_bytes(&job.model, &key, &bytes)?;
    let mut second = Run::resume(&job.model, plan, state)?;

    first.finish(&mut ())?;
    second.finish(&mut ())?;
    let same = first.state() == second.state();
    println!("{} bytes at half time; the same to the last bit: {same}", bytes.len());
    std::fs::remove_file(&saved)?;
    if same { Ok(()) } else { Err("two runs of one state differ".into()) }
}
