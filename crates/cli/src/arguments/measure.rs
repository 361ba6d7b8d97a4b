//! The command line of measured loops.

use super::look::LookArguments;
use super::reading::ReadingArguments;
use clap::Args;
use std::path::PathBuf;
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Evaluate measured hysteresis loops from a table; compare them with a simulation

Reports amplitudes, dissipated energy, loop opening, energy ratios and stiffness of every cycle. The file contains displacements and \
tangential forces, and may contain times. `stickslip import` shows how a file is read: encoding, delimiter, decimal sign, head lines \
and columns are found by themselves, or said by a recipe. Columns are found by their names or units. The options --time, \
--displacement and --force select columns by name or number, with a unit after a colon. Numbers without a unit are in SI.

A cycle extends from one reversal to the next reversal in the same direction. Reversals by noise are ignored. Cycles of one amplitude \
are a stage; rows and work in cycles and outside are reported, and both add up to the record. With --period, every \
cycle is one period long. The loop opening is measured at the mean of the largest and smallest force. If the force opposes the \
motion, the sign of the force is reversed, and a note reports the reversal.

With --beside, a contact of a simulation is evaluated in the same way. The plot then shows the last simulated cycle together with \
the measured loop, and each loop is shifted to its own centre. Writes cycles.csv and loop.png. Exit codes: 0 done, 2 bad input, 3 \
a file cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip measure rig.csv
  stickslip measure rig.csv --time \"clock\" --displacement \"LVDT 2\" --force \"load cell\" --period \"1 s\"
  stickslip measure rig.txt --displacement 2:mm --force 3:kN
  stickslip measure rig.csv --recipe rig-recipe.json
  stickslip measure rig.csv --beside results/rig --contact ball --normal-force \"10 N\"";

#[derive(Debug, Args)]
pub(crate) struct MeasureArguments {
    /// Table of an instrument
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArguments,
    /// Period of the motion, such as "1 s", counted from the first row; by default cycles are found by their reversals
    #[arg(long, value_name = "T", value_parser = period)]
    pub(crate) period: Option<f64>,
    /// Mean normal force, such as "10 N", for the energy coefficient of friction [default: normal force of the simulated contact]
    #[arg(long, value_name = "FN", value_parser = normal)]
    pub(crate) normal_force: Option<f64>,
    /// Results folder of a simulation that is compared with the measured loop
    #[arg(long, value_name = "DIR")]
    pub(crate) beside: Option<PathBuf>,
    /// Name of the contact in the results of --beside; required if the results contain several contacts
    #[arg(long, value_name = "NAME", requires = "beside")]
    pub(crate) contact: Option<String>,
    /// Folder for the output files [default: results/NAME-loop]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of the table
    #[arg(long)]
    pub(crate) json: bool,
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
