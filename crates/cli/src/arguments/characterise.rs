//! The command line of the curves of a machine.

use crate::arguments::{assignment, course, look::LookArguments};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args};
use std::path::PathBuf;
use stickslip_study::curve::{Kind, holding};

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Trace a curve of a drive: step over amplitude, speed over frequency, speed against a load, or over any number of its scenario; \
what it holds at rest

Each point is the scenario with something else in it, as --set would put it there, and its steady motion: found directly, as \
the state that a period of the waveform brings back, or by a run that waits for it, where it is not found \
or where no run would stay in it. Of steps that swing from period to period the mean is told, how far it may be off, and by how much they swing.

  step-amplitude   step over the stroke, or amplitude, of the waveform of the steps; S₀, below which there is none
  speed-frequency  mean speed over its frequency; the fastest
  force-speed      mean speed, and power, over a load against the steps; stall, the most power
  step-load        step over such a load; stall
  preload          step over the normal force of all contacts of the body, each its share; the longest
  holding-force    largest load along +x, and along −x, that the drive holds at rest, waveforms at their starting values, over \
the preload, or over what --vary says

S₀ and stall are brackets: the drive steps at one end and not at the other. Best points are peaks between two points of the curve.

--both traces the curve in both senses: forward, as the scenario is, and backward, its waveforms reversed in time. A load acts against the \
steps of each. A waveform that jumps, is a table or is a pattern already cannot be reversed.

--vary PATH=FROM..TO traces the step over any number of the scenario. Waveforms of the same period, and of the same stroke along \
the same axis, go together. A driver keeps its limits at every point. How long the scenario itself runs, and what it writes, does not count.

Writes curve.csv, curve.json and the picture curve.png into results/NAME-CURVE. A point that the scenario does not allow, or that \
does not become steady, is a row with its reason. The same bytes for any number of threads. Where it is interrupted the points \
that were done are written to curve-partial.csv, .json and .png; a finished curve stays beside them. Exit codes: 0 done, 2 bad input, \
or the folder cannot be written into, 3 no point has a motion, or the files cannot be written, 130 interrupted.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip characterise drive.json --curve step-amplitude
  stickslip characterise drive.json --curve speed-frequency --range \"10 Hz..5 kHz\" --log
  stickslip characterise drive.json --curve force-speed --points 101 --out here
  stickslip characterise drive.json --vary contacts.ball.friction=0.1..0.6
  stickslip characterise drive.json --curve force-speed --both
  stickslip characterise drive.json --curve holding-force
  stickslip characterise drive.json --curve holding-force --vary contacts.ball.friction=0.1..0.6
  stickslip characterise drive.json --vary bodies.slider.mass=\"1 g..100 g\" --log --json";

#[derive(Debug, Args)]
#[command(group(ArgGroup::new("traced").args(["curve", "vary"]).required(true).multiple(true)))]
pub(crate) struct CharacteriseArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which curve
    #[arg(long, value_name = "NAME", value_parser = curves())]
    pub(crate) curve: Option<CurveName>,
    /// Step, or holding force, over a number of the scenario in a range, such as contacts.ball.friction=0.1..0.6; units at both ends or at none
    #[arg(long, value_name = "PATH=FROM..TO", allow_hyphen_values = true, value_parser = course, conflicts_with = "range")]
    pub(crate) vary: Option<(String, String)>,
    /// In which range, such as "10 Hz..5 kHz", units at both ends or at none [default: about what the scenario has]
    #[arg(long, value_name = "FROM..TO", allow_hyphen_values = true)]
    pub(crate) range: Option<String>,
    /// Both senses: as it is, and with the waveforms reversed in time, so that the drive steps back
    #[arg(long)]
    pub(crate) both: bool,
    /// How many points, ends and all
    #[arg(long, value_name = "N", default_value_t = 41)]
    pub(crate) points: usize,
    /// As many points in every decade, and not in every equal part
    #[arg(long)]
    pub(crate) log: bool,
    /// How exactly S₀, stall, best points and holding forces are looked for, as a share of their place, 1e-9 to 0.1
    #[arg(long, value_name = "TOL", default_value = "1e-4", value_parser = tolerance)]
    pub(crate) tolerance: f64,
    /// Put a value into the scenario for all points, such as contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Points at a time; as many as there are cores by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Folder of the files [default: results/NAME-CURVE]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print one line of JSON instead of a table; a number that is not finite is null
    #[arg(long)]
    pub(crate) json: bool,
    /// Print the table of a curve of more than 20 points as well, not its landmarks alone
    #[arg(long)]
    pub(crate) rows: bool,
    /// No progress, no table; errors only
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
