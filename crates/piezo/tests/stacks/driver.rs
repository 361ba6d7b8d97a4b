//! The driver against closed forms: what its voltage does after steps and ramps, when it enters and leaves its limits, and whether its
//! books close.

mod books;
mod limits;
mod parts;
mod passes;
mod reciprocal;
mod stable;
