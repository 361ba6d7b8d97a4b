//! Behaviour of the whole program: what it writes, says and answers.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking, as the tests do")]

mod back_step;
mod broken_files;
mod characterise;
mod check;
mod checkpoint;
mod checkpoint_endings;
mod checkpoint_refusals;
mod compare;
mod contact;
mod damaged_results;
mod definitions;
mod endings;
mod golden;
mod guide;
mod info;
mod info_tables;
mod insides;
mod measured_loops;
mod new;
mod output;
mod pictures;
mod planar;
mod program;
mod publishing;
mod realtime;
mod realtime_endings;
mod refusals;
mod repro;
mod reproducibility;
mod results;
mod scenarios;
mod sensitivity;
mod steady;
mod strangers;
mod warnings;
