//! The command line of a soak.

use clap::Args;
use std::num::NonZeroU64;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Draw scenes, run them all, and judge them: do they end, and are they right?

A seed draws a scenario: every profile, both engines, contacts pressed by constants, by waveforms and by the bodies' own heights, \
waveforms of every kind with phases, starts anywhere or in equilibrium, one to four bodies, counts, damping, stacks, inclines. The \
same seed draws the same scenario on every machine; --write writes it as a file for `stickslip run`.

Each is run by the stepper `event` at tolerances of 1e-6, 1e-8 and 1e-10, and is right where, at each, it ends; where no \
coordinate is ever off the run at 1e-10 by more than 100 tolerances in its natural length, times S where the scene itself makes \
more of a change of its start: S is the growth of one of 1e-9 natural lengths; and where the energy books close to 100 \
tolerances of what went through them. With --rows K the first K are also run on rows of 2 048 springs by velocity Verlet, its step halved \
until it agrees with itself, and must meet them to 1e-5 natural lengths times S.

Prints a table of shares, and what is neither right nor warned by seed, a line each: refused before the start, left the range of the \
model, grazing (off by more than S explains, but not more than the growth of a change as large as the tolerance), books open, \
wrong, stopped, hung (20 s), panicked. Exit codes: 0 none of the last five, 1 some of them, 2 bad input, 3 something cannot be written, \
130 interrupted.

--hostile judges a matrix of scenes instead: one thing of a plain drive at a time at its extremes, by every stepper and tolerance; with --out and --page it writes the stability record, a page that says how its cells are judged, with a picture and a table.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip-lab soak                           the seeds 0 to 499
  stickslip-lab soak --seeds 5000 --rows 200   all that is asked of a release
  stickslip-lab soak 258 1041                  two of them
  stickslip-lab soak 258 --write scenes        scenes/seed-258.json, for `stickslip run`
  stickslip-lab soak --hostile --out docs/stability --page docs/stability.md
  stickslip-lab soak --hostile 17 --write scenes   scenes/cell-17.json";

#[derive(Debug, Args)]
pub(crate) struct SoakArguments {
    /// Seeds to be judged, or written; all that --seeds and --from say, where none is named
    #[arg(value_name = "SEED", conflicts_with_all = ["seeds", "from"])]
    pub(crate) named: Vec<u64>,
    /// How many seeds, from --from on
    #[arg(long, value_name = "N", default_value = "500")]
    pub(crate) seeds: NonZeroU64,
    /// The first seed
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub(crate) from: u64,
    /// How many of them are compared with rows of springs by fixed steps, too
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(crate) rows: u64,
    /// Scenes at a time; as many as there are cores by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Write soak.csv, a line for each seed, into this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write the scenarios of the seeds into this folder, and judge none
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
    /// Judge the matrix of hostile scenes; numbers name cells of it
    #[arg(long, conflicts_with_all = ["seeds", "from", "rows"])]
    pub(crate) hostile: bool,
    /// Write the stability record as a page in Markdown, its picture and table into the folder --out
    #[arg(long, value_name = "FILE", requires = "hostile", requires = "out", conflicts_with_all = ["named", "write"])]
    pub(crate) page: Option<PathBuf>,
    /// No progress, no table; exceptions only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}
