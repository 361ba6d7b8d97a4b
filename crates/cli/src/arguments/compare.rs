//! The command line of a comparison.

use crate::arguments::assignment;
use clap::Args;
use std::path::PathBuf;
use stickslip_compare::Terms;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compare two results within tolerances: channels, events, summary values

B must have everything that A has: every channel, at the times that both have; every event, by source, kind and order; the \
energies, steps and contact figures of summary.json. Additional content of B is reported. Counts, timing, springs.csv and \
memory.csv are not compared.

A number may differ by max(absolute, relative × nominal):
  nominal    the channel's maximum magnitude in either run; for energy.error_J the energy
             throughput, for steps the largest step, for numbers without unit at least 1
  relative   --tolerance, or by the steppers
  absolute   --absolute, or 0.01 × relative × the natural scale of the contact (\"scales\" in
             summary.json)

  steppers of A and B               relative            events
  the same, at the same tolerance   1e-10               1e-10 of the time compared, at most 0.1 ns
  of different tolerances           100 × the larger    the larger × the time compared
  one of them at a fixed step       1e-4                one step

The last line is the verdict:
  identical  trace.csv and events.csv have the same bytes, and no figure differs
  equal      no difference exceeds its tolerance; the line before gives the largest
  differs    a difference exceeds its tolerance; with --exact everything but identical

Each folder must be complete: every table that summary.json lists, with its number of rows and events. Anything else is damaged, which \
is bad input, with file and line. Rows on different time grids are compared at common times; nothing is interpolated. Runs of \
different length are compared until the shorter one ends. States, and rows at an event whose time is rounded differently, are \
not compared.

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
    /// Folder of results: the reference
    #[arg(value_name = "A")]
    pub(crate) a: PathBuf,
    /// Folder of results: compared with the reference
    #[arg(value_name = "B")]
    pub(crate) b: PathBuf,
    /// Exit code 1 unless trace.csv and events.csv have the same bytes
    #[arg(long)]
    pub(crate) exact: bool,
    /// Relative tolerance of all channels and figures [default: as in the table above]
    #[arg(long, value_name = "R", allow_hyphen_values = true, value_parser = tolerance)]
    pub(crate) tolerance: Option<f64>,
    /// Absolute tolerance of a channel or figure, such as slider.x_m="1 nm", instead of that from the natural scale
    #[arg(long, value_name = "CHANNEL=VALUE", value_parser = assignment)]
    pub(crate) absolute: Vec<(String, String)>,
    /// Tolerance of event times, such as "1 ns" [default: as in the table above]
    #[arg(long, value_name = "T", allow_hyphen_values = true, value_parser = time)]
    pub(crate) time_tolerance: Option<f64>,
    /// Ignore a channel or figure, or everything of a body, contact or waveform
    #[arg(long, value_name = "NAME")]
    pub(crate) ignore: Vec<String>,
    /// Plot the channels that differ most, as PNG or SVG
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Print the comparison to stdout as one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only; the exit code is the result
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
