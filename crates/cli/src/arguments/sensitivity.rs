//! The command line of derivatives.

use super::look::LookArguments;
use super::{assignment, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Sensitivity of the results to every parameter, with error estimates

Each derivative is given in its units and as an elasticity: the change of the result in per cent for a change of the parameter \
by one per cent. Derivatives are extrapolated from runs on both sides of the parameter, at distances of 0.8 % to 0.0002 %; the \
error estimate covers curvature and measured noise.

If the slopes on the two sides differ, the result jumps, an event appears or vanishes, or one side is refused, there is no \
derivative: both sides are reported with the reason.

A result is a number of summary.json given by its path, the final value of a channel such as slider.x_m, or steady.step_m and \
steady.speed_m_s of the periodic motion. Parameters are all numbers of the scenario except zeros, counts and settings of the \
run; --to replaces this list.

Writes sensitivity.csv, sensitivity.json and the plot sensitivity.png. The result does not depend on the number of threads. \
Exit codes: 0 done, 2 bad input, 3 the scenario's run stops, has no periodic motion, no derivative is known, or a file cannot \
be written, 130 interrupted: finished derivatives are in sensitivity-partial.csv, .json and .png, and an earlier result is \
kept.";

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
    /// Results [default: step, speed, losses, ringing; without a drive: dissipated energy and forces of each contact]
    #[arg(long, value_name = "FIGURE", num_args = 1..)]
    pub(crate) of: Vec<String>,
    /// Key paths of parameters, such as contacts.ball.friction [default: all of bodies, contacts, actuators and waveforms]
    #[arg(long, value_name = "PATH", num_args = 1..)]
    pub(crate) to: Vec<String>,
    /// Include step and speed of the periodic motion
    #[arg(long)]
    pub(crate) steady: bool,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Local error per step of the runs, relative to the natural scales of the contacts, 1e-13 to 1e-6; it replaces the scenario's own tolerance
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    /// Runs at the same time [default: the number of cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Folder of the files [default: results/NAME-sensitivity]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of tables; numbers that are not finite are null
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only: no progress, no warnings, no tables
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}
