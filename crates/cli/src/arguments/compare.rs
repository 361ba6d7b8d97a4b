//! The command line of a comparison.

use crate::arguments::assignment;
use clap::Args;
use std::path::PathBuf;
use stickslip_compare::Terms;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compare the results of two runs within tolerances: channels, events, summary values

Folder A is the reference. Folder B must contain everything that A contains: every channel, at the times that A and B share; \
every event, with the same source and kind and in the same order; and the energies, steps and contact results of \
summary.json. Additional content of B is reported. Counts, timing, springs.csv and memory.csv are not compared.

The allowed difference of a number is max(absolute, relative × nominal):
  nominal    the channel's maximum magnitude in both runs; for energy.error_J the energy
             throughput; for steps the largest step; for numbers without unit at least 1
  relative   the value of --tolerance, or the value in the table below
  absolute   the value of --absolute, or 0.01 × relative × the natural scale of the contact
             (\"scales\" in summary.json)

  steppers of A and B            relative              tolerance of event times
  same stepper, same tolerance   1e-10                 1e-10 × compared time, at most 0.1 ns
  different tolerances           100 × larger of both  larger of both × compared time
  one with a fixed time step     1e-4                  one time step

The last line of the output is the verdict:
  identical  trace.csv and events.csv are byte-identical, and all summary values agree
  equal      no difference exceeds its tolerance; the line above gives the largest difference
  differs    a difference exceeds its tolerance; with --exact, there is any difference at all

Each folder must contain every table that summary.json lists, with the listed number of rows. An incomplete folder is bad input; \
the message names the file and the line. Rows on different time grids are compared at their common times, without \
interpolation. Runs of different duration are compared until the end of the shorter run. Contact states are not compared in \
rows at the time of an event. A row is left out if rounding can put an event before the row in one run and after the row in \
the other run.

Exit codes: 0 identical or equal, 1 differs, 2 bad input.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip compare results/p1 before/p1
  stickslip compare results/p1 before/p1 --plot difference.png
  stickslip compare a b --tolerance 1e-6 --time-tolerance \"1 us\"
  stickslip compare a b --absolute slider.x_m=\"1 nm\" --absolute energy.kinetic_J=1e-15
  stickslip compare a b --ignore still --json";

#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    /// Results folder of the reference run
    #[arg(value_name = "A")]
    pub(crate) a: PathBuf,
    /// Results folder of the run to be compared with A
    #[arg(value_name = "B")]
    pub(crate) b: PathBuf,
    /// Exit with code 1 unless trace.csv and events.csv are byte-identical
    #[arg(long)]
    pub(crate) exact: bool,
    /// Relative tolerance of all channels and summary values [default: as in the table above]
    #[arg(long, value_name = "R", allow_hyphen_values = true, value_parser = tolerance)]
    pub(crate) tolerance: Option<f64>,
    /// Absolute tolerance of a channel or summary value, such as slider.x_m="1 nm", in place of the default described above
    #[arg(long, value_name = "CHANNEL=VALUE", value_parser = assignment)]
    pub(crate) absolute: Vec<(String, String)>,
    /// Tolerance of event times, such as "1 ns" [default: as in the table above]
    #[arg(long, value_name = "T", allow_hyphen_values = true, value_parser = time)]
    pub(crate) time_tolerance: Option<f64>,
    /// Ignore a channel, a summary value, or all values of a body, contact or waveform
    #[arg(long, value_name = "NAME")]
    pub(crate) ignore: Vec<String>,
    /// Plot the channels with the largest differences into a PNG or SVG file
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Print the comparison to stdout as one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only; the exit code gives the verdict
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

impl CompareArguments {
    /// What is asked to be allowed.
    pub(crate) fn terms(&self) -> Terms {
        Terms {
            exact: self.exact,
            tolerance: self.tolerance,
            absolute: self.absolute.clone(),
            time_tolerance: self.time_tolerance,
            ignore: self.ignore.clone(),
        }
    }
}

/// A number of 0 or more.
fn tolerance(text: &str) -> Result<f64, String> {
    at_least_0(quantity(text, "")?)
}

/// A time of 0 or more.
fn time(text: &str) -> Result<f64, String> {
    at_least_0(quantity(text, "s")?)
}

fn at_least_0(value: f64) -> Result<f64, String> {
    if value >= 0.0 { Ok(value) } else { Err("expected a value of 0 or more".to_owned()) }
}
