//! Names of the files of results, and the columns of tables that are the same in every run.

use crate::folder::Folder;
use crate::seal::SealedTable;
use stickslip_quantity::{Columns, columns};

/// Values of the channels over time (the trace).
pub const TRACE: &str = columns::TRACE.file;
/// Events, each with the values of the channels directly after it.
pub const EVENTS: &str = columns::EVENTS.file;
/// States of all springs over time, if requested.
pub const SPRINGS: &str = columns::SPRINGS.file;
/// Memory curves at requested times.
pub const MEMORY: &str = columns::MEMORY.file;
/// Stresses and displacements in the contacts at requested times.
pub const FIELDS: &str = columns::FIELDS.file;
/// Friction work per area versus radius at requested times.
pub const FRICTION: &str = columns::FRICTION.file;
/// Tables about the interior of contacts, which are written on request.
pub const INSIDES: [&str; 4] = [SPRINGS, MEMORY, FIELDS, FRICTION];
/// Load cycles of contacts at whose end the displacement u returns to its initial value.
pub const CYCLES: &str = columns::CYCLES.file;
/// Steps of a drive.
pub const STEPS: &str = columns::STEPS.file;
/// Steps of single pulses of a burst or a sequence.
pub const PULSES: &str = columns::PULSES.file;
/// Resolved scenario of the run.
pub const SCENARIO: &str = "scenario.json";
/// Summary of the run.
pub const SUMMARY: &str = "summary.json";
/// Points of a curve: a result of the steady motion of a drive versus one parameter.
pub const CURVE: &str = "curve.json";
/// Points of an interrupted curve. An existing [`CURVE`] is not overwritten.
pub const PARTIAL_CURVE: &str = "curve-partial.json";
/// Sensitivities of results to parameters of the scenario.
pub const SENSITIVITY: &str = "sensitivity.json";
/// Sensitivities of an interrupted computation. An existing [`SENSITIVITY`] is not overwritten.
pub const PARTIAL_SENSITIVITY: &str = "sensitivity-partial.json";
/// Map of a result over two parameters.
pub const MAP: &str = "map.json";
/// Periodic orbit of a drive, computed without a run.
pub const STEADY: &str = "steady.json";
/// Maximum or minimum of a result.
pub const OPTIMUM: &str = "optimum.json";
/// Branch of periodic orbits as a function of a parameter.
pub const BRANCH: &str = "branch.json";
/// Points of an interrupted branch. An existing [`BRANCH`] is not overwritten.
pub const PARTIAL_BRANCH: &str = "branch-partial.json";

/// Tables whose columns are the same in every run. `events.csv` has additional columns: those of the trace.
pub const TABLES: [Columns; 8] = [
    columns::EVENTS,
    columns::SPRINGS,
    columns::MEMORY,
    columns::FIELDS,
    columns::FRICTION,
    columns::CYCLES,
    columns::STEPS,
    columns::PULSES,
];

/// Paths of the tables about the interior of contacts.
#[derive(Debug, Clone)]
pub struct InsideTables {
    /// Path of [`SPRINGS`].
    pub springs: SealedTable,
    /// Path of [`MEMORY`].
    pub memory: SealedTable,
    /// Path of [`FIELDS`].
    pub fields: SealedTable,
    /// Path of [`FRICTION`].
    pub friction: SealedTable,
}

impl InsideTables {
    /// Finds the four tables by calling `place` with their file names.
    ///
    /// # Errors
    /// Any error that `place` returns.
    pub fn find<E>(mut place: impl FnMut(&str) -> Result<SealedTable, E>) -> Result<Self, E> {
        Ok(Self {
            springs: place(SPRINGS)?,
            memory: place(MEMORY)?,
            fields: place(FIELDS)?,
            friction: place(FRICTION)?,
        })
    }

    /// Returns the tables of a folder under construction.
    pub fn drafted(folder: &Folder) -> Self {
        let at = |name: &str| folder.place(name).into();
        Self { springs: at(SPRINGS), memory: at(MEMORY), fields: at(FIELDS), friction: at(FRICTION) }
    }
}
