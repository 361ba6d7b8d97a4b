//! Writes the output of a command to stdout and messages about it to stderr.

use crate::verdict::Verdict;
use crate::visible::{Spelling, visible};
use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;
use stickslip_run::Job;
use stickslip_run::complaint::words;

/// The first error of writing to stdout, if there was one.
static LOST: OnceLock<io::Error> = OnceLock::new();

/// Prints a line to stdout.
pub fn say(line: Arguments<'_>) {
    keep(writeln!(io::stdout(), "{}", visible(&line.to_string(), Spelling::Text)));
}

/// Prints a line of JSON to stdout.
pub fn say_json(line: &str) {
    keep(writeln!(io::stdout(), "{}", visible(line, Spelling::Json)));
}

/// Prints a line to stderr. Write errors are ignored.
pub fn complain(line: Arguments<'_>) {
    let _ = writeln!(io::stderr(), "{}", visible(&line.to_string(), Spelling::Text));
}

/// Prints the warnings about a scenario to stderr.
pub fn warn(job: &Job) {
    for warning in job.warnings() {
        complain(format_args!("warning: {warning}"));
    }
}

/// Flushes stdout and returns [`Verdict::Stopped`] if some output could not be written.
///
/// A closed pipe is not an error. Other errors, such as a full disk, are reported on stderr.
pub fn verdict() -> Verdict {
    keep(io::stdout().flush());
    LOST.get().map_or(Verdict::Done, |error| {
        complain(format_args!("the output cannot be written: {}", words(error)));
        Verdict::Stopped
    })
}

/// Prints the help or the argument error of `clap` and returns the exit code.
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
        // The first error is kept, because `set` fails for later errors.
        let _ = LOST.set(error);
    }
}
