//! Known results, measured, computed by others and in closed form, beside what the program makes of them.
//!
//! A [`Subject`] is a known result; [`Subject::page`] computes it anew and says on a [`Page`] what is known and from where, what
//! the program makes of it, how far the two are apart and how far they may be. [`Page::markdown`] and [`Page::picture`] are its
//! files, [`index`] is the page of all pages. Nothing here is fitted, and no tolerance here is one that was found: each is asked
//! for beforehand, and a [`Check`] says whether it is kept.
//!
//! In reading order: `subject` (the list), `page` and `check`, `table` and `picture` (what they are made of), `data` (what others
//! published, with its source), `bounce` (impacts, run as a user runs them), then a module for each subject,
//! and `worked`, numbers of closed forms.

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
mod subject;
mod table;
mod worked;

pub use check::Check;
pub use page::{Page, index};
pub use subject::{Subject, ValidationError};
