//! Random tests of robustness: random scenarios must run to their end and reach their tolerance.
//!
//! [`scenario()`] returns the scenario of a seed, as a file for `stickslip run`. [`soak()`] judges many seeds.
//!
//! Reading order: `draw` (random numbers), `basis` (first contact and its scales), `course` (waveforms), `sketch` (scenario under
//! construction), `kinds` (kinds of scenarios); `trial` (model and runs), `finding` (verdicts), `judge`, `rows` (second method); `crew`
//! (threads), `sheet` (output). [`hostile`] is a matrix of extreme scenarios.

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
