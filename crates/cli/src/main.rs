//! The program `stickslip`: reads scenarios, runs them, writes tables, a summary and pictures.
//!
//! In reading order: [`arguments`]; the commands around a run, [`new`], [`check`], [`info`], [`schema`]; [`batch`] (several
//! files, messages in order) and its [`verdict`]; [`answer`] and [`complaint`] (what is printed); [`job`] (a scenario that was found good, with everything a run needs)
//! within its [`limits`]; [`run`] (one job from start to files); [`record`] with [`table`], [`insides`], [`sheet`],
//! [`kept`], [`series`], [`tracks`] and [`books`] (what a run leaves behind); [`contact_path`], [`trail`] and [`periods`]
//! (series prepared for the analysis); [`summary`], [`report`] (what is told); [`figures`] with [`look`],
//! [`provenance`] and [`fingerprint`] (pictures and what they carry); [`folder`] (how files are written); [`progress`],
//! [`interrupt`]; [`results`] with [`replay`], [`rows`], [`springs`] and [`curves`] (what is read back from a folder) and
//! [`redraw`]; [`origin`] (what is read back from a picture) and [`repro`]; [`gallery`]; [`frame`] (tables read back whole);
//! [`markdown`] (pages); [`compare`] (tells two runs apart); [`mod@bench`] (what accuracy costs).

mod answer;
mod arguments;
mod batch;
mod bench;
mod books;
mod check;
mod compare;
mod complaint;
mod contact_path;
mod curves;
mod figures;
mod fingerprint;
mod folder;
mod frame;
mod gallery;
mod info;
mod insides;
mod interrupt;
mod job;
mod kept;
mod limits;
mod look;
mod markdown;
mod new;
mod origin;
mod periods;
mod progress;
mod provenance;
mod real;
mod record;
mod redraw;
mod replay;
mod report;
mod repro;
mod results;
mod rows;
mod run;
mod schema;
mod series;
mod sheet;
mod springs;
mod summary;
mod table;
mod tracks;
mod trail;
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
