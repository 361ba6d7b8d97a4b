//! Tests of studies with many runs: sweeps, curves, periodic orbits, branches and sensitivities, compared with closed
//! forms and simulations.
//!
//! All are in one binary. `five_points` computes differences of runs; every other module is one topic. Allocations are counted by thread.

use std::path::Path;
use stickslip_run::{Job, Refusal};

/// Returns the job of a file with overrides.
fn prepared(file: &Path, set: &[(String, String)]) -> Result<Job, Refusal> {
    Job::prepare(file, set, Path::new(""))
}

mod five_points;

mod branch_ends;
mod continuation;
mod curve;
mod differences;
mod drawn_scenes;
mod harmonic_balance;
mod holding;
mod landmarks;
mod map;
mod noisy_table;
mod optimise;
mod outlook;
mod page;
mod passing_grip;
mod sensitivity;
mod shakedown;
mod steady;
mod sweep;
mod variants;
mod vibrating_table;
