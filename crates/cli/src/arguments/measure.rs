//! The command line of measured loops.

use super::look::LookArguments;
use super::reading::ReadingArguments;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use stickslip_run::measured::{Correct, How, Rig};
use stickslip_scenario::quantity;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Evaluate measured hysteresis loops from a table; compare them with a simulation

Reports amplitudes, dissipated energy, loop opening, energy ratios and stiffness, each with an interval that contains the true value \
in 95 of 100 records. The file contains displacements and tangential forces, and may contain times. `stickslip import` shows how a \
file is read. The options --time, --displacement and --force select columns by name or number, with a unit after a colon. Numbers \
without a unit are in SI.

Cycles extend from one reversal to the next in the same direction. Consecutive cycles of one amplitude are a stage. The rows and work \
inside and outside of cycles add up to those of the record. Lag and drift of the signals are estimated. If the force opposes the \
motion, the sign of the force is reversed, and a note reports the reversal.

With --beside, the plot shows the last simulated cycle together with the measured loop, and each loop is shifted to its own centre. \
Writes cycles.csv and loop.png; for five cycles or more also log.png and evolution.png. Exit codes: 0 done, 2 bad input, 3 a file \
cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip measure rig.csv
  stickslip measure rig.csv --displacement \"LVDT 2\" --force 3:kN --period \"1 s\"
  stickslip measure rig.csv --recipe rig-recipe.json
  stickslip measure rig.csv --beside results/rig --contact ball --normal-force \"10 N\"";

#[derive(Debug, Args)]
pub(crate) struct MeasureArguments {
    /// Table of an instrument
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArguments,
    /// Period, such as "1 s", counted from the first row [default: cycles from reversal to reversal]
    #[arg(long, value_name = "T", value_parser = period)]
    pub(crate) period: Option<f64>,
    /// Time of the first row that counts, such as "10 s"
    #[arg(long, value_name = "T", value_parser = time)]
    pub(crate) from: Option<f64>,
    /// Time of the last row that counts
    #[arg(long, value_name = "T", value_parser = time)]
    pub(crate) to: Option<f64>,
    /// Numbers of the cycles that count, such as 20.. or 20..40
    #[arg(long, value_name = "FIRST..LAST", value_parser = cycles)]
    pub(crate) cycles: Option<[usize; 2]>,
    /// Estimated errors of the signals that are removed from the record
    #[arg(long, value_name = "ERROR", value_delimiter = ',')]
    pub(crate) correct: Vec<SignalError>,
    /// Stiffness of the rig in series, such as "20 N/um", to remove its deformation; fit: found by the contact of --beside
    #[arg(long, value_name = "K", value_parser = rig)]
    pub(crate) rig_stiffness: Option<RigStiffness>,
    /// Mean normal force, such as "10 N", for the coefficient of friction [default: its column, or the simulated contact]
    #[arg(long, value_name = "FN", value_parser = normal)]
    pub(crate) normal_force: Option<f64>,
    /// Profile of the contact, for the slip regime: sphere, cone, flat, or the power n of f ~ r^n
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    pub(crate) profile: Option<f64>,
    /// Results folder of a simulation that is compared with the measured loop
    #[arg(long, value_name = "DIR")]
    pub(crate) beside: Option<PathBuf>,
    /// Name of the contact in the results of --beside; required if the results contain several contacts
    #[arg(long, value_name = "NAME", requires = "beside")]
    pub(crate) contact: Option<String>,
    /// Displacement of the simulated loop, such as rig.x [default: relative displacement of the contact]
    #[arg(long, value_name = "CHANNEL", requires = "beside")]
    pub(crate) beside_displacement: Option<String>,
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

/// Stiffness of a rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RigStiffness {
    /// This, N/m.
    Known(f64),
    /// That which is found beside a simulated contact.
    Fit,
}

fn profile(text: &str) -> Result<f64, String> {
    match text {
        "sphere" | "paraboloid" => Ok(2.0),
        "cone" => Ok(1.0),
        "flat" => Ok(f64::INFINITY),
        power => {
            let power = power.parse().ok().filter(|power: &f64| *power > 0.0 && power.is_finite());
            power.ok_or_else(|| "expected sphere, cone, flat, or a power above 0".to_owned())
        }
    }
}

fn rig(text: &str) -> Result<RigStiffness, String> {
    if text == "fit" { Ok(RigStiffness::Fit) } else { above_zero(text, "N/m").map(RigStiffness::Known) }
}

/// An error of the signals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SignalError {
    /// Delay of the force with respect to the displacement
    Lag,
    /// Linear drift of the displacement and of the force
    Drift,
}

impl MeasureArguments {
    /// What of the record is evaluated, and how.
    ///
    /// `tangent` is that of the simulated contact, N/m, if one stands beside.
    pub(crate) fn how(&self, tangent: Option<f64>) -> How {
        let has = |error| self.correct.contains(&error);
        How {
            period: self.period,
            from: self.from,
            to: self.to,
            cycles: self.cycles,
            correct: Correct { lag: has(SignalError::Lag), drift: has(SignalError::Drift) },
            profile: self.profile,
            rig: match self.rig_stiffness {
                Some(RigStiffness::Known(stiffness)) => Some(Rig::Stiffness(stiffness)),
                Some(RigStiffness::Fit) => tangent.map(Rig::Contact),
                None => None,
            },
        }
    }
}

fn time(text: &str) -> Result<f64, String> {
    quantity(text, "s")
}

/// `20..40`, `20..`, `..40` or `20`: both ends are in it.
fn cycles(text: &str) -> Result<[usize; 2], String> {
    let expected = || "expected numbers of cycles from 1, such as 20.. or 20..40".to_owned();
    let number = |text: &str, otherwise: usize| match text.trim() {
        "" => Ok(otherwise),
        text => text.parse::<usize>().map_err(|_| expected()),
    };
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let ends = [number(first, 1)?, number(last.trim_start_matches('='), usize::MAX)?];
    if text.trim().is_empty() || ends[0] == 0 || ends[0] > ends[1] { Err(expected()) } else { Ok(ends) }
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
