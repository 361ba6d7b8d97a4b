//! The command line of golden results.

use crate::arguments::assignment;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Record reference results of scenarios and check whether they change: regression tests of trajectories

`record` runs scenarios and keeps an excerpt of each in DIR/NAME: some rows, the events, the figures, the SHA-256 of all rows \
and events, and the scenario. `check` runs the files as they are now and compares as `stickslip compare` does, so it finds \
changes of the program and of the scenario; the latter are reported first. `accept` replaces the recorded results that have changed by the new ones; you give a reason, which it adds to DIR/log.md. All use every core.

A golden result only detects changes: an error that it already had when it was recorded is not found.

The event stepper runs at a tolerance of 1e-12, whatever the file says, because at larger tolerances rounding changes the \
steps and cannot be distinguished from a real change. --own-tolerance keeps the tolerance of the file.

`check` prints one line per scenario:
  NAME: identical   rows and events have the same bytes
  NAME: equal       no difference exceeds its tolerance; the largest is given
  NAME: differs     the first difference; DIR/NAME/difference.png shows the largest
  NAME: gone        the scenario file does not exist
  NAME: damaged     the golden result is not as it was recorded

Exit codes: 0 all identical or equal, 1 one is not, 2 bad input, 3 a run stopped early or a file cannot be written, 130 \
interrupted.";

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
    /// Run scenarios and record their results
    Record(RecordArguments),
    /// Run the scenarios again and report what has changed
    Check(CheckArguments),
    /// Replace the results that have changed, with a reason
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
    /// Set a value of the scenarios, now and in each check, such as run.cycles=10 for a shorter run
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
    /// Names to check [default: all]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Write a JUnit XML report for CI services
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct AcceptArguments {
    /// Folder of the goldens
    #[arg(value_name = "DIR")]
    pub(crate) root: PathBuf,
    /// Names to accept [default: all that differ]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Why the results change
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}
