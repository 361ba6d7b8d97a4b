//! What a scenario means before it runs, as JSON has it: the facts of its model, what its run will take.
//!
//! In reading order: [`bodies`] and [`waveforms`], [`contacts`], [`modes`]; [`Stepping`]; [`Expectation`].

mod contacts;
mod expectation;
mod motion;
mod stepping;

pub use contacts::{ContactInfo, Loaded, Pressed, contacts, name};
pub use expectation::{Events, Expectation, PerPeriod};
pub use motion::{BodyInfo, Freed, ModeInfo, WaveformInfo, bodies, modes, waveforms};
pub use stepping::Stepping;
