//! Contacts as a whole: profiles, memory curve, row of springs and fields against closed forms, quadratures and reference histories.
//!
//! One binary, linked once; every module is a subject.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and shows what it measured"
)]

mod abuse;
mod closed_forms;
mod damping;
mod fields;
mod first_loading;
mod growth;
mod histories;
mod ideal_drive;
mod lottery;
mod profiles;
mod profiles_bordered;
mod profiles_rough;
mod profiles_tables;
mod row;
mod thinning;
mod words;
