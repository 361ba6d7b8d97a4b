//! The command line of derivatives.

use super::look::LookArguments;
use super::{assignment, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Tell which numbers matter: by how much figures of a run change with each number of its scenario, each with its error

Each derivative is told in the units of both, and as elasticity: by how many per cent the figure changes with one per cent of the \
quantity. Runs on both sides of each number, at distances from 0.8 % to 0.0002 % of it, are extrapolated to the number itself; the \
distances that count are those at which bends and noise leave the least error. Noise is measured.

Where the slopes on both sides differ, where the figure jumps, where something else happens on one side (an event appears or \
vanishes, however near) or where one side is refused, there is no derivative: both sides are told, and why.

Figures are numbers of summary.json by their path, channels at the end of the run such as slider.x_m, and steady.step_m and \
steady.speed_m_s of the motion that `stickslip steady` finds. Quantities are all numbers of the scenario but 0, whole numbers, and \
what only says how the run is run; others are named by --to.

Writes sensitivity.csv, sensitivity.json and the picture sensitivity.png into results/NAME-sensitivity. The same bytes for any number \
of threads. Exit codes: 0 done, 2 bad input, 3 the scenario's own run stops or has no steady motion, no derivative is known, or the \
files cannot be written, 130 interrupted; the derivatives that were done are then written to \
sensitivity-partial.csv, .json and .png, and finished ones stay beside them.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip sensitivity drive.json
  stickslip sensitivity drive.json --of steps.last_m contacts.ball.peak_fx_N
  stickslip sensitivity drive.json --to contacts.ball.friction bodies.slider.mass
  stickslip sensitivity drive.json --of steady.step_m --json
  stickslip sensitivity drive.json --of slider.x_m --set run.duration=\"3 ms\"";

#[derive(Debug, Args)]
pub(crate) struct SensitivityArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Figures [default: steps, speed, what is lost, ringing; or else loops of the contacts]
    #[arg(long, value_name = "FIGURE", num_args = 1..)]
    pub(crate) of: Vec<String>,
    /// Key paths of quantities, such as contacts.ball.friction [default: all numbers of what there is and what drives it]
    #[arg(long, value_name = "PATH", num_args = 1..)]
    pub(crate) to: Vec<String>,
    /// Step and speed of steady motion as well
    #[arg(long)]
    pub(crate) steady: bool,
    /// Put a value into the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Local error per step of the runs, in natural scales, whatever the scenario's own stepper is: 1e-13 to 1e-6
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    /// Runs at a time; as many as there are cores by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Folder of the files [default: results/NAME-sensitivity]
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
