//! Comparison of two folders of results: channels, events and summary values.
//!
//! In reading order:
//!
//! * [`Terms`] – the allowed differences; [`Results`] – the contents of a folder, with the consistency checks of `soundness`;
//! * `allowance` – tolerance of each channel and summary value; `scales` – natural scales of the model;
//! * [`ChannelDifference`], [`EventDifferences`] with `alignment`, [`FigureDifferences`] (summary values);
//! * [`Coverage`] – compared fraction of a run; [`Comparison`] – the overall result; [`CompareError`];
//! * [`golden`] – reference results for regression tests.

mod alignment;
mod allowance;
mod asked;
mod channels;
mod comparison;
mod coverage;
mod error;
mod events;
mod figures;
pub mod golden;
mod results;
mod scales;
mod soundness;
mod terms;

pub use channels::{ChannelDifference, CommonRows};
pub use comparison::{Comparison, First, Rows, Side, Tolerance, Verdict, time};
pub use coverage::Coverage;
pub use error::CompareError;
pub use events::{EventDifferences, Lone, Moved};
pub use figures::{FigureDifference, FigureDifferences};

pub(crate) use results::LENGTHS;
pub use results::{Results, ResultsError};
pub use terms::Terms;
