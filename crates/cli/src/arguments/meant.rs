//! Answers for commands that do not exist but that people type: the command meant.

use super::Arguments;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Words of other programs, of other spellings and of the field, with the command that does it.
const MEANT: [(&str, &str); 46] = [
    ("bifurcation", "branch"),
    ("characterise", "curve"),
    ("characterize", "curve"),
    ("continuation", "branch"),
    ("continue", "run --resume"),
    ("create", "new"),
    ("derivatives", "sensitivity"),
    ("describe", "info"),
    ("diff", "compare"),
    ("draw", "plot"),
    ("example", "new"),
    ("export", "realtime"),
    ("figure", "plot"),
    ("floquet", "steady"),
    ("fmu", "realtime"),
    ("force-speed", "curve FILE --curve force-speed"),
    ("generate", "new"),
    ("graph", "plot"),
    ("hertz", "contact"),
    ("holding-force", "curve FILE --curve holding-force"),
    ("hysteresis", "measure"),
    ("init", "new"),
    ("inspect", "info"),
    ("lint", "check"),
    ("loop", "measure"),
    ("materials-list", "materials"),
    ("optimise", "curve"),
    ("optimize", "curve"),
    ("orbit", "steady"),
    ("preload", "curve FILE --curve preload"),
    ("regression", "golden"),
    ("replay", "repro"),
    ("resume", "run --resume"),
    ("scan", "curve"),
    ("shooting", "steady"),
    ("show", "info"),
    ("sim", "run"),
    ("simulate", "run"),
    ("speed-frequency", "curve FILE --curve speed-frequency"),
    ("stall", "curve FILE --curve force-speed"),
    ("start", "run"),
    ("step-amplitude", "curve FILE --curve step-amplitude"),
    ("sweep", "curve"),
    ("template", "new"),
    ("test", "golden"),
    ("validate", "check"),
];

/// The error with the command meant, where a word is no command, or with an example, where something is missing.
pub(crate) fn answered(said: clap::Error) -> clap::Error {
    if said.kind() == ErrorKind::MissingRequiredArgument {
        return with_example(said);
    }
    // `curve force-speed FILE`
    if said.kind() == ErrorKind::UnknownArgument {
        let words: Vec<String> = std::env::args().skip(2).collect();
        return match MEANT
            .iter()
            .find(|(name, meant)| meant.contains("--curve") && words.iter().any(|word| word == name))
        {
            Some((name, meant)) => {
                let message = format!("\"{name}\" is a value of --curve; did you mean `stickslip {meant}`?");
                Arguments::command().error(ErrorKind::UnknownArgument, message)
            }
            None => said,
        };
    }
    let word = match said.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(word)) if said.kind() == ErrorKind::InvalidSubcommand => word.clone(),
        _ => return said,
    };
    let is_file = word.ends_with(".json") || std::path::Path::new(&word).is_file();
    let known = MEANT.iter().find(|(foreign, _)| word.eq_ignore_ascii_case(foreign));
    let meant = match known {
        _ if is_file => format!("stickslip run {word}"),
        Some((_, command)) => format!("stickslip {command}"),
        None => return said,
    };
    let what = if is_file { "is a file, not a command" } else { "is not a command" };
    let message = format!("\"{}\" {what}; did you mean `{}`?", word.escape_debug(), meant.escape_debug());
    Arguments::command().error(ErrorKind::InvalidSubcommand, message)
}

/// The error with the first example of its command.
fn with_example(mut said: clap::Error) -> clap::Error {
    let command = super::command();
    let words: Vec<String> = std::env::args().skip(1).take_while(|word| !word.starts_with('-')).collect();
    let asked = words.iter().map_while(|word| command.find_subcommand(word)).next();
    let help =
        asked.and_then(clap::Command::get_after_long_help).map(ToString::to_string).unwrap_or_default();
    if let Some(example) = help.lines().map(str::trim).find(|line| line.starts_with("stickslip ")) {
        let tip = ContextValue::StyledStrs(vec![format!("for example {example}").into()]);
        said.insert(ContextKind::Suggested, tip);
    }
    said
}
