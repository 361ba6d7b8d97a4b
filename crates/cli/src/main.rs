//! The program `stickslip`: reads scenarios, runs them, writes tables, a summary and pictures.
//!
//! In reading order: [`arguments`]; the commands around a run, [`mod@new`], [`check`], [`info`], [`schema`]; [`batch`] (several
//! files, messages in order) and its [`verdict`]; [`answer`] (what is printed); [`run`] (one job from start to files) and
//! [`report`] (what is told); [`figures`] with [`look`] (pictures); [`progress`], [`interrupt`]; [`redraw`]; [`origin`] (what is
//! read back from a picture) and [`repro`]; [`gallery`]; [`compare`] (tells two runs apart); [`mod@bench`] (what accuracy
//! costs).

mod answer;
mod arguments;
mod batch;
mod bench;
mod check;
mod compare;
mod gallery;
mod info;
mod interrupt;
mod look;
mod new;
mod progress;
mod redraw;
mod report;
mod repro;
mod run;
mod schema;
mod verdict;

use arguments::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let verdict = match Arguments::parse().command {
        Command::Run(arguments) => batch::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Info(arguments) => info::info(&arguments),
        Command::New(arguments) => new::new(&arguments),
        Command::Schema => schema::print(),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Plot(arguments) => redraw::plot(&arguments),
        Command::Repro(arguments) => repro::repro(&arguments),
        Command::Bench(arguments) => bench::bench(&arguments),
        Command::Gallery(arguments) => gallery::gallery(&arguments),
    };
    ExitCode::from(verdict.max(answer::verdict()).code())
}
