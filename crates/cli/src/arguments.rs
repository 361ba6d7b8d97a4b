//! The command line.

pub(crate) mod characterise;
pub(crate) mod compare;
pub(crate) mod contact;
pub(crate) mod golden;
pub(crate) mod look;
pub(crate) mod loops;
mod pictures;
pub(crate) mod realtime;
pub(crate) mod run;
pub(crate) mod sensitivity;
pub(crate) mod steady;

use crate::commands::new;
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

pub(crate) use characterise::CharacteriseArguments;
pub(crate) use compare::CompareArguments;
pub(crate) use contact::ContactArguments;
pub(crate) use loops::LoopArguments;
pub(crate) use pictures::{PlotArguments, ReproArguments};
pub(crate) use realtime::RealtimeArguments;
pub(crate) use run::{ConductArguments, ResumeArguments, RunArguments};
pub(crate) use sensitivity::SensitivityArguments;
pub(crate) use steady::SteadyArguments;

/// Exit codes, as every command keeps them.
const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a comparison found a difference
  2    bad input: a scenario, an override, an argument; nothing was written for it
  3    a run stopped itself (its results so far are written), or something could not be written; with
       --strict also a run whose results are warned of
  130  interrupted; what was computed is written (another signal, a second later or more, ends at once)
Of several files the largest counts.

Start here:
  stickslip new               writes drive.json, a drive that runs at once
  stickslip info drive.json   what the scene means, before it runs
  stickslip run drive.json    results/drive/: tables, summary, pictures";

/// A simulator of stick-slip drives: piezo inertia drives, fretting rigs.
#[derive(Debug, Parser)]
#[command(version, about, after_help = EXIT_CODES, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run scenarios; write trace.csv, events.csv, summary.json, scenario.json and pictures
    ///
    /// Of a drive also steps.csv: every step. Where contacts go to and fro, cycles.csv: every cycle's loop. Where a scenario asks for it, springs.csv and memory.csv:
    /// what goes on inside its contacts.
    ///
    /// Everything about a scenario is checked before its folder is made. Exit codes: 0 done, 2 bad input, 3 a run
    /// stopped itself or, with --strict, its results are warned of, 130 interrupted; of several files the largest. What was computed is written in either case, also
    /// what a disk had room for before it was full (exit code 3; "cut" in summary.json).
    ///
    /// All files of a run get their names at its end, summary.json last, with rows and SHA-256 of every table: a folder
    /// holds the results of before, those of the run, or no summary, and without one `plot`, `compare` and `repro` read
    /// nothing. Numbers that are not finite are null in JSON, and a note says which.
    #[command(after_long_help = run::RUN_EXAMPLES)]
    Run(RunArguments),
    /// Go on with runs that kept checkpoints, to their end or to a later one
    ///
    /// Reads DIR/checkpoint of each folder of results, goes on from there and writes what an undisturbed run would have
    /// written, to the same bits: whether the run was killed, was interrupted or had come to its end. Only the end can be
    /// changed, by --set run.duration or run.cycles, whichever the scenario has. Goes on keeping checkpoints. Exit codes: 0
    /// done, 2 no checkpoint, or one that this run cannot go on from, 3 a run stopped itself, 130 interrupted.
    #[command(after_long_help = run::RESUME_EXAMPLES)]
    Resume(ResumeArguments),
    /// Check scenarios: all that a run would refuse; runs and writes nothing
    ///
    /// Says "ok" of each good file on stdout, and of each bad one what is wrong, where and what would be right on stderr. What is
    /// allowed and hardly meant is warned of with its number: loads that nothing holds, stacks without damping, pressures that the
    /// named material does not bear, moduli far from its kind, odd masses, strokes, resonances and tolerances.
    /// Exit codes: 0 all are good, 2 one is not.
    #[command(after_long_help = CHECK_EXAMPLES)]
    Check(CheckArguments),
    /// Show what a scenario means before it runs: moduli, scales, modes, stable steps, expected work
    ///
    /// Nothing is run or written. Exit codes: 0 done, 2 bad input.
    #[command(after_long_help = INFO_EXAMPLES)]
    Info(InfoArguments),
    /// Answer for one contact of a scenario, without a run: constants, curves, first loadings, fields
    #[command(long_about = contact::ABOUT, after_long_help = contact::EXAMPLES)]
    Contact(ContactArguments),
    /// Measure loops of a table: amplitudes, lost energy, opening, ratios; beside a simulated one
    #[command(long_about = loops::ABOUT, after_long_help = loops::EXAMPLES)]
    Loop(LoopArguments),
    /// Trace a curve of a drive: step over amplitude, speed over frequency, speed against a load
    #[command(long_about = characterise::ABOUT, after_long_help = characterise::EXAMPLES)]
    Characterise(CharacteriseArguments),
    /// Tell which numbers matter: by how much figures of a run change with each number of its scenario
    #[command(long_about = sensitivity::ABOUT, after_long_help = sensitivity::EXAMPLES)]
    Sensitivity(SensitivityArguments),
    /// Find the steady motion of a drive without waiting for it: step, speed, how disturbances fade or grow
    #[command(long_about = steady::ABOUT, after_long_help = steady::EXAMPLES)]
    Steady(SteadyArguments),
    /// Write a scenario that runs at once, from a template, with the schema by which editors complete it
    ///
    /// Writes NAME.json and, beside it, schema/scenario-1.json, which the scenario names as its "$schema": editors that
    /// know JSON Schema complete and check the file from then on. Never overwrites a scenario. Exit codes: 0 done, 2 bad
    /// input.
    #[command(after_long_help = NEW_EXAMPLES)]
    New(NewArguments),
    /// Explain a key of a scenario, a column of a table, a figure that is printed or a symbol
    ///
    /// Names may be whole or only their end: slider.x_m and x_m, contacts.ball.friction and friction. Exit codes: 0 done, 2 nothing has
    /// that name.
    #[command(after_long_help = EXPLAIN_EXAMPLES)]
    Explain {
        /// What to explain; without a name all columns and figures are listed, in Markdown
        #[arg(value_name = "KEY|COLUMN|FIGURE")]
        names: Vec<String>,
    },
    /// List the materials that contacts may name without describing them: elastic constants, each with its source
    #[command(
        after_long_help = "Example:\n  stickslip materials\n\n  \"materials\": [\"ruby\", \"hardened steel\"] of a contact then needs no section \"materials\"."
    )]
    Materials,
    /// Print what a shell needs to complete commands, options and files
    #[command(after_long_help = COMPLETIONS_EXAMPLES)]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the JSON Schema of the scenario file
    #[command(after_long_help = "Example:\n  stickslip schema > scenario-1.json")]
    Schema,
    /// Draw pictures from results on disk
    ///
    /// Reads scenario.json, trace.csv, events.csv and, where they are needed, springs.csv and memory.csv of each folder and
    /// draws what `run` draws, to the same bits, or other pictures of the same results. Files that are not those that
    /// summary.json has the hashes of are refused, as is a folder without it: its run was ended while it published them.
    /// Exit codes: 0 done, 2 a folder that is no result of a run, or that lacks what a picture needs, 3 the pictures cannot
    /// be written.
    #[command(after_long_help = pictures::PLOT_EXAMPLES)]
    Plot(PlotArguments),
    /// Run again what a picture carries, and tell whether the same comes out
    ///
    /// A PNG or SVG of `run` or `plot` carries its whole scenario and a fingerprint of the trace and the events. Says
    /// "identical", or which channel differs from when. Exit codes: 0 identical, 1 different, 2 a file that is no such
    /// picture, 3 the results cannot be written or --wall was reached, 130 interrupted.
    #[command(after_long_help = pictures::REPRO_EXAMPLES)]
    Repro(ReproArguments),
    /// Compare two folders of results: channels, events, figures
    #[command(long_about = compare::ABOUT, after_long_help = compare::EXAMPLES)]
    Compare(CompareArguments),
    /// Keep what scenarios come to, and find out when that changes
    #[command(long_about = golden::ABOUT, after_long_help = golden::EXAMPLES, subcommand)]
    Golden(golden::GoldenCommand),
    /// Run a drive in real time: a frame after each tick of a clock, inputs from outside, outputs to it
    #[command(long_about = realtime::ABOUT, after_long_help = realtime::EXAMPLES)]
    Realtime(Box<RealtimeArguments>),
}

const CHECK_EXAMPLES: &str = "\
Examples:
  stickslip check scenarios/*.json
  stickslip check drive.json --set contacts.ball.friction=0.3
  stickslip check drive.json --json    a line of JSON with line, column and message";

const INFO_EXAMPLES: &str = "\
Examples:
  stickslip info drive.json
  stickslip info drive.json --set contacts.ball.normal.force=\"1 N\"
  stickslip info drive.json --json     numbers in SI, the unit in each key";

const EXPLAIN_EXAMPLES: &str = "\
Examples:
  stickslip explain friction              a key of a scenario, wherever it stands
  stickslip explain run.until_steady      one of them
  stickslip explain ball.stick_m          a column of trace.csv
  stickslip explain steady.step_m         a figure of summary.json

Without a name it lists all columns and figures, which are also the page docs/definitions.md.";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  stickslip completions bash > ~/.local/share/bash-completion/completions/stickslip
  stickslip completions zsh  > ~/.zfunc/_stickslip       with fpath+=~/.zfunc before compinit in ~/.zshrc
  stickslip completions fish > ~/.config/fish/completions/stickslip.fish";

const NEW_EXAMPLES: &str = "\
Examples:
  stickslip new                        drive.json
  stickslip new --list                 what there is
  stickslip new motor --template piezo
  stickslip new motor --schema ../schema/scenario-1.json";

/// A scenario file and values to put into it.
#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Put a value into the scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Print one line of JSON instead of tables; a number that is not finite, such as the pressure under an edge, is null
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Scenario files
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Put a value into every scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Print one line of JSON per file, also of the bad ones, to stdout
    #[arg(long)]
    pub(crate) json: bool,
    /// Errors only, no warnings
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// Name of the scenario: its file is NAME.json
    #[arg(value_name = "NAME", default_value = "drive")]
    pub(crate) name: PathBuf,
    /// What to start from
    #[arg(long, value_name = "TEMPLATE", default_value = "drive", value_parser = PossibleValuesParser::new(new::templates()))]
    pub(crate) template: String,
    /// What "$schema" shall say, a path or an address; no schema is then written
    #[arg(long, value_name = "WHERE")]
    pub(crate) schema: Option<String>,
    /// List the templates; write nothing
    #[arg(long)]
    pub(crate) list: bool,
}

/// Splits `path=value`.
pub(crate) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.to_owned())),
        None => Err("expected PATH=VALUE, such as run.duration=\"20 ms\"".to_owned()),
    }
}

/// Reads the tolerance of runs for steady motion and derivatives.
pub(crate) fn shooting(text: &str) -> Result<f64, String> {
    let tolerance: f64 = text.parse().map_err(|_| "expected a number such as 1e-12".to_owned())?;
    let range = 1e-13..=1e-6;
    if range.contains(&tolerance) { Ok(tolerance) } else { Err("expected 1e-13 to 1e-6".to_owned()) }
}

/// Splits `path=from..to`.
pub(crate) fn course(text: &str) -> Result<(String, String), String> {
    assignment(text).map_err(|_| "expected PATH=FROM..TO, such as contacts.ball.friction=0.1..0.6".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_one_that_the_stepper_has() {
        assert_eq!((shooting("1e-9"), shooting("1e-13")), (Ok(1e-9), Ok(1e-13)));
        assert!(["1e-14", "1e-3", "NaN", "-1e-9", "fine"].iter().all(|text| shooting(text).is_err()));
    }

    #[test]
    fn the_first_equals_sign_parts_path_and_value() {
        assert_eq!(assignment("title=a=b"), Ok(("title".to_owned(), "a=b".to_owned())));
        assert!(assignment("run.duration").is_err());
        assert_eq!(course("a.b=1..2"), Ok(("a.b".to_owned(), "1..2".to_owned())));
        assert!(course("a.b").is_err_and(|words| words.contains("PATH=FROM..TO")));
    }

    #[test]
    fn the_command_line_is_consistent() {
        <Arguments as clap::CommandFactory>::command().debug_assert();
    }
}
