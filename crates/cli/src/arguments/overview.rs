//! The first help: commands by what people do with them, on one screen.

use super::Arguments;
use clap::CommandFactory;
use std::fmt::Write;

/// Groups of commands, those of every day first.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Every day", &["new", "check", "info", "run", "plot", "view", "compare", "explain"]),
    ("Design a drive", &["curve", "steady", "branch", "sensitivity", "study", "map"]),
    ("Contacts and measured data", &["contact", "import", "measure", "fit"]),
    ("Other programs", &["export", "realtime"]),
    ("Verification and reference", &["golden", "repro", "materials", "schema", "completions"]),
];
const TEMPLATE: &str = "{name} {version}: {about}\n\n{usage-heading} {usage}{after-help}";
const EXIT_CODES: &str = "
Options: -h, --help (after a command: help of the command), -V, --version
Exit codes: 0 done; 1 a comparison found a difference; 2 bad input, nothing was written; 3 a run
stopped early or a file could not be written; 130 interrupted, results so far are written

Start:  `stickslip new`, then `stickslip run drive.json`; the results are in results/drive";
const PLOTS: &str =
    "Options for plots: --format, --theme, --scale, --width, --no-title; see `stickslip plot --help`";
/// Options of plots, which `plot --help` alone describes.
const LOOK: [&str; 5] = ["formats", "themes", "scale", "width", "no_title"];

/// The command line with its help.
pub(crate) fn command() -> clap::Command {
    let mut command = Arguments::command();
    let mut overview = String::new();
    for (group, names) in GROUPS {
        let _ = writeln!(overview, "\n{group}");
        for found in names.iter().filter_map(|name| command.find_subcommand(name)) {
            let about = found.get_about().map(ToString::to_string).unwrap_or_default();
            let _ = writeln!(overview, "  {:<12} {about}", found.get_name());
        }
    }
    let drawing: Vec<String> = command
        .get_subcommands()
        .filter(|sub| sub.get_name() != "plot" && sub.get_arguments().any(|one| one.get_id() == LOOK[0]))
        .map(|sub| sub.get_name().to_owned())
        .collect();
    for name in drawing {
        command = command.mut_subcommand(name, |sub| {
            let examples = sub.get_after_long_help().map(ToString::to_string).unwrap_or_default();
            let hidden = LOOK.into_iter().fold(sub, |sub, id| sub.mut_arg(id, |one| one.hide(true)));
            hidden.after_long_help(format!(
                "{examples}

{PLOTS}"
            ))
        });
    }
    // So many options fit on two pages only side by side with what they do.
    command = command.mut_subcommand("realtime", |sub| {
        let long =
            |text: Option<&clap::builder::StyledStr>| text.map(ToString::to_string).unwrap_or_default();
        let (about, examples) = (long(sub.get_long_about()), long(sub.get_after_long_help()));
        let help = clap::Arg::new("help")
            .short('h')
            .long("help")
            .action(clap::ArgAction::HelpShort)
            .help("Print help");
        sub.about(about).after_help(examples).disable_help_flag(true).arg(help)
    });
    command.help_template(TEMPLATE).after_help(overview + EXIT_CODES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_on_the_first_screen_once() {
        let mut listed: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        let command = command();
        let mut known: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        listed.sort_unstable();
        known.sort_unstable();
        assert_eq!(listed, known);
        let help = command.clone().render_help().to_string();
        assert!(help.lines().count() <= 45 && help.lines().all(|line| line.chars().count() <= 100), "{help}");
    }

    #[test]
    fn the_help_of_a_command_takes_a_page_or_two() {
        for sub in command().get_subcommands_mut() {
            let name = sub.get_name().to_owned();
            let help = if name == "realtime" { sub.render_help() } else { sub.render_long_help() };
            let lines = help.to_string().lines().count();
            assert!(lines <= 100, "{name}: {lines}");
        }
    }
}
