//! Names of the files of a run, and the columns of those with the same columns in every run.

use crate::folder::Folder;
use crate::seal::SealedTable;

/// Rows over time.
pub const TRACE: &str = "trace.csv";
/// Events, with the row after each.
pub const EVENTS: &str = "events.csv";
/// What every spring does over time, where that is asked for.
pub const SPRINGS: &str = "springs.csv";
/// The memory curves at some moments, where they are asked for.
pub const MEMORY: &str = "memory.csv";
/// Stress and displacement under the contacts at some moments, where they are asked for.
pub const FIELDS: &str = "fields.csv";
/// Where friction has done its work by then, over the radius.
pub const FRICTION: &str = "friction.csv";
/// What goes on inside the contacts, each where it is asked for.
pub const INSIDES: [&str; 4] = [SPRINGS, MEMORY, FIELDS, FRICTION];
/// Every cycle of contacts that come back.
pub const CYCLES: &str = "cycles.csv";
/// Every step of a drive.
pub const STEPS: &str = "steps.csv";
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
/// The steady motion of a drive, found without a run.
pub const STEADY: &str = "steady.json";
/// Steady motions one after another, as a number of a scenario changes.
pub const BRANCH: &str = "branch.json";
/// The same of a branch that was interrupted: a finished one stays beside it.
pub const PARTIAL_BRANCH: &str = "branch-partial.json";

/// Columns of [`SPRINGS`].
pub(crate) const SPRING_HEAD: &[&str] =
    &["time_s", "contact", "x_m", "stretch_m", "state", "g_m", "fx_N", "fz_N", "limit_N"];
/// Columns of [`MEMORY`].
pub(crate) const MEMORY_HEAD: &[&str] = &["time_s", "contact", "d_m", "u_m", "h_m", "p_m"];
/// Columns of [`FIELDS`].
pub(crate) const FIELD_HEAD: &[&str] =
    &["time_s", "contact", "r_m", "p_Pa", "tau_Pa", "u_m", "slip_m", "w_m", "state", "error_Pa", "error_m"];
/// Columns of [`FRICTION`].
pub(crate) const FRICTION_HEAD: &[&str] = &["time_s", "contact", "r_m", "work_J_m2", "way_m"];

/// Columns of [`STEPS`]: number, both times, length, where the body was at first, the least and the largest place within.
pub const STEP_HEAD: &[&str] = &["period", "start_s", "end_s", "length_m", "x_m", "least_m", "largest_m"];
/// The tables whose columns are the same in every run, with these; of `events.csv` the ones before those of the trace.
pub fn heads() -> [(&'static str, &'static [&'static str]); 7] {
    [
        (EVENTS, &["source", "kind"]),
        (SPRINGS, SPRING_HEAD),
        (MEMORY, MEMORY_HEAD),
        (FIELDS, FIELD_HEAD),
        (FRICTION, FRICTION_HEAD),
        (CYCLES, &crate::cycles_table::HEAD),
        (STEPS, STEP_HEAD),
    ]
}

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
