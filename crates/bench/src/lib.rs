//! Benchmarks: error versus run time of all time integrators and reference implementations, and random tests of robustness ([`soak`]).
//!
//! Only the commands `stickslip-lab bench` and `stickslip-lab soak` depend on this crate. The crate contains a second simulator, an
//! external integrator and processor clocks, which other libraries should not contain.
//!
//! [`measure`] benchmarks one scenario and writes its table and plots. [`growth::measure`] measures the scaling of the run time,
//! [`frames::measure`] real-time frames. [`write_page`] writes the page. A [`Request`] contains the options.
//!
//! Reading order of the modules:
//!
//! * `request`; `problem` (scenario with its reference solution), `norm` and `samples` (errors).
//! * `contestant`, `family` and `steps` (methods, tolerances and steps), `baseline` (reference implementations).
//! * `turns` and `clock` (time measurement), [`instructions`] (instruction counts), `front` (time versus error).
//! * `sheet`, [`picture`], `page` and `machine` (output).
//! * [`growth`], [`frames`], `masing` (contact memory under constant load), [`floor`] (minimal code for the benchmark drive).

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
pub use measurement::{TABLE, measure, redraw};
pub use page::{Chapter, write_page};
pub use problem::{Known, ProblemError};
pub use request::Request;
