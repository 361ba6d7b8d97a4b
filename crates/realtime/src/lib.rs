//! Real-time simulation of drives: one frame per clock tick, with inputs and outputs over UDP or shared memory.
//!
//! [`plant`] is the simulated drive, advanced frame by frame. [`pace`] is the real-time loop, with absolute deadlines on the monotonic
//! clock and [`Histogram`]s of its timing. [`session`] connects both with a [`Source`] of inputs, the [`Intake`] that validates them,
//! [`Sink`]s of outputs, and files that record both. [`report`] summarises a session.
//!
//! The loop allocates no memory, takes no lock and writes no log. Its system calls are the sleep and, with UDP, sending and receiving.
//!
//! In reading order: [`plant`], [`pace`], [`histogram`], [`worst`]; [`wire`] (packet format), [`intake`], [`source`], [`sink`], [`region`]
//! (shared memory) with `seqlock` and [`memory`]; [`tape`] with `ring`, [`film`]; [`session`], [`probe`], [`report`]; [`system`].
//!
//! In the workspace, only this crate and the C interface contain unsafe code. All of it here is in [`memory`] and [`system`], and each use is justified.

pub mod film;
pub mod histogram;
pub mod intake;
pub mod memory;

pub mod pace;
pub mod plant;
pub mod probe;
pub mod region;
pub mod report;
mod ring;
mod room;
mod seqlock;
pub mod session;
pub mod sink;
pub mod source;
pub mod system;
pub mod tape;
pub mod wire;
pub mod worst;

pub use film::Film;
pub use histogram::Histogram;
pub use intake::Intake;

pub use pace::{Overrun, Pace, Timing};
pub use plant::{Drive, Plant};
pub use report::Report;
pub use sink::Sink;
pub use source::Source;
