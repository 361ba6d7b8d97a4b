//! The command line of pictures.

use crate::arguments::look::LookArguments;
use crate::arguments::run::interval;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;
use stickslip_scenario::PlotName;

pub(super) const PLOT_EXAMPLES: &str = "\
Examples:
  stickslip plot results/p1                                  the plots of its scenario
  stickslip plot results/* --plots trajectory --format svg   one plot of every run, as SVG
  stickslip plot a/p1 b/p1 --over --plots loop --out .       both loops in one plot: over-loop.png
  stickslip plot results/p1 --scale 2 --out pictures         into pictures/p1/, twice as large";

pub(super) const REPRO_EXAMPLES: &str = "\
Examples:
  stickslip repro loop.png                 rerun the scenario of loop.png and compare
  stickslip repro loop.png --out here      keep the results, scenario.json included, in here
  stickslip repro loop.png --wall \"1 min\"  run for at most a minute";

#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
    /// Folders of results
    #[arg(required = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Names of the plots to draw [default: the plots of the scenario]; xy draws channels over another channel
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = plot_names())]
    pub(crate) plots: Vec<PlotName>,
    /// Folder for the plots; plots of the results folder NAME are written to OUT/NAME/ [default: the results folder]
    #[arg(long, value_name = "OUT")]
    pub(crate) out: Option<PathBuf>,
    /// Overlay all results in one plot of each kind, OUT/over-NAME.png; requires --out; only for loop, trajectory, phase and xy
    #[arg(long, requires = "out")]
    pub(crate) over: bool,
    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

#[derive(Debug, Args)]
pub(crate) struct ReproArguments {
    /// PNG or SVG file drawn by `run` or `plot`
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Folder for the results of the run [default: nothing is written]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Limit of wall-clock time, such as "1 min"; a run that reaches the limit is not compared (exit code 3)
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub(crate) wall: Option<f64>,
    /// Print errors only: no progress, no verdict
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Reads the name of a picture.
fn plot_names() -> impl TypedValueParser<Value = PlotName> {
    let all = || PlotName::ALL.into_iter().chain([PlotName::Xy]);
    let names = PossibleValuesParser::new(all().map(PlotName::name));
    names.try_map(move |given| all().find(|plot| plot.name() == given).ok_or("no such plot"))
}
