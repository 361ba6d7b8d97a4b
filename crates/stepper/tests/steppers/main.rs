//! Steppers against closed forms: orders, dense output, error estimates, steps that are cut, rejected and taken up again.
//!
//! One binary, linked once. `systems` are what is stepped; every other module is a subject.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod systems;

mod dormand_prince;
mod fixed_steps;
mod paired;
mod radau;
mod reference;
mod singular;
mod stability;
