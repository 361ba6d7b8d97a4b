//! Drives in real time: a frame after each tick of a clock, inputs from outside and outputs to it.
//!
//! [`plant`] is what is stepped a frame at a time; [`pace`] the loop, with absolute deadlines on the monotonic clock and a
//! [`Histogram`] of how long everything took; [`session`] joins them with the outside world: a [`Source`] of
//! inputs, the [`Intake`] that judges them, [`Sink`]s of outputs, and tapes of what is written down beside
//! it. What came of it is a [`report`].
//!
//! In the loop nothing is allocated, locked or logged, and nothing asked of the system but the sleep and, over UDP, packets.
//!
//! In reading order: [`plant`], [`pace`], [`histogram`], [`worst`]; [`wire`] (a packet), [`intake`], [`source`], [`sink`],
//! [`region`] (shared memory) with `seqlock` and [`memory`]; [`tape`] with `ring`, [`film`]; [`session`], [`probe`],
//! [`report`]; [`system`].
//!
//! This crate alone of the workspace has unsafe code: in [`memory`] and [`system`], each use with its reason.

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
