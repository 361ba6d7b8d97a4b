//! The work of frames, counted: the median frame and the worst of many, and both alone again for a profiler.
//!
//! `cargo run --release -p stickslip-results --example worst_frame -- scenarios/p1.json 20e-6 10000000`
//! `valgrind --tool=callgrind --toggle-collect='worst_frame::worst' target/release/examples/worst_frame …` counts the
//! instructions of the worst frame, `worst_frame::median` those of a frame of median work.
#![allow(clippy::print_stdout, reason = "an example shows what comes out")]

use std::error::Error;
use std::path::Path;
use stickslip_drive::{Plan, Run, RunError, Stepper};
use stickslip_results::Job;

/// What of a run a frame's work is counted in.
fn counted(run: &Run<'_>) -> [u64; 2] {
    [run.state().counts().evaluations, run.touched()]
}

/// One frame from a state; what is collected by a profiler.
#[inline(never)]
fn worst(run: &mut Run<'_>, until: f64) -> Result<(), RunError> {
    run.advance(until, &mut ())
}

/// The same under another name.
#[inline(never)]
fn median(run: &mut Run<'_>, until: f64) -> Result<(), RunError> {
    run.advance(until, &mut ())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, file, length, frames, ..] = &arguments[..] else {
        return Err("worst_frame FILE LENGTH_S FRAMES [PATH VALUE]…".into());
    };
    let set: Vec<_> = arguments[4..].chunks_exact(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect();
    let (length, frames): (f64, u64) = (length.parse()?, frames.parse()?);
    let job = Job::prepare(Path::new(file), &set, Path::new(""))?;
    let stepper = Stepper::Frames { length, accuracy: 1e-3 };
    let plan = Plan { stepper, every: None, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.model.start(&plan)?)?;
    let (mut before, mut most) = (counted(&run), 0);
    // By evaluations and turning points, each at about its price.
    let mut works = vec![0_u64; 4096];
    for k in 0..frames {
        run.advance((k + 1) as f64 * length, &mut ())?;
        let now = counted(&run);
        let work = (now[0] - before[0]) + 2 * (now[1] - before[1]);
        works[(work as usize).min(4095)] += 1;
        most = most.max(work);
        before = now;
    }
    let middle = works
        .iter()
        .scan(0, |sum, n| {
            *sum += n;
            Some(*sum)
        })
        .position(|sum| 2 * sum >= frames);
    println!(
        "{frames} frames: median work {middle:?}, worst {most} (evaluations and twice the turning points)"
    );
    replay(&job, &plan, length, (middle.unwrap_or(0) as u64, most), frames)
}

/// Looks for the first frames of these works, and takes them again alone.
fn replay(job: &Job, plan: &Plan, length: f64, works: (u64, u64), frames: u64) -> Result<(), Box<dyn Error>> {
    let mut run = Run::new(&job.model, plan, job.model.start(plan)?)?;
    let mut before = counted(&run);
    let (mut seen_median, mut seen_worst) = (false, false);
    for k in 0..frames {
        let (start, until) = (run.state().clone(), (k + 1) as f64 * length);
        run.advance(until, &mut ())?;
        let now = counted(&run);
        let work = (now[0] - before[0]) + 2 * (now[1] - before[1]);
        before = now;
        let again = || -> Result<Run<'_>, RunError> {
            let mut again = Run::resume(&job.model, plan, start.clone())?;
            again.advance(start.time(), &mut ())?;
            Ok(again)
        };
        // Later than the first frames, in which nothing is warm.
        if work == works.0 && !seen_median && k > 100 {
            median(&mut again()?, until)?;
            println!("frame {k}: the median work");
            seen_median = true;
        }
        if work == works.1 && !seen_worst {
            worst(&mut again()?, until)?;
            println!("frame {k}: the worst");
            seen_worst = true;
        }
        if seen_median && seen_worst {
            return Ok(());
        }
    }
    Ok(())
}
