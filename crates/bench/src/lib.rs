//! What accuracy costs: every stepper on both engines and what others would do, errors over time and evaluations; and whether
//! every sensible scene runs to its end and to its tolerance: [`soak`].
//!
//! Nothing depends on this crate but the commands `stickslip-lab bench` and `stickslip-lab soak`: it brings a second simulator, an outside integrator and
//! a processor's clock, which no library of the others should carry.
//!
//! [`measure`] measures one scenario and writes its table and pictures, [`growth::measure`] what more of something costs,
//! [`frames::measure`] how long frames of drives take in real time, [`write_page`] tells of both; a [`Request`] says what is asked.
//!
//! In reading order: `request`; `problem` (a scenario with its reference), `norm` and `samples` (how far off a run is);
//! `contestant`, `family` and `steps` (who runs, at what tolerances and steps), `baseline` (what others would do); `turns` and
//! `clock` (the measurement), [`instructions`]; `front` (what an error costs); `sheet`, [`picture`] and `page` (what is written), `machine`;
//! [`growth`]; [`frames`], which are drives in real time; `masing`, the memory under a constant load; [`floor`], how little the benchmark
//! drive could cost.

mod baseline;
mod clock;
mod contestant;
mod error;
mod family;
pub mod floor;
pub mod frames;
mod front;
pub mod growth;
pub mod instructions;
mod machine;
mod masing;
mod measurement;
mod norm;
mod page;
pub mod picture;
mod problem;
mod request;
mod samples;
mod sheet;
pub mod soak;
mod steps;
mod turns;
mod work;

pub use error::BenchError;
pub use measurement::{TABLE, measure};
pub use page::{Chapter, write_page};
pub use problem::{Known, ProblemError};
pub use request::Request;
