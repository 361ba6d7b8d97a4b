//! Numbers with units, names and definitions, for all crates that write or explain numbers.
//!
//! * [`Real`]: a number of a result in JSON, null if it is not finite.
//! * [`Prefix`] and [`quantity()`]: numbers with units, formatted for readers.
//! * [`names`]: the unit and the owner in the name of a channel or result.
//! * [`columns`]: the columns of all tables; [`terms`]: terms of the field.
//! * [`report()`]: definitions of the keys of a report, taken from the doc comments of its fields.

pub mod columns;
mod definitions;
pub mod names;
mod prefix;
mod real;
pub mod terms;
mod text;

pub use definitions::{Columns, Definition, page, report};
pub use prefix::{Prefix, takes_prefix};
pub use real::Real;
pub use text::{apart, quantity};
