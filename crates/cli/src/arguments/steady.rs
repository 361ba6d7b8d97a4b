//! The command line of periodic motions, one and many.

use super::look::LookArguments;
use super::{assignment, course, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Find the periodic motion of a drive without a long run: step, speed, stability

A drive is steady when each period of its waveforms repeats the same motion, shifted by one step. This periodic orbit is found by \
shooting: a few periods are run, then Newton's method solves for a fixed point of the Poincaré map, whether or not a run would \
converge to it. Waveforms are taken to continue for ever, whatever number of cycles the scenario gives.

Prints the step with its error, the speed, and the Floquet multipliers: after a period a disturbance is |λ| times as large. Writes \
steady.json, a plot of one period with the multipliers, and a checkpoint from which `stickslip run --resume DIR` continues the motion.

Exit codes: 0 found, stable or not; 2 bad input, or no periodic motion can exist: no period, no common period of all waveforms, a \
waveform that a caller commands, a body that nothing holds; 3 none was found, or a file cannot be written; 130 interrupted.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip steady drive.json
  stickslip steady drive.json --set contacts.ball.friction=0.3 --out here
  stickslip steady drive.json --json                      one line, SI, the unit in each key
  stickslip steady drive.json && stickslip run --resume results/drive-steady";

/// Long help of a branch.
pub(crate) const BRANCH_ABOUT: &str = "\
Follow the periodic motion while a parameter changes: folds, bifurcations

Starts from the periodic motion of the scenario and follows it to both ends of the range by pseudo-arclength continuation, around folds \
and where it is unstable. Reports folds, period doublings, Neimark-Sacker bifurcations, and parameter values at which an event, such as the start of slip, is added to the period or vanishes from it. \
Writes branch.csv, branch.json and the plot branch.png, stable motions solid, unstable ones dashed. If the branch ends within the range, \
for example because gross slip ceases, the reason is given.

Exit codes: 0 done; 2 bad input, or no periodic motion can exist; 3 none was found, or a file cannot be written; 130 interrupted: what \
was found is written to branch-partial.csv, .json and .png, and an earlier result is kept.";

pub(crate) const BRANCH_EXAMPLES: &str = "\
Examples:
  stickslip branch drive.json --vary waveforms.drive.sawtooth.stroke=\"50 nm..1 um\"
  stickslip branch drive.json --vary contacts.ball.friction=0.1..0.6 --json";

#[derive(Debug, Args)]
pub(crate) struct SteadyArguments {
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    /// Folder of the files [default: results/NAME-steady]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct BranchArguments {
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    /// The parameter and its range, such as contacts.ball.friction=0.1..0.6
    #[arg(long, value_name = "PATH=FROM..TO", required = true, allow_hyphen_values = true, value_parser = course)]
    pub(crate) vary: (String, String),
    /// Accuracy of special points as a share of the range, 1e-12 to 1e-3
    #[arg(long, value_name = "SHARE", default_value = "1e-9", value_parser = accuracy)]
    pub(crate) accuracy: f64,
    /// Maximum number of motions on either side of the start
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = motions)]
    pub(crate) points: usize,
    /// Folder of the files [default: results/NAME-branch]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// The search for a periodic motion, and how it is reported.
#[derive(Debug, Args)]
pub(crate) struct SearchArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Local error per step of the runs, relative to the natural scales of the contacts, 1e-13 to 1e-6; it replaces the scenario's own tolerance
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    /// Maximum number of periods to compute
    #[arg(long, value_name = "N", default_value_t = 4000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) periods: u32,
    /// Print one line of JSON instead of tables; numbers that are not finite are null
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no warnings, no tables
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads the accuracy of special points.
fn accuracy(text: &str) -> Result<f64, String> {
    let accuracy: f64 = text.parse().map_err(|_| "expected a number such as 1e-9".to_owned())?;
    let range = 1e-12..=1e-3;
    if range.contains(&accuracy) { Ok(accuracy) } else { Err("expected 1e-12 to 1e-3".to_owned()) }
}

/// Reads the maximum number of motions.
fn motions(text: &str) -> Result<usize, String> {
    let most = text.parse().ok().filter(|most| (1..=100_000).contains(most));
    most.ok_or_else(|| "expected 1 to 100000".to_owned())
}
