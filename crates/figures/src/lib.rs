//! Pictures of results: drawn alike from a run that has just ended and from its folder.
//!
//! [`draw`] turns [`Sources`] into files in a [`Look`]; [`comparison`] draws two runs and their difference; [`Origin`] reads back
//! what a picture comes from; [`gallery`] draws all pictures of a scenario, and the page that shows them.
//!
//! In reading order: [`look`] (as what files, in what colours and size); `pictures` (which are drawn, and what each needs);
//! one module for each: `layout`, `hysteresis`, `trajectory`, `energy`, `phase`, `events`, `state`, `memory`; [`comparison`];
//! `origin`; [`gallery`].

pub mod comparison;
mod energy;
mod events;
pub mod gallery;
mod hysteresis;
mod layout;
pub mod look;
mod memory;
mod origin;
mod phase;
mod pictures;
mod state;
mod trajectory;

pub use look::{Colours, Format, Look, Picture};
pub use origin::{Origin, OriginError};
pub use pictures::{FigureError, Sources, draw};
