//! Properties of a model that are known before a run.
//!
//! [`Setup`] is the common argument of the functions. [`Pressed`] and [`Loaded`] describe a contact at an indentation. [`zero_step_stroke`]
//! computes the dead zone. [`Prescribed`] is slip on a prescribed path, [`Follower`] a quantity that follows a waveform, [`Mode`] a normal
//! mode. [`ExpectedEvents`], [`rows`] and [`fixed_steps`] predict the size of a run.

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
    /// Model that is built from the description.
    pub model: &'a Model,
    /// State at t = 0.
    pub start: &'a State,
}
