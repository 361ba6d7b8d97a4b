//! The scenario file: the only crate that reads its JSON.
//!
//! [`Scenario::load`] makes a [`Scene`](stickslip_drive::Scene) and a [`Plan`](stickslip_drive::Plan) of a file. The
//! form of the file and its meaning are two sets of types with one conversion between them. What
//! a file may hold is checked here; what makes a pair, a profile or a contact in `stickslip-contact`; what makes a scene
//! or a plan in `stickslip-drive`, when the model is built. Their typed errors get their words and their place in the file
//! here: [`Scenario::refusal`].
//!
//! Every error is a [`ScenarioError`] that points into the file: one index from key path to place is kept. It tells everything
//! that is wrong and no consequence of something else: `mistakes`. What is allowed and odd is a warning, of which a
//! [`Scenario`] carries several.
//!
//! In reading order: `text` (bytes that are text), `syntax` (JSON with comments, limits, duplicate keys, what people write
//! instead) and `place` (the index) under `document`; `overrides` (`--set`); `units` and `quantity`; `form` (what may
//! stand where, with the docs that become the schema), the `reader` that fills it, `misfit` and `refusal` (what does not
//! fit, as data and in words); `mistakes` (what else does not); `tables` in the scenario's `folder`; `meaning` (the conversion, and its warnings); `resolved`
//! (canonical JSON); `pairing` (what contacts are made of); `address` (where the parts of a scene stand in the file);
//! `schema`, and `guide`, which answers from it; `parameter` (numbers that may be varied); `study` (the other file: which of them are, and what is kept of each run); `named` (materials by name) and `substance` (what a material's name means).
//! [`Report`] is what all of them say, [`Excerpt`] the line it shows.

mod address;
mod document;
mod error;
mod excerpt;
mod fault;
mod folder;
mod form;
mod guide;
mod meaning;
mod misfit;
mod mistakes;
mod named;
mod overrides;
mod pairing;
mod parameter;
mod path;
mod place;
mod plot_name;
mod quantity;
mod reader;
mod refusal;
mod resolved;
mod scenario;
mod schema;
mod study;
mod substance;
mod suggest;
mod syntax;
mod tables;
mod text;
mod units;

pub use error::{Report, ScenarioError, Stage, Warning};
pub use excerpt::Excerpt;
pub use guide::explained;
pub use meaning::{
    Ceramic, FieldsOutput, Figures, Hysteresis, MemoryOutput, OwnPlot, Piezo, SpringsOutput, Written,
    WrittenEvents,
};
pub use named::{MATERIALS, NamedMaterial};
pub use parameter::Parameter;
pub use plot_name::PlotName;
pub use quantity::quantity;
pub use scenario::Scenario;
pub use schema::{schema, study_schema};
pub use study::{Basis, Goal, Sampling, Shaped, StudyFile, Variation};
pub use substance::{Substance, substance};
pub use suggest::help as suggestion;
pub use tables::{Pairs, pairs};
