//! Scenario files: meaning of valid ones, errors and warnings, and robustness of the reader against any file.
//!
//! All tests are in one binary, which is linked once. The files are in `good`, `bad` and `odd`.

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
