//! Reference results ("goldens") for regression tests of scenarios.
//!
//! A golden is a folder with an excerpt of results, which [`compare`](crate) reads like other results. The folder also contains the
//! recorded scenario and a [`Recipe`]. With the recipe, the current scenario file is run again for the comparison.

mod excerpt;
mod log;

use crate::ResultsError;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};
use stickslip_run::complaint::words;
use stickslip_run::files::SCENARIO;
use stickslip_run::folder::Folder;
use stickslip_run::guard;
use stickslip_run::{Job, Refusal, hash};
use thiserror::Error;

/// File that identifies a folder as a golden.
const RECIPE: &str = "recipe.json";
/// Format number of recipe files that this program version writes and reads.
const FORMAT: u32 = 1;
/// Plot of the channel with the largest difference.
pub const PICTURE: &str = "difference.png";

/// Recipe: instructions for repeating the run of a golden.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Format number of the files.
    pub format: u32,
    /// Path of the scenario file, relative to the folder of all goldens.
    pub file: PathBuf,
    /// Overrides of the scenario, in the notation of `run --set`.
    #[serde(default)]
    pub set: Vec<String>,
    /// Channels, summary values, bodies or contacts that are not compared.
    #[serde(default)]
    pub ignore: Vec<String>,
}

/// A folder that contains goldens, each in its own folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Goldens {
    root: PathBuf,
}

/// One golden.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Golden {
    /// Name of the scenario.
    pub name: String,
    /// Folder of the golden.
    pub folder: PathBuf,
    /// Instructions for repeating the run of the golden.
    pub recipe: Recipe,
}

/// Error for a golden that is missing, invalid or cannot be compared.
#[derive(Debug, Error)]
pub enum GoldenError {
    /// The folder contains no golden.
    #[error("{}: there is no reference result\n   help: stickslip golden record FILE… --out {}", .0.display(), .0.display())]
    None(PathBuf),
    /// No golden has this name.
    #[error("{}: there is no reference result \"{name}\"{}", .root.display(), .help.as_ref().map(|help| format!("; {help}")).unwrap_or_default())]
    Unknown {
        /// Folder of all goldens.
        root: PathBuf,
        /// The unknown name.
        name: String,
        /// Suggestion of a similar name.
        help: Option<String>,
    },
    /// A golden of the same name exists already.
    #[error("{}: exists already\n   help: stickslip golden accept {} {name} --reason \"why it changes\"", .root.join(.name).display(), .root.display())]
    Exists {
        /// Folder of all goldens.
        root: PathBuf,
        /// Name of the golden.
        name: String,
    },
    /// The scenario file of a golden does not exist.
    #[error("gone: {} does not exist", .0.display())]
    Gone(PathBuf),
    /// The files have a format that this program version does not read.
    #[error("damaged: {} has format {found}, this version reads {FORMAT}: record it again", .path.display())]
    Format {
        /// Path of the file.
        path: PathBuf,
        /// Format number in the file.
        found: u64,
    },
    /// The recipe is invalid, or the recorded scenario was changed.
    #[error("damaged: {}: {message}", .path.display())]
    Recipe {
        /// Path of the file.
        path: PathBuf,
        /// Description of the error.
        message: String,
    },
    /// Tables or summary values are damaged or were changed after recording.
    #[error("damaged: {0}")]
    Damaged(ResultsError),
    /// The reason for a change has fewer than eight letters.
    #[error("--reason: expected a reason of eight letters or more")]
    NoReason,
    /// The scenario is invalid.
    #[error(transparent)]
    Refusal(#[from] Refusal),
    /// A file cannot be read or written.
    #[error("{}: {}", .path.display(), words(.source))]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

impl Goldens {
    /// Returns the goldens of a folder, which need not exist.
    #[must_use]
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    /// Returns the sorted names of the wanted goldens, or of all goldens if `wanted` is empty.
    ///
    /// # Errors
    /// Fails if the folder contains no golden, or no golden has one of the names.
    pub fn names(&self, wanted: &[String]) -> Result<Vec<String>, GoldenError> {
        // A folder without a recipe is listed, because it is a damaged golden.
        let is_golden = |name: &String| !name.starts_with('.') && self.root.join(name).is_dir();
        let entries = fs::read_dir(&self.root).into_iter().flatten().flatten();
        let mut names: Vec<String> =
            entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
        names.retain(is_golden);
        names.sort_unstable();
        if names.is_empty() {
            return Err(GoldenError::None(self.root.clone()));
        }
        if let Some(name) = wanted.iter().find(|name| !names.contains(name)) {
            let help = stickslip_scenario::suggestion(name, names.iter().map(String::as_str));
            return Err(GoldenError::Unknown { root: self.root.clone(), name: name.clone(), help });
        }
        names.retain(|name| wanted.is_empty() || wanted.contains(name));
        Ok(names)
    }

    /// Returns a new golden for a scenario file, without writing any file.
    ///
    /// # Errors
    /// Fails if a golden of this name exists, or a path cannot be resolved.
    pub fn plan(&self, file: &Path, set: Vec<String>, ignore: Vec<String>) -> Result<Golden, GoldenError> {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let folder = self.root.join(&name);
        if folder.join(RECIPE).exists() {
            return Err(GoldenError::Exists { root: self.root.clone(), name });
        }
        let at =
            |path: &Path| real(path).map_err(|source| GoldenError::File { path: path.to_owned(), source });
        let recipe = Recipe { format: FORMAT, file: relative(&at(&self.root)?, &at(file)?), set, ignore };
        Ok(Golden { name, folder, recipe })
    }

    /// Reads the recipe of a golden.
    ///
    /// # Errors
    /// Fails if the recipe cannot be read or has another format.
    pub fn golden(&self, name: &str) -> Result<Golden, GoldenError> {
        let folder = self.root.join(name);
        let path = folder.join(RECIPE);
        let damaged = |message: String| GoldenError::Recipe { path: path.clone(), message };
        let value = guard::json(&path).map_err(|error| damaged(words(&error)))?;
        match value.get("format").and_then(Value::as_u64) {
            Some(found) if found != u64::from(FORMAT) => Err(GoldenError::Format { path, found }),
            _ => {
                let recipe = serde_json::from_value(value).map_err(|error| damaged(error.to_string()))?;
                Ok(Golden { name: name.to_owned(), folder, recipe })
            }
        }
    }

    /// Adds a line to the log with date, version, names of the goldens and reason.
    ///
    /// # Errors
    /// Fails if the reason is too short, or the log cannot be written.
    pub fn log(&self, names: &[String], reason: &str) -> Result<(), GoldenError> {
        log::append(&self.root, names, &log::checked(reason)?)
    }

    /// Checks that a reason has at least eight letters.
    ///
    /// # Errors
    /// Fails if the reason is too short.
    pub fn check_reason(reason: &str) -> Result<(), GoldenError> {
        log::checked(reason).map(drop)
    }
}

impl Golden {
    /// Prepares a run of the current scenario file with the overrides of the recipe and without plots. Results are written to `out`.
    ///
    /// # Errors
    /// Fails if the file does not exist or is invalid.
    pub fn job(&self, out: &Path) -> Result<Job, GoldenError> {
        let root = self.folder.parent().unwrap_or(Path::new(""));
        let file = real(root)
            .map_or_else(|_| root.join(&self.recipe.file), |root| plain(&root.join(&self.recipe.file)));
        if !file.exists() {
            return Err(GoldenError::Gone(file));
        }
        Ok(Job::prepare(&file, &self.overrides(), out)?)
    }

    fn overrides(&self) -> Vec<(String, String)> {
        let pair = |text: &str| text.split_once('=').map(|(path, value)| (path.to_owned(), value.to_owned()));
        ["plots=[]"].into_iter().chain(self.recipe.set.iter().map(String::as_str)).filter_map(pair).collect()
    }

    /// Returns the changes of the scenario since the recording: each key with its old and new value.
    ///
    /// This program version reads the recorded scenario, so that new default values do not count as changes.
    #[must_use]
    pub fn changes(&self, job: &Job) -> Vec<String> {
        let recorded = self.folder.join(SCENARIO);
        let was = match Job::prepare(&recorded, &[], Path::new("")) {
            Ok(was) => was.resolved,
            Err(refusal) => return vec![format!("this version refuses the recorded scenario: {refusal}")],
        };
        let parse = |text: &str| serde_json::from_str::<Value>(text).unwrap_or_default();
        let mut changes = Vec::new();
        if was != job.resolved {
            differences("", Some(&parse(&was)), Some(&parse(&job.resolved)), &mut changes);
        }
        changes
    }

    /// Checks that the recorded scenario has the given SHA-256.
    ///
    /// # Errors
    /// Fails if the recorded scenario was changed or cannot be read.
    pub fn check_scenario(&self, sha256: &str) -> Result<(), GoldenError> {
        let path = self.folder.join(SCENARIO);
        let message = match guard::text(&path) {
            Ok(text) if hash(&text) == sha256 => return Ok(()),
            Ok(_) => "was changed after recording".to_owned(),
            Err(error) => words(&error),
        };
        Err(GoldenError::Recipe { path, message })
    }

    /// Writes an excerpt of results as the golden and replaces the previous one.
    ///
    /// # Errors
    /// Fails if the results cannot be read, or the golden cannot be written.
    pub fn write(&self, results: &Path) -> Result<(), GoldenError> {
        let file = |source| GoldenError::File { path: self.folder.clone(), source };
        let mut folder = Folder::make(&self.folder).map_err(file)?;
        let recipe = serde_json::to_string_pretty(&self.recipe).unwrap_or_default() + "\n";
        folder.write(RECIPE, recipe.as_bytes()).map_err(file)?;
        for (name, text) in excerpt::of(results)? {
            folder.write(name, text.as_bytes()).map_err(file)?;
        }
        folder.forget(vec![PICTURE.to_owned()]);
        folder.publish().map_err(file)
    }
}

/// Appends the differences of two JSON values to `found`, one line per key.
fn differences(key: &str, was: Option<&Value>, is: Option<&Value>, found: &mut Vec<String>) {
    match (was, is) {
        (Some(Value::Object(was)), Some(Value::Object(is))) => {
            let new = is.keys().filter(|name| !was.contains_key(*name));
            for name in was.keys().chain(new) {
                let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                differences(&path, was.get(name), is.get(name), found);
            }
        }
        _ if was == is => {}
        _ => {
            let shown = |value: Option<&Value>| match value {
                None => "nothing".to_owned(),
                Some(Value::Array(values)) => format!("a list of {}", values.len()),
                Some(Value::Object(_)) => "a section".to_owned(),
                // Whole numbers are shown without ".0".
                Some(value) => value.to_string().trim_end_matches(".0").to_owned(),
            };
            found.push(format!("{key} was {}, is {}", shown(was), shown(is)));
        }
    }
}

/// Returns an absolute path in which symbolic links are resolved, as far as the path exists.
///
/// The last component of a file path is not resolved. Links are resolved first, so that `..` refers to the parent of a link's target.
fn real(path: &Path) -> io::Result<PathBuf> {
    let path = std::path::absolute(path)?;
    let mut ancestors = path.ancestors().skip(usize::from(path.is_file()));
    let found = ancestors.find_map(|there| Some((there, there.canonicalize().ok()?)));
    let whole = found.and_then(|(there, real)| Some(real.join(path.strip_prefix(there).ok()?)));
    Ok(whole.unwrap_or(path))
}

/// Returns a path without `..` components.
fn plain(path: &Path) -> PathBuf {
    let mut parts: Vec<Component<'_>> = Vec::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.iter().collect()
}

/// Returns the path of a file relative to a folder. Both arguments are absolute paths.
fn relative(folder: &Path, file: &Path) -> PathBuf {
    let (folder, file) = (plain(folder), plain(file));
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    up.chain(file.components().skip(common)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn files_are_named_as_seen_from_the_goldens() {
        let seen = |folder: &str, file: &str| relative(Path::new(folder), Path::new(file));
        assert_eq!(seen("/a/golden", "/a/scenarios/p1.json"), Path::new("../scenarios/p1.json"));
        assert_eq!(seen("/a/golden", "/a/golden/x/../p1.json"), Path::new("p1.json"));
        assert_eq!(seen("/a", "/b/p1.json"), Path::new("../b/p1.json"));
    }

    #[test]
    fn what_has_changed_is_named_by_its_key() {
        let was = json!({ "bodies": { "slider": { "mass": 0.02 } }, "run": { "cycles": 3 }, "a": [1, 2] });
        let is = json!({ "bodies": { "slider": { "mass": 0.03 } }, "run": { "duration": 1.0 }, "a": [1, 2] });
        let mut found = Vec::new();
        differences("", Some(&was), Some(&is), &mut found);
        assert_eq!(
            found,
            [
                "bodies.slider.mass was 0.02, is 0.03",
                "run.cycles was 3, is nothing",
                "run.duration was nothing, is 1"
            ]
        );
    }
}
