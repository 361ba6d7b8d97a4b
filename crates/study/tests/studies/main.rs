//! Studies of many runs: batches, curves, steady motions, branches and derivatives, against closed forms and plain runs.
//!
//! One binary, linked once. `five_points` takes differences of runs; every other module is a subject. Allocations are counted by
//! thread.

use std::path::Path;
use stickslip_run::{Job, Refusal};

/// A job of a file with overrides.
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
