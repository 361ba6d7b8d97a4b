//! The command line of validation.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;
use stickslip_validation::Subject;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compare the program with published results, and write the pages

Each page compares the program with a measurement, another program or a closed form: a measured impact, the boundary-element program \
CONTACT, oblique loading by Mindlin and Deresiewicz, oblique impact in theory and by finite elements, loading and hysteresis loops. A \
page has the computed quantity and method, the kind of reference, the tolerance and the deviation, a plot, tables and the limits of \
the comparison. No parameter is fitted, and the published numbers are part of the program.

All results are computed before the first file is written, in a few seconds. The result is reproducible. index.md, the overview, is \
written together with all pages. Exit codes: 0 done, 1 a tolerance is exceeded, 2 bad input, 3 a file cannot be written, 130 \
interrupted.";

pub(super) const EXAMPLES: &str = "\
Examples:
  stickslip-lab validate                           all pages into docs/validation/
  stickslip-lab validate contact --out pages       one page into pages/";

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
