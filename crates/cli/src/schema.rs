//! `stickslip schema`: the JSON Schema of the scenario file.

use crate::verdict::Verdict;
use std::io::Write;

/// Prints the schema. A reader that has seen enough and closes the pipe is no fault.
pub(crate) fn print() -> Verdict {
    let _ = std::io::stdout().write_all(stickslip_scenario::schema().as_bytes());
    Verdict::Done
}
