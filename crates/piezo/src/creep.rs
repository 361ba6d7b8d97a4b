//! Creep of a piezo stack: after a voltage step the stroke changes with the logarithm of time.
//!
//! [`Creep`] approximates the logarithm by a sum of exponentials. [`CreepBlock`] is the linear filter with this response or its inverse.

mod block;
mod law;

pub use block::CreepBlock;
pub use law::{Creep, CreepError};
