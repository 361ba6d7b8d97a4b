//! Scenario files: what good ones mean, what is told of bad and odd ones, and that no file hangs or overturns the reader.
//!
//! One binary, linked once; every module is a subject. The files lie in `good`, `bad` and `odd` beside it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bad;
mod convenience;
mod limits;
mod load;
mod mutated;
mod odd;
mod output;
mod profiles;
mod schema;
mod several;
