//! Figures as they are drawn: what they show is read back, counted and measured.
//!
//! One binary, linked once. `drawn` draws figures and reads them back; every other module is a subject.

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
