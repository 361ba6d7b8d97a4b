//! What a scene means before it runs: numbers that follow from scene, model and plan alone.
//!
//! In reading order: [`Setup`], which all are told of; [`Pressed`] and [`Loaded`] (a contact at an indentation), with
//! [`zero_step_stroke`]; [`Prescribed`] (slip on a path that waveforms prescribe); [`Follower`] (what follows a waveform); [`Mode`] (small motions); [`ExpectedEvents`], and what
//! [`rows`] and [`fixed_steps`] a run has.

mod events;
mod extent;
mod followers;
mod modes;
mod prescribed;
mod pressed;

use crate::{Model, Scene, State};

pub use events::ExpectedEvents;
pub use extent::{fixed_steps, rows};
pub use followers::{Follower, followers};
pub use modes::{Mode, modes};
pub use prescribed::{Prescribed, common_period};
pub use pressed::{Loaded, Pressed, has_constant_load, zero_step_stroke};

/// A scene with the model that was made of it and the state at t = 0.
#[derive(Debug, Clone, Copy)]
pub struct Setup<'a> {
    /// What is there.
    pub scene: &'a Scene,
    /// Its constants.
    pub model: &'a Model,
    /// Where a run begins.
    pub start: &'a State,
}
