//! `stickslip completions SHELL`: completion script for a shell.

use crate::arguments::command;
use clap_complete::Shell;
use stickslip_console::answer::say;
use stickslip_console::verdict::Verdict;

/// Prints the script.
pub(crate) fn print(shell: Shell) -> Verdict {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command(), "stickslip", &mut script);
    say(format_args!("{}", String::from_utf8_lossy(&script).trim_end()));
    Verdict::Done
}
