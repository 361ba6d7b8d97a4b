//! Tests of piezo stacks in simulations: hysteresis, creep and driver.
//!
//! All tests are one binary, which is linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod blocks;
mod driver;
mod parts;
