//! Drawn figures, whose contents are parsed, counted and measured.
//!
//! All modules are in one test binary. `drawn` draws and parses figures; each other module tests one subject.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod drawn;

mod contacts;
mod growth;
mod pictures;
mod print;
mod scenes;
mod specimens;
mod work_precision;
mod zoom;
