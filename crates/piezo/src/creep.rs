//! Creep of a stack: after a step of the voltage its stroke goes on with the logarithm of the time.
//!
//! The [`Creep`] law is a sum of exponentials, a [`CreepBlock`] their filter, or the inverse of it.

mod block;
mod law;

pub use block::CreepBlock;
pub use law::{Creep, CreepError};
