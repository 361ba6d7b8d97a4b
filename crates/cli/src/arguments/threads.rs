//! How many cases are computed at a time.

use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Threads {
    /// Number of cases computed in parallel [default: number of processor cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl Threads {
    pub(crate) fn count(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.map_or_else(cores, usize::from)
    }
}
