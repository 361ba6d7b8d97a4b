//! The command line.

pub(crate) mod bench;
pub(crate) mod gallery;
pub(crate) mod soak;
pub(crate) mod validate;

use clap::{Parser, Subcommand};

pub(crate) use bench::BenchArguments;
pub(crate) use gallery::GalleryArguments;
pub(crate) use soak::SoakArguments;
pub(crate) use validate::ValidateArguments;

/// Measures and checks stickslip: what accuracy costs, what becomes of hostile scenarios, what others measured and computed.
#[derive(Debug, Parser)]
#[command(name = "stickslip-lab", version, about, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Measure what accuracy costs: every stepper on both engines, errors over time and evaluations
    #[command(long_about = bench::ABOUT, after_long_help = bench::EXAMPLES)]
    Bench(BenchArguments),
    /// Draw scenes, run them all, and judge them: do they end, and are they right?
    #[command(long_about = soak::ABOUT, after_long_help = soak::EXAMPLES)]
    Soak(SoakArguments),
    /// Compute what is known from elsewhere, and write pages that show both
    #[command(long_about = validate::ABOUT, after_long_help = validate::EXAMPLES)]
    Validate(ValidateArguments),
    /// Run all scenarios of a folder and draw all their pictures, with a page that shows them
    ///
    /// Pictures are PNG, light and dark, and SVG where that is small; tables are not kept. The page, index.md, names the
    /// scenario and the command of each. Exit codes: 0 done, 2 a scenario is refused, 3 a run stopped itself or something
    /// cannot be drawn or written, 130 interrupted; the page is written only when everything was done.
    #[command(after_long_help = gallery::EXAMPLES)]
    Gallery(GalleryArguments),
}

/// Splits `path=value`.
pub(crate) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.to_owned())),
        None => Err("expected PATH=VALUE, such as run.duration=\"20 ms\"".to_owned()),
    }
}
