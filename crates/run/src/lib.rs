//! Scenarios made ready to run, and what their runs leave behind: for every door, for it draws nothing, prints nothing and
//! knows no terminal.
//!
//! [`Job::new`] makes a scenario ready, [`Job::run`] runs it in memory, [`Summary::new`] says what it came to; a
//! [`Recorder`] with a [`Folder`](folder::Folder) writes tables as the run goes on, and [`Results::read`] reads such a folder
//! back. A [`Watcher`] is told how far a run has come and may end it.
//!
//! In reading order:
//!
//! * [`Job`], within its `limits`; `plausibility` (what is odd about it); [`info`], what it means and will take; [`Columns`];
//!   [`program`], which computes;
//! * [`Watcher`], [`Recorder`] and [`Outcome`] – a run;
//! * what it leaves: [`Kept`] with [`Series`], the moments of its `marks`, the `foot` of a drive, the `account` of its last period and [`Tracks`] in memory, `books` (energies); `table`,
//!   `insides` and `sheet` with its `digest` on disk, under the names of [`files`], in a [`folder`] on a `disk`, each table with its [`Seal`]; its [`fingerprint`];
//! * what it means: [`Periods`], [`Trail`] and [`contact_path()`] (series prepared for the analysis), [`cycles`] and their
//!   table, [`summary`] with
//!   [`Real`] and [`Parts`] (numbers and things in JSON); [`Warning`] (what it is not worth);
//! * what is read back: `guard` (files of strangers), `synopsis` (a summary), `rows` and [`frame`] (tables), `replay` and
//!   [`Results`] (a folder), [`springs`] and [`curves`];
//! * [`checkpoint`] – runs that go on after they were ended;
//! * [`theory`] – one contact by itself, without a run;
//! * for those who tell of results: [`quantity()`] (numbers with units), [`provenance`] (where they come from), [`markdown`]
//!   (pages), [`complaint`] (the words of the operating system).

mod account;
mod books;
pub mod checkpoint;
mod columns;
pub mod complaint;
mod contact_path;
pub mod curves;
pub mod cycles;
mod cycles_table;
mod digest;
mod disk;
mod excess;
mod excursions;
pub mod files;
pub mod fingerprint;
pub mod folder;
mod foot;
pub mod frame;
pub mod guard;
mod held;
pub mod info;
mod insides;
mod job;
mod kept;
mod limits;
pub mod markdown;
mod marks;
pub mod measured;
mod memory;
pub mod moments;
mod outcome;
pub mod outlook;
mod parts;
mod periods;
mod plausibility;
pub mod program;
pub mod provenance;
mod record;
mod replay;
mod results;
pub mod rows;
mod seal;
mod selection;
mod series;
mod sheet;
pub mod springs;
mod states;
mod steps_table;
mod strides;
pub mod summary;
pub mod synopsis;
mod table;
mod tally;
pub mod theory;
mod tracks;
mod trail;
mod warning;

pub use account::Extreme;
pub use columns::Columns;
pub use contact_path::contact_path;
pub use excess::Excess;
pub use files::heads;
pub use held::{Held, HeldError, Port, Quantity};
pub use job::{Job, Refusal};
pub use kept::Kept;
pub use memory::Table;
pub use outcome::Outcome;
pub use parts::Parts;
pub use periods::Periods;
pub use record::{Draft, Recorder};
pub use results::{Results, ResultsError};
pub use seal::{Seal, SealedTable, hash};
pub use selection::TakenEvents;
pub use series::{ENERGY, Series};
pub use stickslip_drive::{Unrecorded, Watcher};
pub use stickslip_quantity::{Definition, Real, apart, definitions, definitions_page, quantity};
pub use summary::Summary;
pub use synopsis::{NO_RESULTS, SynopsisError, check_published};
pub use tracks::{Track, Tracks};
pub use trail::Trail;
pub use warning::Warning;
