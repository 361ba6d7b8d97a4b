//! The command line of runs, begun and gone on with.

use super::assignment;
use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;

pub(super) const RUN_EXAMPLES: &str = "\
Examples:
  stickslip run drive.json
  stickslip run drive.json --out small --set waveforms.drive.sawtooth.stroke=\"70 nm\"
  stickslip run scenarios/*.json --threads 4 --json > summaries.jsonl
  stickslip run drive.json --set figures.steady_motion=false   without looking for what it settles on
  stickslip run drive.json --realtime                    as fast as it happens
  stickslip run drive.json --checkpoint-every \"30 s\"    can go on: stickslip resume results/drive";

pub(super) const RESUME_EXAMPLES: &str = "\
Examples:
  stickslip resume results/drive                           what was left of a run that was ended
  stickslip resume results/drive --set run.duration=\"2 s\"  longer than it was to be
  stickslip resume results/* --threads 4";

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Scenario files
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Folder of the results: NAME.json writes into DIR/NAME/
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub(crate) out: PathBuf,
    /// Put a value into every scenario, such as run.duration="20 ms" or contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Keep step with the clock on the wall: the run goes on from a row at t seconds when t seconds have passed, and says how
    /// far it was behind. Results are the same with it and without; `run.limits.wall` counts the waiting, too
    #[arg(long)]
    pub(crate) realtime: bool,
    /// Keep checkpoints in DIR/NAME/checkpoint, one every TIME on the wall, such as "30 s": `stickslip resume DIR/NAME` goes
    /// on from the last one. Results are the same with them and without
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub(crate) checkpoint_every: Option<f64>,
    #[command(flatten)]
    pub(crate) conduct: ConductArguments,
}

#[derive(Debug, Args)]
pub(crate) struct ResumeArguments {
    /// Folders of results with a checkpoint
    #[arg(required = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Give every run another end, such as run.duration="2 s" or run.cycles=2000
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Keep a checkpoint every TIME on the wall, such as "30 s"; by default as often as before
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub(crate) checkpoint_every: Option<f64>,
    #[command(flatten)]
    pub(crate) conduct: ConductArguments,
}

/// How runs are conducted and told of.
#[derive(Debug, Args)]
pub(crate) struct ConductArguments {
    /// Scenarios run at the same time, at most one per core
    #[arg(long, value_name = "N", default_value_t = 1, allow_hyphen_values = true, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: u16,
    /// Print the summaries to stdout, one line of JSON per scenario
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress, no warnings (but with --strict), no result for people; errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Exit code 3 where a run is warned of, such as energy books that do not close; its results are written all the same. What
    /// is odd about a scenario, which `check` tells, does not count
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
