//! Figures from plain series.
//!
//! A [`Figure`] is data: panels, axes, series, areas, mosaics, lanes, reference lines. [`draw_png`] and [`draw_svg`]
//! turn it into bytes or text for the caller to write. Builders arrange the figures of a drive from plain series.
//!
//! In reading order:
//!
//! * [`figure`], [`panel`] – the data model; [`error`] – what cannot be drawn;
//! * [`theme`] – colours, line styles, sizes;
//! * [`label`] – texts, plain or with subscripts;
//! * the builders: [`hysteresis`] (force over displacement), [`trajectory`] (motion over time), [`phase`] (velocity
//!   over displacement), [`energy`] (the energy book), [`drive`] (what is commanded and what moves), [`events`] (what happened when), [`state`] (springs over time),
//!   [`memory`] (the curve a contact remembers by), [`anchors`] (the same over the springs' places), [`fields`] (stress and
//!   displacement under a contact), [`substitute`] (its springs), [`profile`] (f and g), [`friction`] (where it does its work), [`scene`] (what there is, to scale), [`compare`] (two runs and their
//!   difference), [`zoom`] (a part enlarged beside the whole), [`over`] (several results in one), [`work_precision`] (what an error costs), [`growth`] (what more of something costs), [`orbit`] (a motion that repeats itself),
//!   [`curve`] (what a machine does over something that is varied), [`branch`] (steady motions over such a thing), [`map`] (a result over two numbers), [`tornado`] (what matters most);
//! * `range`, `scale` – what an axis shows: range, prefix, offset, ticks;
//! * `legend`, `lanes`, `layout`, `place`, `notes` – where everything goes;
//! * `thin`, `dash`, `mosaic` – what is drawn of much data, and in what pieces;
//! * `paint`, `beside`, `content`, `arrow` – the figure in strokes, areas and texts, which `canvas` hands to any backend of
//!   plotters;
//! * `font`, `stroke`, `raster` – the backend for pictures: glyphs, and strokes by coverage; `palette` – their few colours;
//! * [`png`], [`svg`] – the two outputs; [`carried`] – what they carry unseen.
//!
//! Same figure, same bytes: nothing is read but the figure, the font is built in.

pub mod anchors;
mod arrow;
mod beside;
pub mod branch;
mod canvas;
pub mod carried;
pub mod compare;
mod content;
pub mod curve;
mod dash;
pub mod drive;
pub mod energy;
pub mod error;
pub mod events;
pub mod fields;
pub mod figure;
mod font;
pub mod friction;
pub mod growth;
pub mod hysteresis;
pub mod label;
mod lanes;
mod layout;
mod legend;
pub mod map;
pub mod memory;
mod mosaic;
mod notes;
pub mod orbit;
pub mod over;
mod paint;
mod palette;
pub mod panel;
pub mod phase;
mod place;
pub mod png;
pub mod profile;
mod range;
mod raster;
pub mod realtime;
mod scale;
pub mod scene;
pub mod state;
mod stroke;
pub mod substitute;
pub mod svg;
pub mod theme;
mod thin;
pub mod tornado;
pub mod trajectory;
pub mod waveform;
pub mod work_precision;
pub mod zoom;

pub use anchors::{AnchorMoment, anchors_figure};
pub use branch::{BranchCourse, Stretch, branch_figure};
pub use carried::read_text;
pub use compare::{ComparedChannel, compare_figure};
pub use curve::{MachineCourse, MachineCurve, MachineLine, machine_figure};
pub use drive::{DriveCourse, Supply, drive_figure};
pub use energy::{EnergyBook, energy_figure};
pub use error::PlotError;
pub use events::{EventTrack, events_figure};
pub use fields::{FieldsMoment, FieldsZone, fields_figure};
pub use figure::{Arrangement, Figure};
pub use friction::{FrictionWork, friction_figure, friction_figures};
pub use growth::{GrowthCurve, growth_figure};
pub use hysteresis::{HysteresisLoop, loop_figure, marked_loop_figure};
pub use label::Label;
pub use map::{MapContent, ResultMap, map_figure};
pub use memory::{MemoryMoment, memory_figure};
pub use orbit::{OrbitCourse, orbit_figure};
pub use over::overlaid;
pub use panel::{Axis, Band, Lane, Mark, Mosaic, Note, Panel, Reference, Rescaled, Series, Shape};
pub use phase::{PhasePath, phase_figure};
pub use png::{draw_animation, draw_png};
pub use profile::{ProfilePair, profile_figure};
pub use realtime::{
    MarkedTimes, TimelinePanel, TimesCurve, TimesPanel, timeline_figure, times_figure, times_grid,
};
pub use scene::{
    Amount, Fixture, LinkKind, Mobility, Press, Scene, SceneBody, SceneContact, SceneGravity, SceneLink,
    SceneLoad, layout_figure,
};
pub use state::{SpringCondition, SpringMap, state_figure};
pub use substitute::{SubstituteMoment, substitute_figure};
pub use svg::draw_svg;
pub use theme::{Colour, Dash, Ink, Style, Theme};
pub use tornado::{Bar, Tornado, tornado_figure};
pub use trajectory::{Coordinate, Motion, Track, Trajectory, trajectory_figure};
pub use waveform::{WaveformCourse, waveform_figure};
pub use work_precision::{WorkCurve, work_precision_figure};
pub use zoom::{enlarged_below, enlarged_beside};
