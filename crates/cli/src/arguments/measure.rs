//! The command line of measured loops.

use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Evaluate measured hysteresis loops of a table, beside a simulated one

Reports amplitudes, dissipated energy, opening, energy ratios and stiffness of every cycle. Reads displacement and tangential \
force, and time if there is one, from a CSV file whose first line names the columns with their units, as in \"t [ms],disp \
(um),F_mN\"; without units, SI is assumed. Columns are found by the names t or time; u, x, disp or displacement; fx, f, force \
or q; others are given by --time, --displacement and --force.

A cycle runs from one reversal to the next in the same direction (noise is no reversal); with --period it is one period long. Openings are taken at \
mid-force. If the force opposes the motion its sign is reversed, and a note says so.

With --beside, a contact of a simulation is evaluated in the same way and its last cycle is plotted for comparison, each loop shifted to its own center. Writes cycles.csv and loop.png. Exit codes: 0 done, 2 bad input, 3 a file cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip measure rig.csv
  stickslip measure rig.csv --time \"clock\" --displacement \"LVDT 2\" --force \"load cell\" --period \"1 s\"
  stickslip measure rig.csv --beside results/rig --contact ball --normal-force \"10 N\"";

#[derive(Debug, Args)]
pub(crate) struct MeasureArguments {
    /// CSV file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Column of the times
    #[arg(long, value_name = "COLUMN")]
    pub(crate) time: Option<String>,
    /// Column of the displacements
    #[arg(long, value_name = "COLUMN")]
    pub(crate) displacement: Option<String>,
    /// Column of the tangential forces
    #[arg(long, value_name = "COLUMN")]
    pub(crate) force: Option<String>,
    /// Period of the motion, such as "1 s", from the first row on; by default cycles are found by their reversals
    #[arg(long, value_name = "T", value_parser = period)]
    pub(crate) period: Option<f64>,
    /// Mean normal force, such as "10 N", for the energy coefficient of friction; by default that of --beside
    #[arg(long, value_name = "FN", value_parser = normal)]
    pub(crate) normal_force: Option<f64>,
    /// Folder of simulated results to evaluate and draw beside the measured loop
    #[arg(long, value_name = "DIR")]
    pub(crate) beside: Option<PathBuf>,
    /// Name of its contact; not needed if there is only one
    #[arg(long, value_name = "NAME", requires = "beside")]
    pub(crate) contact: Option<String>,
    /// Folder of the files [default: results/NAME-loop]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

fn period(text: &str) -> Result<f64, String> {
    above_zero(text, "s")
}

fn normal(text: &str) -> Result<f64, String> {
    above_zero(text, "N")
}

fn above_zero(text: &str, unit: &str) -> Result<f64, String> {
    let value = quantity(text, unit)?;
    if value > 0.0 { Ok(value) } else { Err(format!("expected more than 0 {unit}")) }
}
