//! Numbers that have names: units, texts, definitions. Read by all that write a number down or tell what one is.
//!
//! * [`Real`] – a number of a result, which JSON writes even where it is not finite;
//! * [`Prefix`] and [`quantity()`] – numbers with units, as people read them;
//! * [`names`] – what the name of a channel or figure says;
//! * [`definitions()`] – what columns, figures and keys are.

mod definitions;
pub mod names;
mod prefix;
mod real;
mod text;

pub use definitions::{Definition, definitions, definitions_page};
pub use prefix::{Prefix, takes_prefix};
pub use real::Real;
pub use text::{apart, quantity};
