//! The program that computes results, as they name it.

/// Its name, whichever door was taken: results say what computed them, and that is the crates below all doors.
pub const NAME: &str = "stickslip";
/// Its version: all crates have one.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Name and version of this program.
pub fn this_program() -> String {
    format!("{NAME} {VERSION}")
}
