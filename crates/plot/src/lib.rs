//! Figures from plain series.
//!
//! A [`Figure`] is data: panels, axes, series, reference lines. [`draw_png`] and [`draw_svg`] turn it into bytes or
//! text for the caller to write. Two builders arrange the figures of a drive from plain series: [`loop_figure`]
//! (force over displacement) and [`trajectory_figure`] (motion over time).
//!
//! In reading order:
//!
//! * [`figure`] – the data model;
//! * [`theme`] – colours, line styles, sizes;
//! * [`label`] – texts, plain or with subscripts;
//! * [`hysteresis`], [`trajectory`] – the builders;
//! * `range`, `scale` – what an axis shows: range, prefix, offset, ticks;
//! * `legend`, `layout`, `place` – where everything goes;
//! * `thin`, `dash` – what is drawn of a long series, and in what pieces;
//! * `paint` – the figure in strokes and texts, on any backend of plotters;
//! * `font`, `raster` – the backend for pictures: coverage-exact strokes and glyphs;
//! * [`png`], [`svg`] – the two outputs.
//!
//! Same figure, same bytes: nothing is read but the figure, the font is built in.

mod dash;
pub mod figure;
mod font;
pub mod hysteresis;
pub mod label;
mod layout;
mod legend;
mod paint;
mod place;
pub mod png;
mod range;
mod raster;
mod scale;
pub mod svg;
pub mod theme;
mod thin;
pub mod trajectory;

pub use figure::{Arrangement, Axis, Figure, Panel, PlotError, Reference, Series};
pub use hysteresis::{HysteresisLoop, loop_figure};
pub use label::Label;
pub use png::{draw_png, read_text};
pub use svg::draw_svg;
pub use theme::{Colour, Dash, Ink, Style, Theme};
pub use trajectory::{Track, Trajectory, trajectory_figure};
