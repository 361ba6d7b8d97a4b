//! The command line of the curves of a machine.

use crate::arguments::{assignment, course, look::LookArguments, threads::Work};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use stickslip_study::curve::{Kind, holding};

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Trace a curve: step versus amplitude, speed versus frequency or load, holding force

For each point of the curve, the command replaces one value of the scenario and finds the periodic orbit of the drive by shooting. If \
shooting fails or the periodic orbit is unstable, the command simulates the drive until the steps are steady. If the step length \
oscillates, the point is the mean step length, with error and spread.

  step-amplitude   step length versus stroke or amplitude of the drive waveform;
                   zero-step stroke S₀, the largest stroke or amplitude without a step
  speed-frequency  mean speed versus drive frequency; maximum speed
  force-speed      mean speed and power versus a load that opposes the steps;
                   stall force and maximum power
  step-load        step length versus a load that opposes the steps; stall force
  preload          step length versus total normal force on the body; maximum step length
  holding-force    maximum load along +x and along -x that the drive holds at rest, versus preload

S₀ and the stall force are intervals: the drive makes steps at one end of the interval and no steps at the other end.

--both also traces the curve with all waveforms reversed in time. Waveforms with jumps, tables, bursts and sequences cannot be \
reversed. --vary traces the step length over any parameter of the scenario. With `--curve holding-force`, --vary traces the holding \
force. Waveforms that act along the same axis with the same period and stroke are varied together. The run duration and output tables \
of the scenario have no effect.

Writes curve.csv, curve.json and the plot curve.png. If a point has no result, its row gives the reason. The results do not depend on \
the number of threads. Exit codes: 0 done; 2 bad input; 3 no point has a result, or a file cannot be written; 130 interrupted. An \
interrupted command writes finished points to curve-partial.csv, .json and .png and keeps earlier results. The same command then \
resumes, also after a kill.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip curve drive.json --curve step-amplitude
  stickslip curve drive.json --curve speed-frequency --range \"10 Hz..5 kHz\" --log
  stickslip curve drive.json --vary contacts.ball.friction=0.1..0.6
  stickslip curve drive.json --curve force-speed --both
  stickslip curve drive.json --curve holding-force --vary contacts.ball.friction=0.1..0.6
  stickslip curve drive.json --vary bodies.slider.mass=\"1 g..100 g\" --log --json";

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("traced").args(["curve", "vary"]).required(true).multiple(true)))]
pub(crate) struct CurveArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Name of the curve, as described above
    #[arg(long, value_name = "NAME", value_parser = curves())]
    pub(crate) curve: Option<CurveName>,
    /// Parameter to vary and its range, such as contacts.ball.friction=0.1..0.6; give units at both ends of the range or at neither end
    #[arg(long, value_name = "PATH=FROM..TO", allow_hyphen_values = true, value_parser = course, conflicts_with = "range")]
    pub(crate) vary: Option<(String, String)>,
    /// Range of the horizontal axis, such as "10 Hz..5 kHz" [default: around the scenario value]
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true)]
    pub(crate) range: Option<String>,
    /// Also trace the curve with all waveforms reversed in time
    #[arg(long)]
    pub(crate) both: bool,
    /// Number of points, including both ends of the range
    #[arg(long, value_name = "N", default_value_t = 41)]
    pub(crate) points: usize,
    /// Space the points logarithmically
    #[arg(long)]
    pub(crate) log: bool,
    /// Relative accuracy of S₀, stall force, maxima and holding force, 1e-9 to 0.1
    #[arg(long, value_name = "TOL", default_value = "1e-4", value_parser = tolerance)]
    pub(crate) tolerance: f64,
    /// Set a value of the scenario for all points, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    #[command(flatten)]
    pub(crate) work: Work,
    /// Folder for the output files [default: results/NAME-CURVE]
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
