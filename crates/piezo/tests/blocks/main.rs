//! Blocks of the piezo side in runs, against evaluations of their laws that share no code with them.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail like the tests")]

mod bouc_wen;
mod creep;
mod inverse;
mod parts;
mod plays;
