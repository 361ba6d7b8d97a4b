//! The command line of golden results.

use crate::arguments::assignment;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Keep what scenarios come to, and find out when that changes: regression tests of trajectories

`record` runs scenarios and keeps of each an excerpt in DIR/NAME: some rows, the events, the figures, the SHA-256 of all rows and \
events, the scenario as it was run. `check` runs the files, as they are now, and compares as `stickslip compare` does; so a change of \
the program and one of a scenario are both found, and the latter is named first. `accept` keeps what has changed, for a reason that it \
writes into DIR/log.md. All three use every core.

Goldens guard against change, no more: what was wrong when it was recorded stays wrong.

The event stepper runs at a tolerance of 1e-12 here, whatever the file asks for: at larger ones another rounding of a sum chooses other \
steps, and its effect cannot be told from a real one. With --own-tolerance the file's is kept.

What `check` prints, a line a scenario:
  NAME: identical   the rows and the events have the same bytes
  NAME: equal       no difference is larger than allowed, with the largest; a changed value in a scenario is never equal
  NAME: differs     with the first difference; DIR/NAME/difference.png shows what differs most
  NAME: gone        its file is not there
  NAME: damaged     its golden is not what was recorded

Exit codes: 0 all are identical or equal, 1 one is not, 2 bad input: no golden, no reason, a file that is refused, 3 a run stopped \
itself or something could not be written, 130 interrupted.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip golden record drives/*.json --out golden
  stickslip golden record long.json --out golden --set run.cycles=10
  stickslip golden check golden --junit golden.xml
  stickslip golden accept golden --reason \"preload measured anew: 12 N\"
  stickslip golden accept golden stage walker --reason \"a softer spring\"

In CI, beside the scenarios in golden/ and drives/:
  stickslip golden check golden --junit golden.xml || exit 1";

#[derive(Debug, Subcommand)]
pub(crate) enum GoldenCommand {
    /// Run scenarios and keep what they come to
    Record(RecordArguments),
    /// Run the scenarios of all goldens and say what has changed
    Check(CheckArguments),
    /// Keep what has changed, for a reason
    Accept(AcceptArguments),
}

#[derive(Debug, Args)]
pub(crate) struct RecordArguments {
    /// Scenario files
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Folder of the goldens
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Override a value of the scenarios, now and in each check, such as run.cycles=10 for a shorter run
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Do not compare a channel or figure, or all of a body, contact or waveform
    #[arg(long, value_name = "NAME")]
    pub(crate) ignore: Vec<String>,
    /// Run at the tolerance of the file instead of 1e-12
    #[arg(long)]
    pub(crate) own_tolerance: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Folder of the goldens
    #[arg(value_name = "DIR")]
    pub(crate) root: PathBuf,
    /// Those that are checked [default: all]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Write what was found as JUnit XML, which CI services show
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct AcceptArguments {
    /// Folder of the goldens
    #[arg(value_name = "DIR")]
    pub(crate) root: PathBuf,
    /// Those that are accepted [default: all that differ]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Why the results change
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}
