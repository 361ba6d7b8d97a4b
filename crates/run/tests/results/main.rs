//! Tests of runs and their results: rows, events, summaries, warnings and states, compared with closed forms and other runs.
//!
//! All modules are in one binary. `shared` loads and draws scenarios. Allocations are counted per thread.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod shared;

mod accumulating;
mod allocations;
mod another_process;
mod asked_for;
mod between_rows;
mod ceramic;
mod damaged;
mod damped;
mod definitions;
mod excursions;
mod fed;
mod fields;
mod frames;
mod held;
mod in_memory;
mod kept;
mod last_period;
mod linear;
mod long_rows;
mod loops;
mod methods;
mod odd;
mod piezo;
mod real_time;
mod riding;
mod rows;
mod scales;
mod settling;
mod springs;
mod starts;
mod swings;
mod taken_up;
