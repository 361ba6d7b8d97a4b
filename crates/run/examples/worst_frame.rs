//! Counts the work of frames and repeats the median or the worst frame alone, for a profiler.
//!
//! `cargo run --release -p stickslip-run --example worst_frame -- worst scenarios/p1.json 20e-6 10000000` `valgrind --tool=callgrind
//! --toggle-collect='worst_frame::again' target/release/examples/worst_frame worst …` counts the instructions of the worst frame. With
//! `median` instead of `worst`, it counts those of a frame of median work.
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::Path;
use stickslip_drive::{Plan, Run, RunError, Stepper};
use stickslip_run::Job;

/// Returns the counted work of a run: evaluations, and knots of the slip memories that were added or removed.
fn counted(run: &Run<'_>) -> [u64; 2] {
    [run.state().counts().evaluations, run.touched()]
}

/// Returns the work of a frame, weighted by approximate cost, from the counts before and after it.
fn work(before: [u64; 2], now: [u64; 2]) -> u64 {
    (now[0] - before[0]) + 2 * (now[1] - before[1])
}

/// Advances one frame, which a profiler measures.
#[inline(never)]
fn again(run: &mut Run<'_>, until: f64) -> Result<(), RunError> {
    run.advance(until, &mut ())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, which, file, length, frames, ..] = &arguments[..] else {
        return Err("worst_frame worst|median FILE LENGTH_S FRAMES [PATH VALUE]…".into());
    };
    let set: Vec<_> = arguments[5..].chunks_exact(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect();
    let (length, frames): (f64, u64) = (length.parse()?, frames.parse()?);
    let job = Job::prepare(Path::new(file), &set, Path::new(""))?;
    let stepper = Stepper::Frames { length, accuracy: 1e-3 };
    let plan = Plan { stepper, every: None, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.model.start(&plan)?)?;
    let mut before = counted(&run);
    let mut works = vec![0_u64; 4096];
    for k in 0..frames {
        run.advance((k + 1) as f64 * length, &mut ())?;
        let now = counted(&run);
        works[(work(before, now) as usize).min(4095)] += 1;
        before = now;
    }
    let seen = |part: u64| {
        works
            .iter()
            .scan(0, |sum, n| {
                Some({
                    *sum += n;
                    *sum
                })
            })
            .position(|sum| sum >= part)
    };
    let [median, worst] = [frames / 2, frames].map(|part| seen(part).unwrap_or(0) as u64);
    println!(
        "{frames} frames: median work {median}, worst {worst} (evaluations and twice the turning points)"
    );
    replay(&job, &plan, length, if which == "worst" { worst } else { median }, frames)
}

/// Finds the first frame with this work and repeats it alone.
fn replay(job: &Job, plan: &Plan, length: f64, asked: u64, frames: u64) -> Result<(), Box<dyn Error>> {
    let mut run = Run::new(&job.model, plan, job.model.start(plan)?)?;
    let mut before = counted(&run);
    for k in 0..frames {
        let (start, until) = (run.state().clone(), (k + 1) as f64 * length);
        run.advance(until, &mut ())?;
        let now = counted(&run);
        // The first frames are skipped, because caches are cold.
        if work(before, now) == asked && k > 20 {
            let mut alone = Run::resume(&job.model, plan, start.clone())?;
            alone.advance(start.time(), &mut ())?;
            again(&mut alone, until)?;
            println!("taken again: frame {k}");
            return Ok(());
        }
        before = now;
    }
    Err(format!("no frame after the 21st has a work of {asked} (4095 stands for all from there on)").into())
}
