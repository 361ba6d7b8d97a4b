//! How many cases are computed at a time.

use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Threads {
    /// Number of cases computed in parallel [default: number of processor cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// How much of a study is computed at a time, and whether what an interrupted command has computed counts.
#[derive(Debug, Args)]
pub(crate) struct Work {
    #[command(flatten)]
    pub(crate) threads: Threads,
    /// Begin anew instead of resuming an interrupted command
    #[arg(long)]
    pub(crate) fresh: bool,
}

impl Threads {
    pub(crate) fn count(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.map_or_else(cores, usize::from)
    }
}
