//! `stickslip schema`: the JSON Schema of the files that the program reads.

use clap::ValueEnum;
use stickslip_console::answer::say;
use stickslip_console::verdict::Verdict;

/// Kind of input file.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Kind {
    /// Scenario files
    Scenario,
    /// Study files
    Study,
    /// Recipes of measured tables
    Recipe,
}

/// Prints a schema.
pub(crate) fn print(kind: Kind) -> Verdict {
    let schema = match kind {
        Kind::Scenario => stickslip_scenario::schema(),
        Kind::Study => stickslip_scenario::study_schema(),
        Kind::Recipe => stickslip_record::recipe_schema(),
    };
    say(format_args!("{}", schema.trim_end()));
    Verdict::Done
}
