//! The program `stickslip-lab`: measures and checks `stickslip` itself. It is for developers and not needed to design a
//! drive.

mod arguments;
mod commands;

use arguments::{Arguments, Command};
use clap::Parser;
use commands::{bench, gallery, soak, validate};
use std::process::ExitCode;
use stickslip_console::{answer, interrupt};

fn main() -> ExitCode {
    interrupt::outlive_file_limits();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(said) => return ExitCode::from(answer::told(&said)),
    };
    let verdict = match arguments.command {
        Command::Bench(arguments) => bench::bench(&arguments),
        Command::Soak(arguments) => soak::soak(&arguments),
        Command::Validate(arguments) => validate::validate(&arguments),
        Command::Gallery(arguments) => gallery::gallery(&arguments),
    };
    ExitCode::from(verdict.max(answer::verdict()).code())
}
