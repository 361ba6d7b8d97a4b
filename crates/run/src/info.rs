//! Properties of a model that are known before the run, as data structures for JSON.
//!
//! In reading order: [`bodies`] and [`waveforms`], [`contacts`], [`modes`], [`piezos`]; [`Stepping`]; [`Expectation`]; [`Usage`].

mod ceramic;
mod contacts;
mod expectation;
mod motion;
mod piezo;
mod stepping;
mod usage;

pub use contacts::{ContactInfo, DampingInfo, Loaded, Pressed, contacts, name};
pub use expectation::{Events, Expectation, PerPeriod};
pub use motion::{BodyInfo, Freed, ModeInfo, WaveformInfo, bodies, modes, waveforms};
pub use piezo::{CommandInfo, CornerInfo, PiezoInfo, piezos};
pub use stepping::Stepping;
pub use usage::{Item, Usage};
