//! Names of the files of a run, and the columns of those with the same columns in every run.

/// Rows over time.
pub const TRACE: &str = "trace.csv";
/// Events, with the row after each.
pub const EVENTS: &str = "events.csv";
/// What every spring does over time, where that is asked for.
pub const SPRINGS: &str = "springs.csv";
/// The memory curves at some moments, where they are asked for.
pub const MEMORY: &str = "memory.csv";
/// Every cycle of contacts that come back.
pub const CYCLES: &str = "cycles.csv";
/// The scenario as it was run.
pub const SCENARIO: &str = "scenario.json";
/// What the run came to.
pub const SUMMARY: &str = "summary.json";

/// Columns of [`SPRINGS`].
pub(crate) const SPRING_HEAD: &[&str] = &["time_s", "contact", "x_m", "stretch_m", "state"];
/// Columns of [`MEMORY`].
pub(crate) const MEMORY_HEAD: &[&str] = &["time_s", "contact", "d_m", "u_m", "h_m", "p_m"];
