//! The command line of the curves of a machine.

use crate::arguments::{assignment, course, look::LookArguments};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use stickslip_study::curve::{Kind, holding};

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Trace a curve: step versus amplitude, speed versus frequency or load, holding force

Each point is the scenario with one value replaced, and its periodic motion: found directly by shooting, or by a run that \
waits for it where shooting fails or the motion is unstable. If the step length oscillates, the mean is reported with its \
error and spread.

  step-amplitude   step length versus stroke or amplitude of the drive waveform; S₀, the zero-step amplitude
  speed-frequency  mean speed versus drive frequency; the maximum
  force-speed      mean speed and power versus a load that opposes the steps; stall force, maximum power
  step-load        step length versus such a load; stall force
  preload          step length versus total normal force on the body; the maximum
  holding-force    maximum load along +x and along -x that the drive holds at rest, versus preload

S₀ and stall force are brackets: the drive steps at one end and not at the other.

--both traces the curve forward and backward, with the waveforms reversed in time. Jumps, tables and patterns cannot be \
reversed. --vary traces the step, or with `--curve holding-force` the holding force, over any parameter of the scenario. \
Waveforms that act along the same axis with the same period and stroke are varied together. The duration and output of the scenario do not \
matter.

Writes curve.csv, curve.json and the plot curve.png. A point that gives no result is written as a row with the reason. The result does not \
depend on the number of threads. Exit codes: 0 done, 2 bad input, 3 no point has a result, or a file cannot be written, 130 \
interrupted: finished points are in curve-partial.csv, .json and .png, and an earlier result is kept.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip curve drive.json --curve step-amplitude
  stickslip curve drive.json --curve speed-frequency --range \"10 Hz..5 kHz\" --log
  stickslip curve drive.json --curve force-speed --points 101 --out here
  stickslip curve drive.json --vary contacts.ball.friction=0.1..0.6
  stickslip curve drive.json --curve force-speed --both
  stickslip curve drive.json --curve holding-force
  stickslip curve drive.json --curve holding-force --vary contacts.ball.friction=0.1..0.6
  stickslip curve drive.json --vary bodies.slider.mass=\"1 g..100 g\" --log --json";

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("traced").args(["curve", "vary"]).required(true).multiple(true)))]
pub(crate) struct CurveArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which curve
    #[arg(long, value_name = "NAME", value_parser = curves())]
    pub(crate) curve: Option<CurveName>,
    /// The parameter and its range, such as contacts.ball.friction=0.1..0.6, units at both ends or at none
    #[arg(long, value_name = "PATH=FROM..TO", allow_hyphen_values = true, value_parser = course, conflicts_with = "range")]
    pub(crate) vary: Option<(String, String)>,
    /// Range of the curve, such as "10 Hz..5 kHz" [default: around the value of the scenario]
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true)]
    pub(crate) range: Option<String>,
    /// Trace both directions: as it is, and with the waveforms reversed in time
    #[arg(long)]
    pub(crate) both: bool,
    /// Number of points, both ends included
    #[arg(long, value_name = "N", default_value_t = 41)]
    pub(crate) points: usize,
    /// Space the points logarithmically
    #[arg(long)]
    pub(crate) log: bool,
    /// Relative accuracy of S₀, stall, maxima and holding forces, 1e-9 to 0.1
    #[arg(long, value_name = "TOL", default_value = "1e-4", value_parser = tolerance)]
    pub(crate) tolerance: f64,
    /// Set a value of the scenario for all points, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Points computed at the same time [default: the number of cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Folder of the files [default: results/NAME-CURVE]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of a table; numbers that are not finite are null
    #[arg(long)]
    pub(crate) json: bool,
    /// Print the table even if the curve has more than 20 points
    #[arg(long)]
    pub(crate) rows: bool,
    /// Print errors only: no progress, no table
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads a share of a place.
fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance = stickslip_scenario::quantity(text, "")?;
    let is_usable = (1e-9..=0.1).contains(&tolerance);
    is_usable.then_some(tolerance).ok_or_else(|| "expected a share from 1e-9 to 0.1".to_owned())
}

/// Which curve.
#[derive(Debug, Clone)]
pub(crate) enum CurveName {
    /// Of motions.
    Of(Kind),
    /// Of what is held at rest.
    HoldingForce,
}

/// Reads the name of a curve.
fn curves() -> impl TypedValueParser<Value = CurveName> {
    let names = Kind::NAMED.iter().map(Kind::name).chain([holding::NAME]);
    PossibleValuesParser::new(names).try_map(|given| match given.as_str() {
        holding::NAME => Ok(CurveName::HoldingForce),
        _ => Kind::of_name(&given).map(CurveName::Of).ok_or("no such curve"),
    })
}
