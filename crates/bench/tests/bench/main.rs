//! Tests of the minimal code, and of random scenarios.
//!
//! All tests are in one binary, which is linked once.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod floor;
mod soak;
