//! The command line of interactive pages.

use super::assignment;
use clap::Args;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Write scenarios as one interactive HTML file with the engine inside

The file opens in a browser, without a server, a network or an installation. It simulates the scenarios itself: with sliders for their \
numbers, plots, the springs of each contact and section 4.4 of the Handbook of Contact Mechanics. Its results have the bits of this \
program.

The engine is in page.html beside the program, or --page. Releases contain it; `.ci/page` makes it. Tables in files become part of the \
page. Exit codes: 0 done, 2 bad input, 3 the page cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip view drive.json
  stickslip view drive.json rig.json --out talk.html
  stickslip view drive.json --set contacts.ball.friction=0.15";

#[derive(Debug, Args)]
pub(crate) struct ViewArguments {
    /// Scenario files
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Page to write; by default the name of the first scenario with .html, in this folder
    #[arg(long, value_name = "NAME.html")]
    pub(crate) out: Option<PathBuf>,
    /// Set a value of all scenarios, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Page with the engine
    #[arg(long, value_name = "FILE")]
    pub(crate) page: Option<PathBuf>,
}
