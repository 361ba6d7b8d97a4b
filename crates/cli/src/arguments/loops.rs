//! The command line of measured loops.

use super::look::LookArguments;
use clap::Args;
use std::path::PathBuf;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Measure loops of a table: amplitudes, lost energy, opening, ratios, stiffness; beside a simulated one

Reads displacements and tangential forces, and times where there are any, from a CSV file whose first line has the names of \
the columns, with their units, as in \"t [ms],disp (um),F_mN\"; without a unit numbers are in SI. Columns go by t or time; u, x, \
disp or displacement; fx, f, force or q; others are named by --time, --displacement and --force.

Cycles go from one reversal to the next of its kind where u comes back, whatever noise there is on it, or are those of \
--period. Openings are those at the middle of the forces. A force that resists the motion has its sign turned, and a note says so.

With --beside a contact of results on disk is measured in the same way and drawn over the last cycle, each loop about its own \
middle. Writes cycles.csv and loop.png. Exit codes: 0 done, 2 bad input, 3 the files cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip loop rig.csv
  stickslip loop rig.csv --time \"clock\" --displacement \"LVDT 2\" --force \"load cell\" --period \"1 s\"
  stickslip loop rig.csv --beside results/rig --contact ball --normal-force \"10 N\"";

#[derive(Debug, Args)]
pub(crate) struct LoopArguments {
    /// A table, CSV
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
    /// Period of the motion, such as "1 s", from the first line on; by default cycles go between reversals
    #[arg(long, value_name = "T", value_parser = period)]
    pub(crate) period: Option<f64>,
    /// Mean normal force, such as "10 N", for the energy coefficient of friction; by default that of --beside
    #[arg(long, value_name = "FN", value_parser = normal)]
    pub(crate) normal_force: Option<f64>,
    /// Folder of results, one of whose contacts is measured and drawn beside
    #[arg(long, value_name = "DIR")]
    pub(crate) beside: Option<PathBuf>,
    /// Which contact of it; not needed where there is one
    #[arg(long, value_name = "NAME", requires = "beside")]
    pub(crate) contact: Option<String>,
    /// Folder of the files [default: results/NAME-loop]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Errors only
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
