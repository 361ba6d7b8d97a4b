//! What the bench measures with and by: the least code that runs the benchmark drive is that drive, and drawn scenes are right.
//!
//! One binary, linked once.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod floor;
mod soak;
