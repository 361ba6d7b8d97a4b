//! The command line of studies.

use super::look::LookArguments;
use super::threads::{Threads, Work};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Run thousands of variants of a scenario: grids, distributions, sensitivity indices

A study file names a scenario, the numbers that vary and the results to keep:

  { \"stickslip_study\": 1, \"scenario\": \"p1.json\", \"cases\": 1024,
    \"vary\": { \"contacts.ball.friction\": { \"uniform\": [0.1, 0.2] },
              \"bodies.slider.mass\": { \"normal\": [\"20 g\", \"1 g\"] },
              \"waveforms.drive.sawtooth.stroke\": { \"grid\": [\"0.4 um\", \"0.6 um\", 11] } },
    \"results\": [\"slider.x_m\", \"steps.last_m\"], \"chunk\": 1000 }

Variations are grid, log, list, uniform, normal, lognormal and triangular. Samples are drawn by \"sampling\": sobol (default), random, \
latin-hypercube or saltelli. `stickslip schema study` prints the schema with all keys. A number is named by its path in the scenario; \
a result is a path of summary.json, or a channel at the end of the run.

The result is a folder of Parquet files, one for each chunk of cases: pandas, polars and DuckDB read the folder as one table. Each row \
has the case, the numbers that vary in SI, the results, and the error of a case that failed. A finished part is never computed again: \
after an interruption, a power cut or on another computer, the same command computes what is missing. The bytes of a part depend on the \
study and on the version of the program only, not on threads, shards or the order of work.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip study check friction.json
  stickslip study plan friction.json                 cases, time and size before the run
  stickslip study run friction.json --threads 8
  stickslip study run friction.json --shard auto     in an array job of Slurm, PBS or Grid Engine
  stickslip study merge friction.json --csv friction.csv
  stickslip study indices friction.json              which number accounts for the scatter?
  stickslip study optimise fastest.json              largest or smallest result, and at which numbers";

#[derive(Debug, Subcommand)]
pub(crate) enum StudyCommand {
    /// Check a study file and its scenario, without running a case
    ///
    /// Exit codes: 0 no errors, 2 the file has errors.
    Check(CheckStudyArguments),
    /// Show the number of cases, the expected time and the size of the result
    ///
    /// Runs ten cases spread over the study and writes nothing. Exit codes: 0 done, 2 bad input, 130 interrupted.
    Plan(PlanStudyArguments),
    /// Run the cases whose parts are missing; resume after an interruption
    ///
    /// Prints quantiles of the results, failed cases by reason and the cases with extreme results. Exit codes: 0 done, failed cases
    /// included; 2 bad input, or the folder holds parts of another study; 3 all cases failed, or a part cannot be written; 130 interrupted.
    Run(RunStudyArguments),
    /// Show which parts are finished and which are missing
    ///
    /// Exit codes: 0 done, 2 bad input or parts of another study.
    Status(StatusStudyArguments),
    /// Write all parts into one CSV file
    ///
    /// Exit codes: 0 done; 2 bad input, or parts are missing; 3 the file cannot be written.
    Merge(MergeStudyArguments),
    /// Find the maximum or minimum of a result over numbers or over the shape of a waveform
    ///
    /// The study file has "maximise" or "minimise" and "over" or "waveform" instead of "vary" and "results". Local searches (Nelder-Mead)
    /// begin at several points. Each point is judged by the worst result at the period and at 0.99 and 1.01 times the period. The same
    /// command resumes an interrupted search. Writes optimum.json, optimum.png and, for a waveform, waveform.csv and waveform.json.
    /// Exit codes: 0 done; 2 bad input, or the folder holds another search; 3 all cases failed, or a file cannot be written;
    /// 130 interrupted.
    Optimise(OptimiseStudyArguments),
    /// Compute variance-based sensitivity indices (Sobol indices) of the results
    ///
    /// The first-order index is the share of the variance of a result that a number accounts for alone. The total index includes
    /// its interactions with other numbers. A study with "sampling": "saltelli" is used as it is. For another study, the command runs
    /// N (k + 2) cases for k distributions and N = "cases", and keeps their parts in the folder DIR-indices. Exit codes: as for run.
    Indices(IndicesStudyArguments),
}

#[derive(Debug, Args)]
pub(crate) struct OptimiseStudyArguments {
    /// Study file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Folder of the results [default: results/NAME-optimum]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) work: Work,
    /// Sample rate of waveform.csv, such as "1 MHz", adjusted to a whole number of samples per period [default: 1000 samples]
    #[arg(long, value_name = "RATE", allow_hyphen_values = true)]
    pub(crate) rate: Option<String>,
    /// Gain of the amplifier between generator and stack, by which the column "generator" is divided
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) gain: f64,
    /// Print one line of JSON instead of tables
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no warnings, no tables
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// A study, and where its parts are.
#[derive(Debug, Args)]
pub(crate) struct PlaceArguments {
    /// Study file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Folder of the parts [default: results/NAME-study]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct CheckStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    /// Print errors only, no warnings
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct PlanStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    #[command(flatten)]
    pub(crate) threads: Threads,
    /// Print one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct RunStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    #[command(flatten)]
    pub(crate) threads: Threads,
    /// Compute every n-th part only, beginning with part i, i from 1 to n; auto reads both from the environment of an array job
    #[arg(long, value_name = "i/n|auto")]
    pub(crate) shard: Option<String>,
    /// Remove the parts of this study first
    #[arg(long, conflicts_with = "shard")]
    pub(crate) fresh: bool,
    /// Print one line of JSON instead of tables
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no warnings, no tables
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct StatusStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    /// Print one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct MergeStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    /// CSV file to write
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct IndicesStudyArguments {
    #[command(flatten)]
    pub(crate) place: PlaceArguments,
    #[command(flatten)]
    pub(crate) threads: Threads,
    /// Print one line of JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no table
    #[arg(short, long)]
    pub(crate) quiet: bool,
}
