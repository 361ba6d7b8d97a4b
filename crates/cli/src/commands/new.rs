//! `stickslip new`: writes a scenario that can be run, and a schema for text editors.

use crate::arguments::NewArguments;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_run::complaint::words;
use stickslip_run::folder;
use stickslip_run::markdown::word;
use stickslip_scenario::{Scenario, schema};
use thiserror::Error;

/// Templates by name, from the examples and the folder `templates`.
const TEMPLATES: [(&str, &str); 18] = [
    ("drive", include_str!("../../scenarios/quickstart.json")),
    ("datasheet", include_str!("../../templates/datasheet.json")),
    ("piezo", include_str!("../../scenarios/piezo_stack.json")),
    ("fretting", include_str!("../../templates/fretting.json")),
    ("oblique", include_str!("../../scenarios/oblique_loading.json")),
    ("vibration", include_str!("../../scenarios/vibrated_slider.json")),
    ("linear", include_str!("../../scenarios/three_ball_stage.json")),
    ("six_balls", include_str!("../../templates/six_balls.json")),
    ("smooth_impact", include_str!("../../templates/smooth_impact.json")),
    ("walking", include_str!("../../templates/walking.json")),
    ("vertical", include_str!("../../scenarios/vertical_climber.json")),
    ("assisted", include_str!("../../templates/assisted.json")),
    ("rotary", include_str!("../../templates/rotary.json")),
    ("hobby", include_str!("../../templates/hobby.json")),
    ("oscillator", include_str!("../../templates/oscillator.json")),
    ("belt", include_str!("../../scenarios/belt.json")),
    ("bounce", include_str!("../../scenarios/bounce.json")),
    ("asperities", include_str!("../../scenarios/asperities.json")),
];
/// Schema path in the examples.
const SCHEMA_OF_EXAMPLES: &str = "../schema/scenario-1.json";
/// Schema path in a new scenario: a separate folder, so that `check *.json` finds scenarios only.
const SCHEMA: &str = "schema/scenario-1.json";
/// Text that every version of this schema contains.
const SCHEMA_MARK: &str = "\"title\": \"stickslip scenario, version 1\"";

/// Error that stops the command.
#[derive(Debug, Error)]
enum NewError {
    #[error("{}: exists already\n   help: give another name, or remove this file first", .0.display())]
    Exists(PathBuf),
    #[error("{}: exists already and is not a schema of stickslip\n   help: give the path of the schema with --schema", .0.display())]
    OtherSchema(PathBuf),
    #[error("{}: expected a file name, such as motor or drives/motor", .0.display())]
    NoName(PathBuf),
    #[error("{}: cannot be written: {}", .path.display(), words(.source))]
    Write { path: PathBuf, source: io::Error },
}

/// Returns the names of the templates.
pub(crate) fn templates() -> [&'static str; TEMPLATES.len()] {
    TEMPLATES.map(|(name, _)| name)
}

/// Writes a scenario and its schema, or lists the templates.
pub(crate) fn new(arguments: &NewArguments) -> Verdict {
    if arguments.list {
        for (name, text) in TEMPLATES {
            say(format_args!("{name:13} {}", title(text)));
        }
        return Verdict::Done;
    }
    let text = TEMPLATES.iter().find(|(name, _)| *name == arguments.template).map_or("", |(_, text)| text);
    match write(&arguments.name, text, arguments.schema.as_deref()) {
        Ok(file) => {
            // A name that starts with a dash would be taken for an option.
            let file = if file.as_os_str().as_encoded_bytes().starts_with(b"-") {
                Path::new(".").join(file)
            } else {
                file
            };
            let (title, run) = (title(text), word(&file));
            say(format_args!("{}: {title}\n  next: stickslip run {run}", file.display()));
            Verdict::Done
        }
        Err(error) => {
            complain(format_args!("{error}"));
            Verdict::BadInput
        }
    }
}

/// Returns the title of a template.
fn title(text: &str) -> String {
    Scenario::from_str(text, "template", "").map(|scenario| scenario.title).unwrap_or_default()
}

/// Writes a template as NAME.json, and the schema unless `at` gives another location. Only an older schema is overwritten.
fn write(name: &Path, text: &str, at: Option<&str>) -> Result<PathBuf, NewError> {
    let mut file = name.to_owned();
    // "drives/" is a folder, and ".json" has no name.
    let ends = |end: &str| name.as_os_str().as_encoded_bytes().ends_with(end.as_bytes());
    if name.file_name().is_none_or(|own| own == ".json") || ends("/") || ends(std::path::MAIN_SEPARATOR_STR) {
        return Err(NewError::NoName(file));
    }
    if name.extension().is_none_or(|extension| extension != "json") {
        file.as_mut_os_string().push(".json");
    }
    if file.symlink_metadata().is_ok() {
        return Err(NewError::Exists(file));
    }
    let parent = file.parent().unwrap_or(Path::new("")).to_owned();
    let address = match at {
        Some(address) => address.to_owned(),
        None => {
            write_schema(&parent.join(SCHEMA))?;
            format!("./{SCHEMA}")
        }
    };
    let [old, new] =
        [SCHEMA_OF_EXAMPLES, &address].map(|address| serde_json::Value::from(address).to_string());
    publish(&file, &text.replacen(&old, &new, 1), false)?;
    Ok(file)
}

/// Writes the schema if there is none or an older one.
fn write_schema(path: &Path) -> Result<(), NewError> {
    match std::fs::read_to_string(path) {
        Ok(known) if known == schema() => Ok(()),
        Ok(other) if !other.contains(SCHEMA_MARK) => Err(NewError::OtherSchema(path.to_owned())),
        _ => publish(path, &schema(), true),
    }
}

/// Writes a complete file or nothing. Replaces an existing file only if `replace` is set.
fn publish(path: &Path, text: &str, replace: bool) -> Result<(), NewError> {
    let failed = |source: io::Error| NewError::Write { path: path.to_owned(), source };
    // The parent of a name without a folder is "", the current folder.
    let parent = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(parent).map_err(failed)?;
    let mut draft = folder::draft(parent, "new").map_err(failed)?;
    draft.write_all(text.as_bytes()).and_then(|()| draft.as_file().sync_all()).map_err(failed)?;
    let published = if replace { draft.persist(path) } else { draft.persist_noclobber(path) };
    match published {
        Ok(_) => Ok(()),
        Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
            Err(NewError::Exists(path.to_owned()))
        }
        Err(error) => Err(failed(error.error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_template_names_the_schema_where_it_is_replaced() {
        for (name, text) in TEMPLATES {
            assert_eq!(text.matches(&format!("\"$schema\": \"{SCHEMA_OF_EXAMPLES}\"")).count(), 1, "{name}");
            assert!(!title(text).is_empty(), "{name}");
        }
        assert!(schema().contains(SCHEMA_MARK));
    }
}
