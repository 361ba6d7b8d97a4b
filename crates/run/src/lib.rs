//! Scenarios made ready to run, and what their runs leave behind: for every door, for it draws nothing, prints nothing and
//! knows no terminal.
//!
//! [`Job::new`] makes a scenario ready, [`Job::run`] runs it in memory, [`Summary::new`] says what it came to; a
//! [`Recorder`] with a [`Folder`](folder::Folder) writes tables as the run goes on, and [`Results::read`] reads such a folder
//! back. A [`Watcher`] is told how far a run has come and may end it.
//!
//! In reading order:
//!
//! * [`Job`], within its `limits`; [`info`], what it means and will take; [`Columns`]; [`program`], which computes;
//! * [`Watcher`], [`Recorder`] and [`Outcome`] – a run; [`Held`], one that stands between two calls; [`Table`], its rows in memory;
//! * what it leaves: [`Kept`] in memory; `table`, `insides` and `sheet` with its `digest` on disk, under the names of [`files`], in a
//!   [`folder`] on a `disk`, each table with its [`Seal`]; its [`fingerprint`];
//! * what it comes to: [`summary`] with [`Real`] and [`Parts`] (numbers and things in JSON), [`warning`];
//! * what is read back: `guard` (files of strangers), `synopsis` (a summary), `rows` and [`frame`] (tables), `replay` and
//!   [`Results`] (a folder), [`springs`] and [`curves`];
//! * [`checkpoint`] – runs that go on after they were ended;
//! * [`theory`] – one contact by itself, without a run;
//! * for those who tell of results: [`quantity()`] (numbers with units), [`provenance`] (where they come from), [`markdown`]
//!   (pages), [`complaint`] (the words of the operating system).

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
pub mod guard;
mod held;
pub mod info;
mod insides;
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
mod record;
mod replay;
mod results;
pub mod rows;
mod seal;
mod selection;
mod sheet;
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
pub use held::{Held, HeldError, Port, Quantity};
pub use job::{Job, Refusal};
pub use kept::Kept;
pub use memory::Table;
pub use outcome::Outcome;
pub use parts::Parts;
pub use record::{Draft, Recorder};
pub use results::{Results, ResultsError};
pub use seal::{Seal, SealedTable, hash};
pub use selection::TakenEvents;
pub use stickslip_drive::{Unrecorded, Watcher};
pub use stickslip_measure::{
    ENERGY, Extreme, Periods, Series, Setting, Track, Tracks, Trail, Warning, contact_path,
};
pub use stickslip_quantity::{Definition, Real, apart, quantity};
pub use summary::Summary;
pub use synopsis::{NO_RESULTS, SynopsisError, check_published};

/// What every column of a run's tables and every key of `summary.json` is.
#[must_use]
pub fn definitions() -> Vec<Definition> {
    let tables = std::iter::once(stickslip_quantity::columns::TRACE).chain(files::TABLES);
    let tables = tables.flat_map(|table| table.definitions());
    tables.chain(stickslip_quantity::report::<Summary>(files::SUMMARY)).collect()
}
