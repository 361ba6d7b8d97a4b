//! Names of the files of a run, and the columns of those with the same columns in every run.

use crate::folder::Folder;
use crate::seal::SealedTable;
use stickslip_quantity::{Columns, columns};

/// Rows over time.
pub const TRACE: &str = columns::TRACE.file;
/// Events, with the row after each.
pub const EVENTS: &str = columns::EVENTS.file;
/// What every spring does over time, where that is asked for.
pub const SPRINGS: &str = columns::SPRINGS.file;
/// The memory curves at some moments, where they are asked for.
pub const MEMORY: &str = columns::MEMORY.file;
/// Stress and displacement under the contacts at some moments, where they are asked for.
pub const FIELDS: &str = columns::FIELDS.file;
/// Where friction has done its work by then, over the radius.
pub const FRICTION: &str = columns::FRICTION.file;
/// What goes on inside the contacts, each where it is asked for.
pub const INSIDES: [&str; 4] = [SPRINGS, MEMORY, FIELDS, FRICTION];
/// Every cycle of contacts that come back.
pub const CYCLES: &str = columns::CYCLES.file;
/// Every step of a drive.
pub const STEPS: &str = columns::STEPS.file;
/// The scenario as it was run.
pub const SCENARIO: &str = "scenario.json";
/// What the run came to.
pub const SUMMARY: &str = "summary.json";
/// What the points of a curve of a machine came to.
pub const CURVE: &str = "curve.json";
/// The same of a curve that was interrupted: a finished one stays beside it.
pub const PARTIAL_CURVE: &str = "curve-partial.json";
/// By how much figures change with the numbers of a scenario.
pub const SENSITIVITY: &str = "sensitivity.json";
/// The same where that was interrupted: what was finished stays beside it.
pub const PARTIAL_SENSITIVITY: &str = "sensitivity-partial.json";
/// A result over two numbers of a scenario.
pub const MAP: &str = "map.json";
/// The steady motion of a drive, found without a run.
pub const STEADY: &str = "steady.json";
/// Where a result is largest or smallest.
pub const OPTIMUM: &str = "optimum.json";
/// Steady motions one after another, as a number of a scenario changes.
pub const BRANCH: &str = "branch.json";
/// The same of a branch that was interrupted: a finished one stays beside it.
pub const PARTIAL_BRANCH: &str = "branch-partial.json";

/// The tables whose columns are the same in every run; of `events.csv` the columns before those of the trace.
pub const TABLES: [Columns; 7] = [
    columns::EVENTS,
    columns::SPRINGS,
    columns::MEMORY,
    columns::FIELDS,
    columns::FRICTION,
    columns::CYCLES,
    columns::STEPS,
];

/// Where the tables of the insides lie, if they were written.
#[derive(Debug, Clone)]
pub struct InsideTables {
    /// [`SPRINGS`].
    pub springs: SealedTable,
    /// [`MEMORY`].
    pub memory: SealedTable,
    /// [`FIELDS`].
    pub fields: SealedTable,
    /// [`FRICTION`].
    pub friction: SealedTable,
}

impl InsideTables {
    /// Each of the tables as its name says.
    ///
    /// # Errors
    /// What the finder says.
    pub fn find<E>(mut place: impl FnMut(&str) -> Result<SealedTable, E>) -> Result<Self, E> {
        Ok(Self {
            springs: place(SPRINGS)?,
            memory: place(MEMORY)?,
            fields: place(FIELDS)?,
            friction: place(FRICTION)?,
        })
    }

    /// Those of a folder under construction.
    pub fn drafted(folder: &Folder) -> Self {
        let at = |name: &str| folder.place(name).into();
        Self { springs: at(SPRINGS), memory: at(MEMORY), fields: at(FIELDS), friction: at(FRICTION) }
    }
}
