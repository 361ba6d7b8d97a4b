//! The command line of a steady motion.

use super::look::LookArguments;
use super::{assignment, course, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Find the steady motion of a drive without waiting for it: step, speed, how disturbances fade or grow

A drive is steady where a period of its waveforms brings it back to where it was, a step further. After a few plain periods \
Newton's method finds that motion, whether or not a run would ever come to it, or stay. Waveforms are taken to go on for ever, \
whatever number of cycles the scenario gives them; a waveform other than that of the figures that comes only once is over.

Prints the step with its error, the speed, and the Floquet multipliers in words: a disturbance comes back |λ| times as large \
after a period, and turns by the angle of λ. Writes steady.json, a picture of one period with the multipliers, and a checkpoint from \
which `stickslip resume DIR` goes on with the steady motion, for as long as the scenario's run is.

--continue PATH=FROM..TO follows the motion from where the scenario stands to both ends of a range of any number of it, also where it \
turns back and where no run would stay in it. Told at their places are folds (the branch turns back), period doublings, Neimark-Sacker \
bifurcations (a beat that neither fades nor grows), and events of a period that appear or vanish. Writes branch.csv, branch.json and \
the picture branch.png, stable motions solid, others dashed. Where the branch ends within the range, as where gross slip ceases, it says why.

Exit codes: 0 found, stable or not; 2 bad input, or a scene that has no steady motion to be found: without a period, with \
waveforms that have none in common or that a caller commands, with a body that nothing holds; 3 none was found, or \
something cannot be written; 130 interrupted. Nothing is written unless it was found; of a branch what was found, to \
branch-partial.csv, .json and .png, and a finished one stays beside them.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip steady drive.json
  stickslip steady drive.json --set contacts.ball.friction=0.3 --out here
  stickslip steady drive.json --continue waveforms.drive.sawtooth.stroke=\"50 nm..1 um\"
  stickslip steady drive.json --json                      one line, SI, the unit in each key
  stickslip steady drive.json && stickslip resume results/drive-steady";

#[derive(Debug, Args)]
pub(crate) struct SteadyArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Put a value into the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Local error per step of the runs, in natural scales, whatever the scenario's own stepper is: 1e-13 to 1e-6
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    /// Most periods to be computed
    #[arg(long, value_name = "N", default_value_t = 4000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) periods: u32,
    /// Follow the steady motion through a range of a number of the scenario, such as contacts.ball.friction=0.1..0.6
    #[arg(long = "continue", value_name = "PATH=FROM..TO", allow_hyphen_values = true, value_parser = course)]
    pub(crate) continued: Option<(String, String)>,
    /// How exactly places of a branch are told, as a share of the range: 1e-12 to 1e-3
    #[arg(long, value_name = "SHARE", default_value = "1e-9", value_parser = accuracy, requires = "continued")]
    pub(crate) accuracy: f64,
    /// Most motions of a branch on either side of its start
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = motions, requires = "continued")]
    pub(crate) points: usize,
    /// Folder of the files [default: results/NAME-steady, of a branch results/NAME-branch]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of tables; a number that is not finite is null
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress, no warnings, no tables; errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads how exactly places are told.
fn accuracy(text: &str) -> Result<f64, String> {
    let accuracy: f64 = text.parse().map_err(|_| "expected a number such as 1e-9".to_owned())?;
    let range = 1e-12..=1e-3;
    if range.contains(&accuracy) { Ok(accuracy) } else { Err("expected 1e-12 to 1e-3".to_owned()) }
}

/// Reads how many motions there may be.
fn motions(text: &str) -> Result<usize, String> {
    let most = text.parse().ok().filter(|most| (1..=100_000).contains(most));
    most.ok_or_else(|| "expected 1 to 100000".to_owned())
}
