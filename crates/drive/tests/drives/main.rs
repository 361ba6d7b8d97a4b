//! Tests of whole drives: comparison with references, closed forms and independent methods.
//!
//! All tests are one binary. `parts` builds and runs models; every other module is a subject.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod parts;

mod abuse;
mod balanced;
mod balanced_bodies;
mod benchmark_drive;
mod breaking;
mod chains;
mod closed_forms;
mod contact_damping;
mod coupled_books;
mod endurance;
mod energy_books;
mod far_travel;
mod fed;
mod few_stages;
mod generated;
mod held;
mod impact;
mod invariance;
mod lag;
mod limits_of_rest;
mod linearised;
mod looks;
mod lottery;
mod nested_loops;
mod normal_vibration;
mod planar_scenes;
mod plane_rows;
mod random_drives;
mod random_stacks;
mod ruby;
mod shapes;
mod small_oscillations;
mod soak;
mod stack_rows;
mod stages;
mod statics;
mod steady;
mod stiff;
mod stops;
mod straight_walks;
mod swings;
mod unfed_inputs;
mod units;
mod vibrated;
