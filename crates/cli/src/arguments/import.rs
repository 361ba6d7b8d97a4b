//! The command line of imports.

use super::reading::ReadingArguments;
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Show how a measured table is read; write the recipe

The command reads the table of an instrument: a log of a rig, an oscilloscope, a tribometer or a profilometer. It finds encoding \
(UTF-8, UTF-16, Latin-1), delimiter, decimal sign, lines before the first row, units, start and increment of scopes, clock times and \
missing values. It prints the meaning of each column with its first three rows.

--out writes a recipe, a JSON file with these settings. Each key can be changed or left out. The program determines keys that are \
left out. The value of a column is gain x cell + offset, in the unit of the column. `stickslip measure` takes the recipe with \
--recipe. The program counts the lines that it skips: empty lines, comments, lines of words and rows with a missing value.

Units: ns to h, nm to m, mil, in, uN to MN, gf, kgf, lbf; g and kg of a force are weights. Exit codes: 0 done, 2 bad input, 3 a file \
cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip import rig.csv
  stickslip import rig.txt --displacement 2:mm --force 3:kN --out rig-recipe.json
  stickslip measure rig.txt --recipe rig-recipe.json";

#[derive(Debug, Args)]
pub(crate) struct ImportArguments {
    /// Table of an instrument
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArguments,
    /// Recipe to write
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Print the recipe as one line of JSON instead of the table
    #[arg(long)]
    pub(crate) json: bool,
}
