//! Tests of the driver against closed forms: step and ramp responses, events at its limits, and energy balance.

mod books;
mod limits;
mod parts;
mod passes;
mod reciprocal;
mod stable;
