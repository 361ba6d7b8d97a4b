//! Behaviour of the program that measures and checks the other.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking, as the tests do")]

mod bench;
mod frames;
mod gallery;
#[path = "../program.rs"]
#[allow(dead_code, reason = "helpers of the other program's tests as well")]
mod program;
mod soak;
mod validation;
