//! The command line of derivatives.

use super::look::LookArguments;
use super::threads::Work;
use super::{assignment, shooting};
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compute the sensitivity of results to every parameter, with error estimates

The command computes the derivative of each result with respect to each parameter. Each derivative is given in units and as an \
elasticity. The elasticity is the change of the result in per cent for a change of the parameter by one per cent. Derivatives are \
extrapolated from four runs or more with the parameter changed by 0.8 % to 0.0002 % to both sides. The error estimate covers \
curvature and numerical noise.

A derivative does not exist if the slopes on the two sides of the parameter value differ, if the result jumps, if an event appears or \
disappears, or if the parameter value on one side is refused. The command then reports each side separately, with the reason.

A result is a number of summary.json given by its path; the final value of a channel, such as slider.x_m; or steady.step_m or \
steady.speed_m_s of the periodic orbit. Parameters are all numbers of the scenario except zeros, counts and settings of the run, or \
the parameters given by --to.

Writes sensitivity.csv, sensitivity.json and the plot sensitivity.png. The results do not depend on the number of threads. Exit \
codes: 0 done; 2 bad input; 3 the run of the scenario stops early, the periodic orbit or all derivatives are missing, or a file \
cannot be written; 130 interrupted. An interrupted command writes finished derivatives to sensitivity-partial.csv, .json and .png and \
keeps earlier results. The same command then resumes where it was interrupted or killed: finished runs are in sensitivity.journal \
until all derivatives are known.";

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
    /// Results to differentiate [default: step, speed, losses and ringing of a drive; without a drive, dissipated energy and forces of each
    /// contact]
    #[arg(long, value_name = "FIGURE", num_args = 1..)]
    pub(crate) of: Vec<String>,
    /// Key paths of parameters, such as contacts.ball.friction [default: all of bodies, contacts, actuators and waveforms]
    #[arg(long, value_name = "PATH", num_args = 1..)]
    pub(crate) to: Vec<String>,
    /// Add step and speed of the periodic motion to the results
    #[arg(long)]
    pub(crate) steady: bool,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Local error per time step, relative to the natural scales of the contacts, 1e-13 to 1e-6; replaces the tolerance of the scenario
    #[arg(long, value_name = "SHARE", default_value = "1e-12", value_parser = shooting)]
    pub(crate) tolerance: f64,
    #[command(flatten)]
    pub(crate) work: Work,
    /// Folder for the output files [default: results/NAME-sensitivity]
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
