//! `stickslip schema`: the JSON Schema of the scenario file.

use stickslip_console::answer::say;
use stickslip_console::verdict::Verdict;

/// Prints the schema.
pub(crate) fn print() -> Verdict {
    say(format_args!("{}", stickslip_scenario::schema().trim_end()));
    Verdict::Done
}
