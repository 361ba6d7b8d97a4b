//! Tests of contacts: profiles, memory curve, row of springs and fields, against closed forms, quadrature and reference histories.
//!
//! All tests are one binary, which is linked once.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod abuse;
mod asperities;
mod breaking;
mod closed_forms;
mod damping;
mod fields;
mod first_loading;
mod graded;
mod growth;
mod histories;
mod ideal_drive;
mod lottery;
mod profiles;
mod profiles_bordered;
mod profiles_rough;
mod profiles_tables;
mod restitution;
mod row;
mod thinning;
mod words;
