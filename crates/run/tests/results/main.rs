//! Runs of scenarios and what they leave behind: rows, events, figures, warnings and states, against closed forms and other runs.
//!
//! One binary, linked once. `shared` loads and draws scenes; every other module is a subject. Allocations are counted by thread.

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
