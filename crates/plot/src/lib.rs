//! Plots of simulation results as PNG and SVG.
//!
//! A [`Figure`] is data: panels with axes, series, bands, mosaics, lanes and reference lines. [`draw_png`] and
//! [`draw_svg`] convert it to a file's content. The builders make figures from plain series.
//!
//! Modules in reading order:
//!
//! * [`figure`], [`panel`]: data model; [`error`]: errors;
//! * [`theme`]: colours, line styles and sizes;
//! * [`label`]: texts, plain or with subscripts;
//! * builders for quantities over time: [`trajectory`] (positions), [`drive`] (voltage, current, positions and
//!   forces), [`energy`] (energy balance), [`events`] (event times), [`waveform`] (waveforms and their rates);
//! * builders for the model and its motion: [`scene`] (the model, to scale), [`hysteresis`] (force over
//!   displacement), [`phase`] (velocity over displacement);
//! * builders for contacts: [`state`] (stick and slip of the springs), [`memory`] and [`anchors`] (slip memory),
//!   [`friction`] (friction work per area);
//! * builders for contact mechanics: [`fields`] (stresses and displacements), [`substitute`] (row of springs),
//!   [`profile`] (profiles f and g);
//! * builders for studies: [`curve`] (performance curves), [`orbit`] (periodic orbit), [`branch`] (branch of periodic
//!   orbits), [`map`] (result over two parameters), [`tornado`] (sensitivities);
//! * builders for benchmarks: [`work_precision`] (error over cost), [`growth`] (cost over problem size), [`realtime`]
//!   (execution times);
//! * combinations of figures: [`compare`] (two runs and their difference), [`zoom`] (enlarged time range), [`over`]
//!   (several results in one figure);
//! * `range`, `scale`: axis ranges, unit prefixes, offsets and ticks;
//! * `legend`, `lanes`, `layout`, `place`, `notes`: layout;
//! * `thin`, `dash`, `mosaic`: reduction of large data sets, dashes, cells;
//! * `paint`, `beside`, `content`, `arrow`: drawing, through `canvas` on any plotters backend;
//! * `font`, `stroke`, `raster`: bitmap backend; `palette`: palette of a bitmap;
//! * [`png`], [`svg`]: output formats; [`carried`]: metadata in the files.
//!
//! Equal figures give equal bytes, because the font is built in and no other file is read.

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
