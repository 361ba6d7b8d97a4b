//! The program `stickslip`: reads scenarios, runs them, and writes tables, a summary and plots.
//!
//! It handles arguments, messages and exit codes; the libraries do the computing, writing and drawing. Modules:
//! [`arguments`] (command line) and [`commands`] (one module per command).

mod arguments;
mod commands;

use arguments::{Arguments, Command, meant};
use clap::FromArgMatches;
use commands::{
    branch, check, compare, completions, contact, curve, explain, export, fit, golden, import, info, map,
    materials, measure, new, plot, realtime, repro, run, schema, sensitivity, steady, study, view,
};
use std::process::ExitCode;

fn main() -> ExitCode {
    stickslip_console::interrupt::outlive_file_limits();
    let matches = arguments::command().try_get_matches();
    let arguments = match matches.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
        Err(said) => return ExitCode::from(stickslip_console::answer::told(&meant::answered(said))),
    };
    let verdict = match arguments.command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Info(arguments) => info::info(&arguments),
        Command::Curve(arguments) => curve::curve(&arguments),
        Command::Contact(arguments) => contact::contact(&arguments),
        Command::Import(arguments) => import::import(&arguments),
        Command::Measure(arguments) => measure::measure(&arguments),
        Command::Export(command) => export::export(&command),
        Command::View(arguments) => view::view(&arguments),
        Command::Fit(arguments) => fit::fit(&arguments),
        Command::Sensitivity(arguments) => sensitivity::sensitivity(&arguments),
        Command::Branch(arguments) => branch::branch(&arguments),
        Command::Steady(arguments) => steady::steady(&arguments),
        Command::Map(arguments) => map::map(&arguments),
        Command::Study(command) => study::study(&command),
        Command::New(arguments) => new::new(&arguments),
        Command::Schema { kind } => schema::print(kind),
        Command::Explain { names } => explain::explain(&names),
        Command::Materials => materials::list(),
        Command::Completions { shell } => completions::print(shell),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Golden(command) => golden::golden(&command),
        Command::Plot(arguments) => plot::plot(&arguments),
        Command::Repro(arguments) => repro::repro(&arguments),
        Command::Realtime(arguments) => realtime::realtime(&arguments),
    };
    ExitCode::from(verdict.max(stickslip_console::answer::verdict()).code())
}

/// C functions that dependencies call by name (progress bar, Parquet writer, packing of FMUs). They replace those of the machine's C
/// library, so that results are the same everywhere.
mod shared_names {
    /// x^y.
    #[expect(unsafe_code, reason = "a name that C libraries define as well; the function is safe")]
    #[unsafe(no_mangle)]
    extern "C" fn pow(x: f64, y: f64) -> f64 {
        math::powf(x, y)
    }

    /// Natural logarithm.
    #[expect(unsafe_code, reason = "a name that C libraries define as well; the function is safe")]
    #[unsafe(no_mangle)]
    extern "C" fn log(x: f64) -> f64 {
        math::ln(x)
    }

    /// Binary logarithm.
    #[expect(unsafe_code, reason = "a name that C libraries define as well; the function is safe")]
    #[unsafe(no_mangle)]
    extern "C" fn log2(x: f64) -> f64 {
        math::log2(x)
    }

    /// Decimal logarithm.
    #[expect(unsafe_code, reason = "a name that C libraries define as well; the function is safe")]
    #[unsafe(no_mangle)]
    extern "C" fn log10(x: f64) -> f64 {
        math::log10(x)
    }
}
