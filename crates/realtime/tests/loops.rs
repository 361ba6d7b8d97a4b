//! A drive in its loop: paced and unpaced to the same bits, put down and taken up, without an allocation, and with clients that
//! do what they should not. Over 127.0.0.1 and shared memory alone; no time on the wall is asserted.

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
