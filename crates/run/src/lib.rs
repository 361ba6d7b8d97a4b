//! Preparation, execution and results of simulation runs. The crate draws no plots and prints no text.
//!
//! [`Job::new`] prepares a scenario, [`Job::run`] simulates it in memory, and [`Summary::new`] evaluates the run. A [`Recorder`] with a
//! [`Folder`](folder::Folder) writes tables during the run. [`Results::read`] reads a results folder. A [`Watcher`] receives the progress
//! of a run and can stop it.
//!
//! In reading order:
//!
//! * [`Job`] (a prepared scenario) with its `limits`; [`info`] (properties known before the run); [`Columns`] of tables; [`program`];
//! * a run: [`Watcher`], [`Recorder`], [`Outcome`] (its results), [`Table`] (rows in memory); [`PartedRun`] (a run with pauses),
//!   [`Held`] (a run that the caller advances), [`Simulation`] with [`interface`] (for other programs);
//! * [`Kept`]: results in memory; `table`, `insides` and `sheet` with `digest`: tables on disk, named in [`files`], each with its [`Seal`];
//!   [`folder`]: atomic publishing of results on a `disk`; [`fingerprint`]: digests of tables;
//! * [`summary`] with [`Real`] and [`Parts`]; [`warning`];
//! * readers of results: `guard`, `synopsis`, `rows` and [`frame`], `replay` and [`Results`], [`springs`] and [`curves`];
//! * [`checkpoint`] – interrupted runs that can be resumed;
//! * [`theory`] – a single contact without a run;
//! * [`quantity()`] (numbers with units), [`provenance`], [`markdown`], [`complaint`] – texts about results.

pub mod checkpoint;
mod columns;
pub mod complaint;
pub mod curves;
mod cycles_table;
mod digest;
mod disk;
mod excess;
pub mod files;
pub mod fingerprint;
pub mod folder;
pub mod frame;
mod going;
pub mod guard;
mod held;
pub mod info;
mod insides;
pub mod interface;
mod job;
mod kept;
mod limits;
pub mod linear;
pub mod markdown;
pub mod measured;
mod memory;
pub mod moments;
mod outcome;
pub mod outlook;
mod parts;
pub mod program;
pub mod provenance;
mod pulses_table;
mod record;
mod replay;
mod results;
pub mod rows;
mod seal;
mod selection;
mod sheet;
mod simulation;
pub mod springs;
mod states;
mod steps_table;
pub mod summary;
pub mod synopsis;
mod table;
pub mod theory;
pub mod warning;

pub use columns::Columns;
pub use excess::Excess;
pub use going::PartedRun;
pub use held::{Held, HeldError, Quantity};
pub use job::{Job, Refusal};
pub use kept::Kept;
pub use memory::Table;
pub use outcome::Outcome;
pub use parts::Parts;
pub use record::{Draft, Recorder};
pub use results::{Results, ResultsError};
pub use seal::{Seal, SealedTable, hash};
pub use selection::TakenEvents;
pub use simulation::{Simulation, SimulationError};
pub use stickslip_drive::{Unrecorded, Watcher};
pub use stickslip_measure::{
    ENERGY, Extreme, Periods, Series, Setting, Track, Tracks, Trail, Warning, contact_path,
};
pub use stickslip_quantity::{Definition, Real, apart, quantity};
pub use summary::Summary;
pub use synopsis::{NO_RESULTS, SynopsisError, check_published};

/// Returns the definitions of all table columns and of all keys of `summary.json`.
#[must_use]
pub fn definitions() -> Vec<Definition> {
    let tables = std::iter::once(stickslip_quantity::columns::TRACE).chain(files::TABLES);
    let tables = tables.flat_map(|table| table.definitions());
    tables.chain(stickslip_quantity::report::<Summary>(files::SUMMARY)).collect()
}
