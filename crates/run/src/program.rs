//! Name and version of the program.

/// Name of the program. It is the same for the command line, Python and Rust.
pub const NAME: &str = "stickslip";
/// Version of the program and of all its crates.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Returns name and version of this program.
pub fn this_program() -> String {
    format!("{NAME} {VERSION}")
}
