//! Steppers compared with closed forms: orders, dense output, error estimates; cut, rejected and resumed steps.
//!
//! All tests are one binary. `systems` has the equations; every other module is a subject.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod systems;

mod dormand_prince;
mod fixed_steps;
mod paired;
mod radau;
mod reference;
mod singular;
mod stability;
