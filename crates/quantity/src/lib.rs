//! Numbers that have names: units, texts, definitions. Read by all that write a number down or tell what one is.
//!
//! * [`Real`] – a number of a result, which JSON writes even where it is not finite;
//! * [`Prefix`] and [`quantity()`] – numbers with units, as people read them;
//! * [`names`] – what the name of a channel or figure says;
//! * [`columns`] – the columns of all tables; [`terms`] – terms of the field;
//! * [`report()`] – what the numbers of a report are, from the comments of its fields.

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
