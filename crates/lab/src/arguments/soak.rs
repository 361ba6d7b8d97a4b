//! The command line of a soak.

use clap::Args;
use std::num::NonZeroU64;
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Test the event stepper with random scenarios: completion, accuracy, energy balance

A seed determines a scenario: all profiles, both engines, contacts pressed by constants, by waveforms and by the positions of bodies, \
all kinds of waveforms with phases, any start or equilibrium, one to four bodies, counts, damping, stacks and inclines. The same seed \
gives the same scenario on every machine. --write writes it as a file for `stickslip run`.

The stepper `event` runs each scenario at tolerances of 1e-6, 1e-8 and 1e-10. A scenario is right if three conditions hold at each \
tolerance. The run ends. The difference of each coordinate from the run at 1e-10 is below 100 tolerances in natural lengths, or S \
times that if the scenario itself amplifies a change of its start: S is the growth of a change of 1e-9 natural lengths. The energy \
balance closes within 100 tolerances of the energy throughput. With --rows K the first K scenarios also run on rows of 2 048 springs \
with velocity Verlet, whose time step is halved until the result converges. The results must agree within 1e-5 natural lengths times \
S.

Prints a table of fractions, and one line for each seed that is neither right nor warned: refused before the start, left the range of \
the model, grazing (a difference larger than S explains, but not larger than the growth of a change of the size of the tolerance), \
unbalanced (energy balance), wrong, stopped, hung (20 s), panicked. Exit codes: 0 none of the last five, 1 some of them, 2 bad input, \
3 a file cannot be written, 130 interrupted.

--hostile judges a matrix of scenarios instead: a plain drive with one parameter at an extreme value, with every stepper and \
tolerance. With --out and --page it writes the stability record, a page with criteria, a plot and a table.";

/// Examples under the long help.
pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip-lab soak                           the seeds 0 to 499
  stickslip-lab soak --seeds 5000 --rows 200   before a release
  stickslip-lab soak 258 1041                  two seeds
  stickslip-lab soak 258 --write drawn         drawn/seed-258.json, for `stickslip run`
  stickslip-lab soak --hostile --out docs/stability --page docs/stability.md
  stickslip-lab soak --hostile 17 --write drawn    drawn/cell-17.json";

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
