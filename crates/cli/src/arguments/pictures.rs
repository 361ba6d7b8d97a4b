//! The command line of pictures.

use crate::arguments::look::LookArguments;
use crate::arguments::run::interval;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;
use stickslip_scenario::PlotName;

pub(super) const PLOT_EXAMPLES: &str = "\
Examples:
  stickslip plot results/p1                                  the pictures of its scenario
  stickslip plot results/* --plots trajectory --format svg   one picture of every run, as SVG
  stickslip plot a/p1 b/p1 --over --plots loop --out .       both loops in one: over-loop.png
  stickslip plot results/p1 --scale 2 --out pictures         into pictures/p1/, twice as many pixels";

pub(super) const REPRO_EXAMPLES: &str = "\
Examples:
  stickslip repro loop.png                 runs what loop.png carries and compares
  stickslip repro loop.png --out here      leaves the results, scenario.json among them, in the folder here
  stickslip repro loop.png --wall \"1 min\"  runs it for a minute at most";

#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
    /// Folders of results
    #[arg(required = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Pictures to draw, instead of those that the scenario names; xy: its channels over a channel
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = plot_names())]
    pub(crate) plots: Vec<PlotName>,
    /// Folder of the pictures: those of a folder NAME go to OUT/NAME/; by default they go beside the results
    #[arg(long, value_name = "OUT")]
    pub(crate) out: Option<PathBuf>,
    /// All results over each other, each kind of picture in one: OUT/over-NAME.png (needs --out); of loop, trajectory, phase and xy
    #[arg(long, requires = "out")]
    pub(crate) over: bool,
    /// Errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

#[derive(Debug, Args)]
pub(crate) struct ReproArguments {
    /// A picture
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Folder for the results of the run; by default nothing is written
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Longest that the run may take on the wall, such as "1 min": where it takes longer nothing is compared (exit code 3). By default
    /// it runs to its end, whatever limit of wall time the picture carries
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub(crate) wall: Option<f64>,
    /// No progress, no result for people; errors and the exit code only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads the name of a picture.
fn plot_names() -> impl TypedValueParser<Value = PlotName> {
    let all = || PlotName::ALL.into_iter().chain([PlotName::Xy]);
    let names = PossibleValuesParser::new(all().map(PlotName::name));
    names.try_map(move |given| all().find(|plot| plot.name() == given).ok_or("no such picture"))
}
