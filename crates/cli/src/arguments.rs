//! The command line.

pub(crate) mod compare;
pub(crate) mod contact;
pub(crate) mod curve;
pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod golden;
pub(crate) mod import;
pub(crate) mod look;
pub(crate) mod map;
pub(crate) mod meant;
pub(crate) mod measure;
mod overview;
mod pictures;
mod reading;
pub(crate) mod realtime;
pub(crate) mod run;
pub(crate) mod sensitivity;
pub(crate) mod steady;
pub(crate) mod study;
mod threads;
pub(crate) mod view;

use crate::commands::{new, schema};
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

pub(crate) use compare::CompareArguments;
pub(crate) use contact::ContactArguments;
pub(crate) use curve::CurveArguments;
pub(crate) use export::{ExportCommand, Fmi, FmuArguments};
pub(crate) use fit::FitArguments;
pub(crate) use import::ImportArguments;
pub(crate) use map::MapArguments;
pub(crate) use measure::{MeasureArguments, RigStiffness};
pub(crate) use overview::command;
pub(crate) use pictures::{PlotArguments, ReproArguments};
pub(crate) use realtime::RealtimeArguments;
pub(crate) use run::{ConductArguments, RunArguments};
pub(crate) use sensitivity::SensitivityArguments;
pub(crate) use steady::{BranchArguments, SteadyArguments};
pub(crate) use view::ViewArguments;

/// A simulator of stick-slip drives: piezo inertia drives, fretting rigs
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write a ready-to-run scenario file from a template
    ///
    /// Writes the scenario file NAME.json and the JSON Schema of scenario files, schema/scenario-1.json. Editors that support JSON Schema
    /// use the schema to complete keys and to mark errors. An existing scenario is never overwritten. Exit codes: 0 done, 2 bad input.
    #[command(after_long_help = NEW_EXAMPLES)]
    New(NewArguments),
    /// Check scenario files and report their errors, without running them
    ///
    /// Prints "ok" for each file without errors. For each error, prints the place in the file, the fault and the allowed values. Also
    /// warns of allowed but implausible values: loads beyond the friction limit, stacks without damping, pressures beyond yield, and
    /// unlikely moduli, masses, strokes and resonances. Exit codes: 0 all files are free of errors, 2 a file has errors.
    #[command(after_long_help = CHECK_EXAMPLES)]
    Check(CheckArguments),
    /// Show stiffness, slip limits, vibration modes and cost of a scenario before a run
    ///
    /// Prints tables and writes no file. Exit codes: 0 done, 2 bad input.
    #[command(after_long_help = INFO_EXAMPLES)]
    Info(InfoArguments),
    /// Run scenarios and write tables, a summary and plots; resume interrupted runs
    ///
    /// Every run writes trace.csv (all channels over time), events.csv, summary.json, scenario.json and plots. A run of a drive also writes
    /// steps.csv, a table of the steps, and for a burst or a sequence pulses.csv, the step of each pulse. A run with a contact that moves
    /// back and forth also writes cycles.csv, a table of the hysteresis cycles. The section "output" of a scenario can request springs.csv, memory.csv, fields.csv and friction.csv.
    ///
    /// All files appear together at the end of the run. A folder therefore contains either complete results or no results. Numbers that
    /// are not finite are null in JSON.
    ///
    /// Exit codes: 0 done; 2 bad input; 3 a run stopped early; 130 interrupted. With --strict, code 3 also means that results have
    /// warnings. For several runs, the exit code is the largest of their codes. A run that stops early or is interrupted writes the
    /// results that it has computed so far.
    #[command(after_long_help = run::RUN_EXAMPLES)]
    Run(RunArguments),
    /// Draw plots from the results of earlier runs
    ///
    /// Draws the plots that the scenario names, byte-identical to the plots that `run` draws. The option --plots selects other plots of the
    /// same results. A table is refused if its SHA-256 differs from the value in summary.json. Exit codes: 0 done; 2 there are no results,
    /// or the results lack data that a plot needs; 3 a plot cannot be written.
    #[command(after_long_help = pictures::PLOT_EXAMPLES)]
    Plot(PlotArguments),
    /// Compare the results of two runs within tolerances: channels, events, summary values
    #[command(long_about = compare::ABOUT, after_long_help = compare::EXAMPLES)]
    Compare(CompareArguments),
    /// Explain a scenario key, a table column, a result, a symbol or a term
    ///
    /// A name may be complete, such as slider.x_m, or only the last part of a complete name, such as x_m. Exit codes: 0 done, 2 the name is
    /// unknown.
    #[command(after_long_help = EXPLAIN_EXAMPLES)]
    Explain {
        /// Names to explain; without a name the command lists all columns and results in Markdown
        #[arg(value_name = "NAME")]
        names: Vec<String>,
    },
    /// Trace a curve: step versus amplitude, speed versus frequency or load, holding force
    #[command(long_about = curve::ABOUT, after_long_help = curve::EXAMPLES)]
    Curve(CurveArguments),
    /// Find the periodic motion without a long run: step, speed, stability
    #[command(long_about = steady::ABOUT, after_long_help = steady::EXAMPLES)]
    Steady(SteadyArguments),
    /// Follow the periodic motion while a parameter changes: folds, bifurcations
    #[command(long_about = steady::BRANCH_ABOUT, after_long_help = steady::BRANCH_EXAMPLES)]
    Branch(BranchArguments),
    /// Compute the sensitivity of results to every parameter, with error estimates
    #[command(long_about = sensitivity::ABOUT, after_long_help = sensitivity::EXAMPLES)]
    Sensitivity(SensitivityArguments),
    /// Run thousands of variants of a scenario: grids, distributions, sensitivity indices
    #[command(long_about = study::ABOUT, after_long_help = study::EXAMPLES, subcommand)]
    Study(study::StudyCommand),
    /// Map a result over two parameters: contours; borders of stick, partial and gross slip
    #[command(long_about = map::ABOUT, after_long_help = map::EXAMPLES)]
    Map(MapArguments),
    /// Solve a single contact without a run: constants, load histories, stresses
    #[command(long_about = contact::ABOUT, after_long_help = contact::EXAMPLES)]
    Contact(ContactArguments),
    /// Show how a measured table is read; write the recipe
    #[command(long_about = import::ABOUT, after_long_help = import::EXAMPLES)]
    Import(ImportArguments),
    /// Evaluate measured hysteresis loops from a table; compare them with a simulation
    #[command(long_about = measure::ABOUT, after_long_help = measure::EXAMPLES)]
    Measure(MeasureArguments),
    /// Fit parameters to a measured loop or trajectory: values, intervals, correlations
    #[command(long_about = fit::ABOUT, after_long_help = fit::EXAMPLES)]
    Fit(FitArguments),
    /// Write a scenario for another program: as an FMU
    #[command(subcommand)]
    Export(ExportCommand),
    /// Write scenarios as one interactive HTML file with the engine inside
    #[command(long_about = view::ABOUT, after_long_help = view::EXAMPLES)]
    View(ViewArguments),
    /// Run a drive in real time with inputs and outputs over UDP or shared memory
    #[command(long_about = realtime::ABOUT, after_long_help = realtime::EXAMPLES)]
    Realtime(Box<RealtimeArguments>),
    /// Record reference results of scenarios; check later whether the results change
    #[command(long_about = golden::ABOUT, after_long_help = golden::EXAMPLES, subcommand)]
    Golden(golden::GoldenCommand),
    /// Rerun the scenario embedded in a plot file and compare the results
    ///
    /// A PNG or SVG file drawn by `run` or `plot` contains the complete scenario and a fingerprint of the trace and the events. The command
    /// prints "identical", or the name of a channel that differs and the time at which the difference begins. Exit codes: 0 identical;
    /// 1 different; 2 the file is not a plot of `run` or `plot`; 3 the results cannot be written, or --wall was reached; 130 interrupted.
    #[command(after_long_help = pictures::REPRO_EXAMPLES)]
    Repro(ReproArguments),
    /// List the built-in materials with their elastic constants and sources
    #[command(
        after_long_help = "Example:\n  stickslip materials\n\n  With \"materials\": [\"ruby\", \"hardened steel\"] in a contact the scenario needs no section \"materials\"."
    )]
    Materials,
    /// Print the JSON Schema of scenario files, study files or recipes
    #[command(
        after_long_help = "Examples:\n  stickslip schema > scenario-1.json\n  stickslip schema study > study-1.json"
    )]
    Schema {
        /// Kind of file
        #[arg(value_enum, default_value_t = schema::Kind::Scenario)]
        kind: schema::Kind,
    },
    /// Print the script with which a shell completes commands and options
    #[command(after_long_help = COMPLETIONS_EXAMPLES)]
    Completions {
        /// Name of the shell
        shell: clap_complete::Shell,
    },
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
  stickslip explain friction              a key of a scenario
  stickslip explain run.until_steady      a key with its path
  stickslip explain ball.stick_m          a column of trace.csv
  stickslip explain steady.step_m         a result of summary.json

Without a name it lists all columns and results: the page docs/definitions.md.";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  stickslip completions bash > ~/.local/share/bash-completion/completions/stickslip
  stickslip completions zsh  > ~/.zfunc/_stickslip       with fpath+=~/.zfunc before compinit in ~/.zshrc
  stickslip completions fish > ~/.config/fish/completions/stickslip.fish";

const NEW_EXAMPLES: &str = "\
Examples:
  stickslip new                        drive.json
  stickslip new --list                 list the templates
  stickslip new motor --template piezo
  stickslip new motor --schema ../schema/scenario-1.json";

/// A scenario file and values to put into it.
#[derive(Debug, Args)]
pub(crate) struct InfoArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Set a value of the scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Print one line of JSON instead of tables; numbers that are not finite are null
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Scenario files
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Set a value of every scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Print one line of JSON per file to stdout
    #[arg(long)]
    pub(crate) json: bool,
    /// Print errors only, no warnings
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct NewArguments {
    /// Name of the scenario; the file is NAME.json
    #[arg(value_name = "NAME", default_value = "drive")]
    pub(crate) name: PathBuf,
    /// Name of the template
    #[arg(long, value_name = "TEMPLATE", default_value = "drive", value_parser = PossibleValuesParser::new(new::templates()))]
    pub(crate) template: String,
    /// Value of the key "$schema": path or URL of an existing schema; with this option the command writes no schema
    #[arg(long, value_name = "WHERE")]
    pub(crate) schema: Option<String>,
    /// List all templates and write no file
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
