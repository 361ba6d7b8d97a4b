//! The command line of periodic motions, one and many.

use super::look::LookArguments;
use super::{assignment, course, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Find the periodic orbit of a drive without a long run: step, speed, stability

On a periodic orbit, every period of the waveforms repeats the same motion, shifted by one step. The command finds the periodic orbit \
by shooting: a few periods are simulated, then Newton's method solves for a fixed point of the Poincaré map. Shooting also finds \
unstable periodic orbits, to which no run converges. Waveforms are assumed to continue without end, even if the scenario limits the \
number of cycles.

Prints the step length with its error, the speed, and the Floquet multipliers λ. A small disturbance changes by the factor |λ| in \
each period. Writes steady.json, a plot of one period with the multipliers, and a checkpoint. `stickslip run --resume DIR` continues \
the motion from the checkpoint.

Exit codes: 0 a periodic orbit was found, stable or not; 2 bad input, or no periodic orbit can exist; 3 no periodic orbit was found, \
or a file cannot be written; 130 interrupted. No periodic orbit can exist if the waveforms have no common period, if a calling \
program commands a waveform, or if nothing holds a body.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip steady drive.json
  stickslip steady drive.json --set contacts.ball.friction=0.3 --out here
  stickslip steady drive.json --json                      one line, SI, the unit in each key
  stickslip steady drive.json && stickslip run --resume results/drive-steady";

/// Long help of a branch.
pub(crate) const BRANCH_ABOUT: &str = "\
Follow the periodic orbit while a parameter changes: folds, bifurcations

The command starts from the periodic orbit of the scenario and follows this orbit to both ends of the parameter range. The method is \
pseudo-arclength continuation, which also follows the branch around folds and along unstable orbits. The command reports folds, \
period doublings and Neimark-Sacker bifurcations. It also reports parameter values at which an event of the period, such as the start \
of slip, appears or disappears. If the branch ends within the range, for example because gross slip ceases, the command gives the \
reason. Writes branch.csv, branch.json and the plot branch.png. In the plot, lines are solid for stable orbits and dashed for \
unstable orbits.

Exit codes: 0 done; 2 bad input, or no periodic orbit can exist; 3 no periodic orbit was found, or a file cannot be written; 130 \
interrupted. An interrupted command writes the orbits found so far to branch-partial.csv, .json and .png and keeps earlier results. \
The same command then resumes where it was interrupted or killed: finished steps are in branch.journal until the branch is complete.";

pub(crate) const BRANCH_EXAMPLES: &str = "\
Examples:
  stickslip branch drive.json --vary waveforms.drive.sawtooth.stroke=\"50 nm..1 um\"
  stickslip branch drive.json --vary contacts.ball.friction=0.1..0.6 --json";

#[derive(Debug, Args)]
pub(crate) struct SteadyArguments {
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    /// Folder for the output files [default: results/NAME-steady]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct BranchArguments {
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    /// Parameter to vary and its range, such as contacts.ball.friction=0.1..0.6
    #[arg(long, value_name = "PATH=FROM..TO", required = true, allow_hyphen_values = true, value_parser = course)]
    pub(crate) vary: (String, String),
    /// Accuracy of the parameter value at folds and bifurcations, as a share of the range, 1e-12 to 1e-3
    #[arg(long, value_name = "SHARE", default_value = "1e-9", value_parser = accuracy)]
    pub(crate) accuracy: f64,
    /// Maximum number of periodic motions computed on each side of the start
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = motions)]
    pub(crate) points: usize,
    /// Begin anew instead of resuming an interrupted command
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Folder for the output files [default: results/NAME-branch]
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
    /// Local error per time step, relative to the natural scales of the contacts, 1e-13 to 1e-6; replaces the tolerance of the scenario
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    /// Maximum number of periods that the search may simulate
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
