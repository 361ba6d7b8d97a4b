//! The command line of fits.

use super::assignment;
use super::look::LookArguments;
use super::reading::ReadingArguments;
use super::threads::Threads;
use clap::Args;
use std::path::PathBuf;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Fit parameters of a scenario to a measured loop or trajectory: values, intervals, correlations

The command finds the values of the free parameters with the least squares of the force, by the method of Levenberg and Marquardt. A \
file of several cycles is averaged to its mean loop, as in `stickslip measure`. The contact of the scenario is moved along the \
measured displacement, and its steady loop is compared with the measured force. A constant offset of the force is allowed.

--displacement COLUMN=CHANNEL selects another displacement. If the channel belongs to a body that follows a waveform, the body is \
moved along the measured loop instead of its waveform, together with the parts in between, such as the spring of a rig. For any other \
channel the scenario runs unchanged, and the rows of both channels are compared over time.

Intervals contain the true value in 95 of 100 cases if the model is right. The noise is estimated from the data or given by --noise. \
If the data cannot distinguish some parameters, the command names these parameters and fails. A loop at constant load determines only \
\u{3bc}F_N and the stiffness 2G*a. If the residual is larger than the noise, the command reports that the model does not fit.

Writes fit.json and the plot fit.png with the residual. Exit codes: 0 done, 2 bad input or parameters that cannot be distinguished, 3 \
a file cannot be written, 130 interrupted.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip fit ball.json --data rig.csv --free contacts.ball.friction,contacts.ball.profile.paraboloid.radius
  stickslip fit rig.json --data rig.csv --free contacts.ball.friction,springs.arm.stiffness \\
    --displacement disp=rig.x --force F=ball.fx
  stickslip fit ball.json --data rig.csv --free contacts.ball.friction --noise \"20 mN\" --bootstrap 500";

#[derive(Debug, Args)]
pub(crate) struct FitArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Table of an instrument
    #[arg(long, value_name = "TABLE")]
    pub(crate) data: PathBuf,
    /// Key paths of the free parameters
    #[arg(long, value_name = "PATH", value_delimiter = ',', required = true, num_args = 1..)]
    pub(crate) free: Vec<String>,
    #[command(flatten)]
    pub(crate) reading: ReadingArguments,
    /// Name of the contact; required if the scenario contains several contacts
    #[arg(long, value_name = "NAME")]
    pub(crate) contact: Option<String>,
    /// Standard deviation of the noise of the force, such as "20 mN" [default: estimated from the data]
    #[arg(long, value_name = "F", value_parser = force)]
    pub(crate) noise: Option<f64>,
    /// Number of random data sets from which the intervals are taken [default: intervals of the linear theory]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub(crate) bootstrap: usize,
    /// Set a value of the scenario, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Folder for the output files [default: results/NAME-fit]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of the table
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) threads: Threads,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

fn force(text: &str) -> Result<f64, String> {
    let value = quantity(text, "N")?;
    if value > 0.0 { Ok(value) } else { Err("expected more than 0 N".to_owned()) }
}
