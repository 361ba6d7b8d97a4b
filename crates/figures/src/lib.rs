//! Pictures of results: drawn alike from a run that has just ended and from its folder.
//!
//! [`draw`] turns [`Sources`] into files in a [`Look`]; [`comparison`] draws two runs and their difference; [`Origin`] reads back
//! what a picture comes from; [`gallery`] draws all pictures of a scenario, and the page that shows them.
//!
//! In reading order: [`look`] (as what files, in what colours and size); `pictures` (the table of their kinds) with a module
//! for each: what it shows, what it needs and how it is drawn; [`comparison`]; `origin`; [`gallery`]; [`realtime`], pictures of a loop; [`measured`], loops from a table;
//! [`steady`], the picture of a motion that repeats itself; [`branch`], that of many such motions; [`curve`], those of a machine; [`sensitivity`], what
//! matters to it; [`map`], a result over two numbers.

pub mod branch;
pub mod comparison;
pub mod curve;
pub mod fit;
pub mod gallery;
pub mod look;
pub mod map;
pub mod measured;
mod origin;
pub mod overlay;
mod pictures;
pub mod realtime;
pub mod sensitivity;
pub mod steady;
pub mod theory;

pub use look::{Colours, Format, Look, Picture};
pub use origin::{Origin, OriginError};
pub use pictures::{FigureError, Sources, draw, draw_one};
