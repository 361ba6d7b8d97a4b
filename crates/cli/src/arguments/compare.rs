//! The command line of a comparison.

use crate::arguments::assignment;
use clap::Args;
use std::path::PathBuf;
use stickslip_compare::Terms;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Compare two folders of results: channels, events, figures

What A has B must have: every channel, at the times that both have; every event, by source, kind and order; the \
energies, the steps and the figures of the contacts in summary.json. What B has besides is said. Counts, timing, \
the columns of events.csv after the kind, springs.csv and memory.csv are not compared.

A number may differ by max(absolute, relative × nominal):
  nominal    the channel's largest magnitude in either run; for energy.error_J the energy that
             went through, for steps the longest step, for numbers without unit at least 1
  relative   --tolerance, or what the steppers decide
  absolute   --absolute, or 0.01 × relative × the scene's natural scale (u_c, μF_N, the velocity
             and the work they make: \"scales\" in summary.json): the rounding of what rests is
             no difference

  steppers of A and B               relative            events
  the same, at the same tolerance   1e-10               1e-10 of the time compared, at most 0.1 ns
  of different tolerances           100 × the larger    the larger × the time compared
  one of them at a fixed step       1e-4                one step

The same stepper does the same arithmetic in every build and on every machine.

The last line is the verdict:
  identical  trace.csv and events.csv have the same bytes, and no figure differs
  equal      no difference is larger than allowed; the line before says how large the largest is
  differs    one is
With --exact what is not identical differs.

Before anything is compared each folder must be whole: its tables those that summary.json has rows and hashes of, its \
scenario.json that of the run; as many rows and events as were counted, times that rise from 0 to the time reached, a row \
wherever output.every asks for one, the stepper and the contacts of the scenario. What is not so is damaged: bad input, with \
file and line. Results of versions without hashes are refused: run them again. What share of A's time and rows was compared \
is said. Where \"excerpt\" in A's summary.json says that its tables hold some of a run's rows, B must have all of these.

Rows on different grids are compared at common times; nothing is interpolated. Runs of different length, such as an \
interrupted one, are compared until the shorter ends, without figures of the whole. States in rows on an event are not compared. Rows on an event are left out \
where they may be before it in one run and after it in the other: where the steppers differ, where the times are \
rounded apart, and at the end of the shorter run.

With --json a number that is not finite, such as the distance from NaN, is null.

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
    /// Folder of results that is judged
    #[arg(value_name = "B")]
    pub(crate) b: PathBuf,
    /// Exit code 1 unless trace.csv and events.csv have the same bytes
    #[arg(long)]
    pub(crate) exact: bool,
    /// Relative tolerance, for all channels and figures [default: 1e-10 for the same stepper at the same tolerance, 100 × the larger
    /// tolerance else, 1e-4 beside a fixed step]
    #[arg(long, value_name = "R", allow_hyphen_values = true, value_parser = tolerance)]
    pub(crate) tolerance: Option<f64>,
    /// Absolute tolerance of a channel or figure, such as slider.x_m="1 nm", instead of that from the scene's scale
    #[arg(long, value_name = "CHANNEL=VALUE", value_parser = assignment)]
    pub(crate) absolute: Vec<(String, String)>,
    /// How far apart in time an event may be, such as "1 ns" [default: as in the table above]
    #[arg(long, value_name = "T", allow_hyphen_values = true, value_parser = time)]
    pub(crate) time_tolerance: Option<f64>,
    /// Leave out a channel or figure, or all of a body, contact or waveform, events included
    #[arg(long, value_name = "NAME")]
    pub(crate) ignore: Vec<String>,
    /// Draw the channels that differ most, both runs and their difference, as PNG or SVG; without it nothing is written
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Print all that was found to stdout as one line of JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only; the exit code tells the rest
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
