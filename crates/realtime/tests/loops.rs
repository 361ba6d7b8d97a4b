//! Tests of real-time loops: identical results with and without pacing, resumption, no allocations, faulty clients.
//!
//! They use only 127.0.0.1 and shared memory. No wall time is asserted.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and prints what it measured"
)]

#[path = "loops/allocations.rs"]
mod allocations;
#[path = "loops/clients.rs"]
mod clients;
#[path = "loops/commands.rs"]
mod commands;
#[path = "loops/pacing.rs"]
mod pacing;
#[path = "loops/rig.rs"]
mod rig;
