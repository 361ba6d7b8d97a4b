//! The answer of a command, on stdout.

use crate::verdict::Verdict;
use crate::visible::{Spelling, visible};
use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;
use stickslip_run::Job;
use stickslip_run::complaint::words;

/// Why some of the answer was lost.
static LOST: OnceLock<io::Error> = OnceLock::new();

/// Prints a line.
pub fn say(line: Arguments<'_>) {
    keep(writeln!(io::stdout(), "{}", visible(&line.to_string(), Spelling::Text)));
}

/// Prints a line of JSON.
pub fn say_json(line: &str) {
    keep(writeln!(io::stdout(), "{}", visible(line, Spelling::Json)));
}

/// Says a line on stderr. Nobody listening is no reason to stop.
pub fn complain(line: Arguments<'_>) {
    let _ = writeln!(io::stderr(), "{}", visible(&line.to_string(), Spelling::Text));
}

/// Says what is allowed in a scenario and probably not meant. Nobody listening is no reason to stop.
pub fn warn(job: &Job) {
    for warning in job.warnings() {
        complain(format_args!("warning: {warning}"));
    }
}

/// What all that was said has come to. A reader that has seen enough and closes its pipe is no fault; a full disk is
/// told, or a file would hold half an answer and the exit code call it whole.
pub fn verdict() -> Verdict {
    keep(io::stdout().flush());
    LOST.get().map_or(Verdict::Done, |error| {
        complain(format_args!("the output cannot be written: {}", words(error)));
        Verdict::Stopped
    })
}

/// Prints help, or what is wrong with the arguments; gives the exit code.
pub fn told(said: &clap::Error) -> u8 {
    let printed = said.print();
    if !said.use_stderr() {
        keep(printed);
    }
    verdict().code().max(u8::try_from(said.exit_code()).unwrap_or(u8::MAX))
}

fn keep(result: io::Result<()>) {
    if let Err(error) = result
        && error.kind() != ErrorKind::BrokenPipe
    {
        // The first is told.
        let _ = LOST.set(error);
    }
}
