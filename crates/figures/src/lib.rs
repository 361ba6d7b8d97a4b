//! Plots of results, drawn equally from a finished run and from its result folder.
//!
//! [`draw`] converts [`Sources`] to picture files in a [`Look`]. [`Origin`] reads the scenario and fingerprint back from a picture.
//!
//! Modules in reading order:
//!
//! * [`look`]: file formats, colours and size;
//! * `pictures`: plots of a run, with one module per plot; `origin`: origin of a picture;
//! * [`comparison`]: two runs and their difference; [`overlay`]: several results in one plot;
//! * [`gallery`]: all plots of scenarios, with Markdown pages;
//! * [`realtime`]: real-time runs; [`measured`]: measured loops; [`fit`]: fitted parameters;
//! * [`theory`]: a single contact under a load history;
//! * [`steady`]: periodic orbits; [`branch`]: branches of them; [`curve`]: performance curves; [`sensitivity`]:
//!   sensitivities; [`map`]: a result over two parameters.

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
