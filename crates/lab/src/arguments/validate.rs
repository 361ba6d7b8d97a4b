//! The command line of validation.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;
use stickslip_validation::Subject;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compute what is known from elsewhere, and write pages that show both

Each page compares the program with something measured, computed by another program or in closed form: a measured impact, the \
boundary-element program CONTACT, Mindlin and Deresiewicz' oblique loading, oblique impact in theory and by finite elements, \
loading and loops. It says what is computed and how, what it is compared with and of what kind that is, how far apart the two may \
be and are, with a picture, tables and what the comparison does not show. Nothing is fitted, and the published numbers are part of \
the program.

Everything is computed before the first file is written, in a few seconds; the same is written every time. README.md, the page of \
all pages, is written when all are asked for. Exit codes: 0 done, 1 something asked is not kept, 2 bad input, 3 something cannot be \
written, 130 interrupted.";

pub(super) const EXAMPLES: &str = "\
Examples:
  stickslip-lab validate                           all pages into docs/validation/
  stickslip-lab validate contact --out pages       one of them into pages/";

#[derive(Debug, Args)]
pub(crate) struct ValidateArguments {
    /// Pages to write; all by default
    #[arg(value_name = "PAGE", value_parser = subjects())]
    pub(crate) pages: Vec<Subject>,
    /// Folder of the pages: OUT/PAGE.md and OUT/PAGE.png
    #[arg(long, value_name = "OUT", default_value = "docs/validation")]
    pub(crate) out: PathBuf,
    /// No progress, no result; errors and what is not kept only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Reads the name of a page.
fn subjects() -> impl TypedValueParser<Value = Subject> {
    let names = PossibleValuesParser::new(Subject::ALL.map(Subject::name));
    names.try_map(|given| {
        Subject::ALL.into_iter().find(|subject| subject.name() == given).ok_or("no such page")
    })
}
