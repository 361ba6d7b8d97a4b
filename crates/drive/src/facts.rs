//! Properties of a model that are known before a run.
//!
//! Contents: [`Setup`], the common argument; [`Pressed`] and [`Loaded`], a contact at an indentation; [`zero_step_stroke`];
//! [`Prescribed`], slip on a path that waveforms prescribe; [`Follower`], a quantity that follows a waveform; [`Mode`], a normal
//! mode; [`ExpectedEvents`]; the numbers of [`rows`] and [`fixed_steps`] of a run.

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

/// A [`Scene`] with its [`Model`] and its [`State`] at t = 0.
#[derive(Debug, Clone, Copy)]
pub struct Setup<'a> {
    /// Description of the drive.
    pub scene: &'a Scene,
    /// Model made from it.
    pub model: &'a Model,
    /// State at t = 0.
    pub start: &'a State,
}
