//! The command line of runs, new and resumed.

use super::assignment;
use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;

pub(super) const RUN_EXAMPLES: &str = "\
Examples:
  stickslip run drive.json
  stickslip run drive.json --out small --set waveforms.drive.sawtooth.stroke=\"70 nm\"
  stickslip run scenarios/*.json --threads 4 --json > summaries.jsonl
  stickslip run drive.json --set figures.steady_motion=false   without the search for the periodic orbit
  stickslip run drive.json --checkpoint-every \"30 s\"
  stickslip run --resume results/drive                           finish a run that was interrupted or killed
  stickslip run --resume results/drive --set run.duration=\"2 s\"  extend a run";

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Scenario files
    #[arg(required_unless_present = "resume", value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Resume runs from the checkpoints in these results folders. A run continues to the end given in the scenario, or to the end given
    /// by --set (run.duration or run.cycles only). The results are byte-identical to the results of an uninterrupted run
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = ["files", "out", "realtime"])]
    pub(crate) resume: Vec<PathBuf>,
    /// Folder for the results: the results of NAME.json are written to DIR/NAME/
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub(crate) out: PathBuf,
    /// Set a value of every scenario, such as run.duration="20 ms" or contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Run no faster than real time, and report the largest delay behind the clock; the results do not change
    #[arg(long)]
    pub(crate) realtime: bool,
    /// Write a checkpoint for --resume to DIR/NAME/checkpoint every TIME of wall-clock time, such as "30 s"; the results do not change
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub(crate) checkpoint_every: Option<f64>,
    #[command(flatten)]
    pub(crate) conduct: ConductArguments,
}

/// How runs are conducted and reported.
#[derive(Debug, Args)]
pub(crate) struct ConductArguments {
    /// Maximum number of scenarios that run in parallel, limited to the number of processor cores
    #[arg(long, value_name = "N", default_value_t = 1, allow_hyphen_values = true, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: u16,
    /// Print the summary of each scenario to stdout as one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no results; warnings are printed only with --strict
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Exit with code 3 if the results of a run have a warning, for example of a violated energy balance. Warnings about the scenario,
    /// which `check` reports, do not count
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads a time above 0, s.
pub(super) fn interval(text: &str) -> Result<f64, String> {
    let seconds = stickslip_scenario::quantity(text, "s")?;
    if seconds > 0.0 { Ok(seconds) } else { Err("expected a time above 0, such as \"30 s\"".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_a_time_above_zero() {
        assert_eq!((interval("30 s"), interval("2 min"), interval("1 ms")), (Ok(30.0), Ok(120.0), Ok(1e-3)));
        assert!(interval("0 s").is_err() && interval("-1 s").is_err() && interval("30 m").is_err());
    }
}
