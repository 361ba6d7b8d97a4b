//! Name and version of the program.

/// Name of the program. The command line program, the Python package and the Rust crates use the same name.
pub const NAME: &str = "stickslip";
/// Version of the program and of all its crates.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Returns name and version of this program.
pub fn this_program() -> String {
    format!("{NAME} {VERSION}")
}
