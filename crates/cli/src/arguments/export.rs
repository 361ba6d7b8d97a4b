//! The command line of exports.

use super::assignment;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Long help; paragraphs are broken where the terminal ends.
pub(crate) const ABOUT: &str = "\
Write a scenario as an FMU for Simulink, FMPy, PathSim and other hosts

An FMU (functional mock-up unit) is a file that a host runs as a part of its own model. The FMU contains the scenario and the C library \
of stickslip. It supports co-simulation with FMI 2.0 or 3.0: steps of any length, saving and restoring of states, also in another \
process, and many instances.

Inputs are the waveforms of kind `input` and the commands of generators. Outputs are the columns of trace.csv, without their units in \
the names. Parameters are numbers that the host may set before the start. The section `interface` of the scenario chooses them; \
--parameter adds parameters. `stickslip explain interface` describes it.

The C library is libstickslip.so beside the program, or --library; `cargo build --release` makes both. Exit codes: 0 done, 2 bad input, \
3 the FMU cannot be written.";

pub(crate) const EXAMPLES: &str = "\
Examples:
  stickslip export fmu drive.json
  stickslip export fmu drive.json --fmi 3 --out plant.fmu
  stickslip export fmu drive.json --parameter contacts.ball.friction --parameter bodies.slider.mass";

/// What is exported.
#[derive(Debug, Subcommand)]
pub(crate) enum ExportCommand {
    /// Write a scenario as an FMU for Simulink, FMPy, PathSim and other hosts
    #[command(long_about = ABOUT, after_long_help = EXAMPLES)]
    Fmu(FmuArguments),
}

/// Version of the interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Fmi {
    /// FMI 2.0
    #[value(name = "2")]
    Two,
    /// FMI 3.0
    #[value(name = "3")]
    Three,
}

#[derive(Debug, Args)]
pub(crate) struct FmuArguments {
    /// Scenario file
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Version of the functional mock-up interface
    #[arg(long, value_name = "VERSION", default_value = "2")]
    pub(crate) fmi: Fmi,
    /// FMU to write; by default the name of the scenario with .fmu, in this folder
    #[arg(long, value_name = "NAME.fmu")]
    pub(crate) out: Option<PathBuf>,
    /// Number of the scenario that the host may set before the start, such as contacts.ball.friction; repeatable
    #[arg(long = "parameter", value_name = "PATH")]
    pub(crate) parameters: Vec<String>,
    /// Set a value of the scenario, such as run.duration="20 ms"
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// C library of stickslip to put into the FMU
    #[arg(long, value_name = "FILE")]
    pub(crate) library: Option<PathBuf>,
}
