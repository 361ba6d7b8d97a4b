//! The command line of the gallery.

use clap::Args;
use std::path::PathBuf;

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip-lab gallery                                     all of scenarios/ into docs/examples/
  stickslip-lab gallery --scenarios mine --out mine/plots   of another folder";

#[derive(Debug, Args)]
pub(crate) struct GalleryArguments {
    /// Folder of the scenarios
    #[arg(long, value_name = "DIR", default_value = "scenarios")]
    pub(crate) scenarios: PathBuf,
    /// Folder of the gallery: plots go to OUT/NAME/, pages to OUT/NAME.md and OUT/index.md
    #[arg(long, value_name = "OUT", default_value = "docs/examples")]
    pub(crate) out: PathBuf,
    /// No progress, no result; errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}
