//! Reads and checks scenario files and study files. No other crate reads this JSON.
//!
//! [`Scenario::load`] converts a file into a [`Scene`](stickslip_drive::Scene) (the model) and a [`Plan`](stickslip_drive::Plan) (the run).
//! The module `form` contains types that mirror the keys of the file. The module `meaning` converts them into the model. This crate checks
//! keys, units and ranges. The crate `stickslip-contact` checks materials, profiles and contacts; `stickslip-drive` checks model and run
//! when the model is built. [`Scenario::refusal`] gives the typed errors of both crates a message and a position in the file.
//!
//! Every error is a [`ScenarioError`] with positions in the file, found through one index from key paths to positions. All errors of a
//! file are reported together. Follow-on errors, which only result from another error, are suppressed. Values that are allowed but
//! implausible give warnings in [`Scenario::warnings`].
//!
//! Reading order of the modules:
//!
//! * `text` (UTF-8), `syntax` (JSON with comments, limits, duplicate keys, syntax errors), `place` (position index), `document`.
//! * `overrides` (`--set`), `units`, `quantity`.
//! * `form` (all keys; their doc comments are the descriptions in the schema), `reader` (deserializer), `misfit` and `refusal` (type
//!   errors and their messages).
//! * `mistakes` (search for all errors), `tables` and `folder` (tables in files), `meaning` (conversion, checks and warnings).
//! * `resolved` (canonical JSON), `pairing` (materials and profiles of contacts), `address` (key paths of parts of the model).
//! * `schema`, `guide` (help texts from the schema), `parameter` (numbers that may be varied), `study`; `named` (material constants by
//!   name), `substance` (classes of materials by name).
//!
//! [`Report`] is one message, [`Excerpt`] the line of the file that it shows.

mod address;
mod document;
mod error;
mod excerpt;
mod fault;
mod folder;
mod form;
mod guide;
mod interface;
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
pub use interface::Interface;
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
