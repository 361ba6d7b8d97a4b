//! Two folders of results told apart, channel by channel, event by event, figure by figure.
//!
//! In reading order: [`Terms`] (what is asked); [`Results`] (a folder read back) with
//! `soundness` (whether its files fit together); `allowance` with `scales` and `names`
//! (what may differ by how much); [`ChannelDifference`]; [`EventDifferences`] with `alignment`; [`FigureDifferences`];
//! [`Coverage`] (how much was compared); [`Comparison`] (all of it, and what it comes to); [`CompareError`]; [`golden`] (results that are kept to be compared with).

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
