//! The command line of golden results.

use crate::arguments::assignment;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Record reference results of scenarios; check later whether the results change

`record` runs scenarios and stores a reference result of each scenario in DIR/NAME. A reference result contains the scenario, some \
rows, the events, the summary values, and the SHA-256 of all rows and events. `check` runs the present scenario files and compares \
their results with the reference results, as `stickslip compare` does. `check` detects changes of the program and of the \
scenario, and reports changes of the scenario first. `accept` replaces the reference results that differ from the present \
results. You give a reason, and `accept` adds the reason to DIR/log.md. All three commands use all processor cores.

A reference result only detects changes. An error that was present when the result was recorded is not detected.

The stepper `event` runs at a tolerance of 1e-12 instead of the tolerance in the scenario. At larger tolerances, rounding errors \
alter the time steps, and such differences look like real changes. --own-tolerance keeps the tolerance of the scenario.

`check` prints one line per scenario:
  NAME: identical   rows and events are byte-identical
  NAME: equal       no difference exceeds its tolerance; the line gives the largest difference
  NAME: differs     the line gives the first difference; DIR/NAME/difference.png shows
                    the largest difference
  NAME: gone        the scenario file does not exist
  NAME: damaged     the stored reference result was altered after recording

Exit codes: 0 all results are identical or equal; 1 a result is not; 2 bad input; 3 a run stopped early, or a file cannot be \
written; 130 interrupted.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip golden record drives/*.json --out golden
  stickslip golden record long.json --out golden --set run.cycles=10
  stickslip golden check golden --junit golden.xml
  stickslip golden accept golden --reason \"preload measured anew: 12 N\"
  stickslip golden accept golden stage walker --reason \"a softer spring\"

In CI, with the folders golden/ and drives/ in the repository:
  stickslip golden check golden --junit golden.xml || exit 1";

#[derive(Debug, Subcommand)]
pub(crate) enum GoldenCommand {
    /// Run scenarios and record their results as reference results
    Record(RecordArguments),
    /// Run the scenarios again and report what has changed
    Check(CheckArguments),
    /// Replace the reference results that have changed, and log the reason
    Accept(AcceptArguments),
}

#[derive(Debug, Args)]
pub(crate) struct RecordArguments {
    /// Scenario files
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Folder of the reference results
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Set a value of the scenarios, now and in every later check, such as run.cycles=10 for a shorter run
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Ignore a channel, a summary value, or all values of a body, contact or waveform
    #[arg(long, value_name = "NAME")]
    pub(crate) ignore: Vec<String>,
    /// Run at the tolerance of the scenario instead of 1e-12
    #[arg(long)]
    pub(crate) own_tolerance: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Folder of the reference results
    #[arg(value_name = "DIR")]
    pub(crate) root: PathBuf,
    /// Names of the reference results to check [default: all]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Write a JUnit XML report for CI services
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct AcceptArguments {
    /// Folder of the reference results
    #[arg(value_name = "DIR")]
    pub(crate) root: PathBuf,
    /// Names of the reference results to replace [default: all that differ]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// Reason for the change of the results, for DIR/log.md
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}
