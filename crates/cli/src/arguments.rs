//! The command line.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// A simulator of stick-slip drives: piezo inertia drives, fretting rigs.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run scenarios; write trace.csv, events.csv, summary.json, scenario.json and pictures
    ///
    /// Everything about a scenario is checked before its folder is made. Exit codes: 0 done, 2 bad input, 3 a run
    /// stopped itself, 130 interrupted; of several files the largest. What was computed is written in either case.
    Run(RunArguments),
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Scenario files
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Folder of the results: NAME.json writes into DIR/NAME/
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub(crate) out: PathBuf,
    /// Put a value into every scenario, such as run.duration="20 ms" or contacts.ball.friction=0.3
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Scenarios run at the same time, at most one per core
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: u16,
    /// Print the summaries to stdout, one line of JSON per scenario
    #[arg(long)]
    pub(crate) json: bool,
    /// No progress, no result for people; errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Splits `path=value`.
fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.to_owned())),
        None => Err("expected PATH=VALUE, such as run.duration=\"20 ms\"".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_equals_sign_parts_path_and_value() {
        assert_eq!(assignment("title=a=b"), Ok(("title".to_owned(), "a=b".to_owned())));
        assert!(assignment("run.duration").is_err());
    }

    #[test]
    fn the_command_line_is_consistent() {
        <Arguments as clap::CommandFactory>::command().debug_assert();
    }
}
