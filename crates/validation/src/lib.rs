//! Validation: comparison of the program with measurements, other programs and closed forms.
//!
//! A [`Subject`] is a known result. [`Subject::page`] computes it and returns a [`Page`] with reference, result, deviation and limit.
//! [`Page::markdown`] and [`Page::picture`] are its files; [`index`] lists all pages. No parameter is fitted, and limits were set before
//! the comparison. A [`Check`] states whether a limit is met.
//!
//! Modules in reading order:
//! * `subject`: list of comparisons; `page` and `check`: content of a page; `table` and `picture`: its parts.
//! * `data`: published reference data; `bounce`: simulated impacts; `worked`: values of closed forms.
//! * One module for each subject.

mod bounce;
mod check;
mod closed_forms;
mod contact_bem;
mod data;
mod finite_elements;
mod fretting_load;
mod impact_theory;
mod measured_impact;
mod oblique_loading;
mod page;
mod picture;
mod restitution;
mod stick_slip;
mod subject;
mod table;
mod worked;

pub use check::Check;
pub use page::{Page, index};
pub use subject::{Subject, ValidationError};
