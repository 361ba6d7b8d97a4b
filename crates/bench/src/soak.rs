//! Scenes drawn from seeds, run and judged: does every sensible scene run to its end, and to its tolerance?
//!
//! [`scenario()`] draws the scenario of a seed, as the text of a file that `stickslip run` takes; [`soak()`] judges many.
//!
//! In reading order: `draw` (numbers from a seed), `basis` (a contact and its scales), `course` (waveforms), `sketch` (the
//! scenario so far), `kinds` (what is drawn); `trial` (a scene made ready, its runs), `finding` (what may become of one),
//! `judge`, `rows` (the second method); `crew` (threads), `sheet` (what is told). [`hostile`] is a matrix of scenes at the extremes
//! of a plain one.

mod basis;
mod course;
mod crew;
mod draw;
mod finding;
pub mod hostile;
mod judge;
mod kinds;
mod rows;
mod sheet;
mod sketch;
mod trial;

pub use crew::{Seeds, soak};
pub use finding::{Finding, Verdict};
pub use kinds::{Kind, scenario};
pub use sheet::{TABLE, count, exceptions, table};
