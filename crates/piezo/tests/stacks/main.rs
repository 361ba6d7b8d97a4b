//! Piezo stacks in runs: the blocks of hysteresis and creep, and the driver before them.
//!
//! One binary, linked once.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod blocks;
mod driver;
mod parts;
