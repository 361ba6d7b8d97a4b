//! Golden results: what scenarios came to when somebody last looked, kept to be compared with.
//!
//! A golden is a folder of results with some of the rows only: an excerpt that [`compare`](crate) reads like any other. Beside it
//! stand the scenario as it was run and a [`Recipe`], by which the file, as it is now, is run again.

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

/// The file by which a golden is told from other folders.
const RECIPE: &str = "recipe.json";
/// What this version writes and reads.
const FORMAT: u32 = 1;
/// The picture of what differs most.
pub const PICTURE: &str = "difference.png";

/// How a golden is made again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Form of the golden's files.
    pub format: u32,
    /// File of the scenario, as seen from the folder of all goldens.
    pub file: PathBuf,
    /// Overrides, as `run --set` takes them.
    #[serde(default)]
    pub set: Vec<String>,
    /// Channels, figures, bodies or contacts that are not compared.
    #[serde(default)]
    pub ignore: Vec<String>,
}

/// A folder of goldens, each in a folder of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Goldens {
    root: PathBuf,
}

/// One of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Golden {
    /// Name of the scenario.
    pub name: String,
    /// Where it lies.
    pub folder: PathBuf,
    /// How it is made again.
    pub recipe: Recipe,
}

/// Why there is no golden, or none that can be compared with.
#[derive(Debug, Error)]
pub enum GoldenError {
    /// A folder without any.
    #[error("{}: there is no golden\n   help: stickslip golden record FILE… --out {}", .0.display(), .0.display())]
    None(PathBuf),
    /// A name that none has.
    #[error("{}: there is no golden \"{name}\"{}", .root.display(), .help.as_ref().map(|help| format!("; {help}")).unwrap_or_default())]
    Unknown {
        /// The folder of all.
        root: PathBuf,
        /// What was asked for.
        name: String,
        /// A name that is like it.
        help: Option<String>,
    },
    /// One that is there already.
    #[error("{}: there is a golden already\n   help: stickslip golden accept {} {name} --reason \"why it changes\"", .root.join(.name).display(), .root.display())]
    Exists {
        /// The folder of all.
        root: PathBuf,
        /// Its name.
        name: String,
    },
    /// The scenario of a golden is gone.
    #[error("gone: {} is not there", .0.display())]
    Gone(PathBuf),
    /// Files that another version wrote.
    #[error("damaged: {} is of format {found}, this version reads {FORMAT}: record it anew", .path.display())]
    Format {
        /// Which file.
        path: PathBuf,
        /// What it says.
        found: u64,
    },
    /// A file that is no recipe.
    #[error("damaged: {}: {message}", .path.display())]
    Recipe {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
    /// Tables or figures that are not those that were recorded.
    #[error("damaged: {0}")]
    Damaged(ResultsError),
    /// A reason that says nothing.
    #[error("--reason: say why the results change, in eight letters or more")]
    NoReason,
    /// A scenario that is refused.
    #[error(transparent)]
    Refusal(#[from] Refusal),
    /// A file that cannot be read or written.
    #[error("{}: {}", .path.display(), words(.source))]
    File {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl Goldens {
    /// Those in a folder, which may not be there yet.
    #[must_use]
    pub fn new(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    /// Names of all, or of some, in order.
    ///
    /// # Errors
    /// There are none, or none of one of these names.
    pub fn names(&self, wanted: &[String]) -> Result<Vec<String>, GoldenError> {
        // One that has lost its recipe is a golden as well: a damaged one.
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

    /// A golden to be.
    ///
    /// # Errors
    /// There is one of its name, or the file cannot be found.
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

    /// Reads what is known of a golden.
    ///
    /// # Errors
    /// A recipe that cannot be read.
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

    /// Adds a line to the log: when, by which version, which goldens and why.
    ///
    /// # Errors
    /// A reason that says nothing; what the system says.
    pub fn log(&self, names: &[String], reason: &str) -> Result<(), GoldenError> {
        log::append(&self.root, names, &log::checked(reason)?)
    }

    /// Whether a reason says something.
    ///
    /// # Errors
    /// It does not.
    pub fn check_reason(reason: &str) -> Result<(), GoldenError> {
        log::checked(reason).map(drop)
    }
}

impl Golden {
    /// The run of the file as it is now, with the overrides of the recipe and without pictures; results go to `out`.
    ///
    /// # Errors
    /// The file is gone, or refused.
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

    /// What has changed in the scenario since the golden was recorded: keys with what they were and are. The scenario that was recorded
    /// is read by this version as well: defaults that have come since are no change.
    #[must_use]
    pub fn changes(&self, job: &Job) -> Vec<String> {
        let recorded = self.folder.join(SCENARIO);
        let was = match Job::prepare(&recorded, &[], Path::new("")) {
            Ok(was) => was.resolved,
            Err(refusal) => return vec![format!("the recorded one is refused today: {refusal}")],
        };
        let parse = |text: &str| serde_json::from_str::<Value>(text).unwrap_or_default();
        let mut changes = Vec::new();
        if was != job.resolved {
            differences("", Some(&parse(&was)), Some(&parse(&job.resolved)), &mut changes);
        }
        changes
    }

    /// Whether the recorded scenario is the one that was recorded, of this hash.
    ///
    /// # Errors
    /// It is another one, or cannot be read.
    pub fn check_scenario(&self, sha256: &str) -> Result<(), GoldenError> {
        let path = self.folder.join(SCENARIO);
        let message = match guard::text(&path) {
            Ok(text) if hash(&text) == sha256 => return Ok(()),
            Ok(_) => "is not the scenario that was recorded".to_owned(),
            Err(error) => words(&error),
        };
        Err(GoldenError::Recipe { path, message })
    }

    /// Keeps an excerpt of results as the golden, in place of what was there.
    ///
    /// # Errors
    /// Results that cannot be read; what the system says.
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

/// Where two values of a scenario differ.
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
                // A whole number without its fraction.
                Some(value) => value.to_string().trim_end_matches(".0").to_owned(),
            };
            found.push(format!("{key} was {}, is {}", shown(was), shown(is)));
        }
    }
}

/// An absolute path in which links are followed as far as there is anything: steps upwards lead out of what they point to. The last part
/// of a file stays as it is named.
fn real(path: &Path) -> io::Result<PathBuf> {
    let path = std::path::absolute(path)?;
    let mut ancestors = path.ancestors().skip(usize::from(path.is_file()));
    let found = ancestors.find_map(|there| Some((there, there.canonicalize().ok()?)));
    let whole = found.and_then(|(there, real)| Some(real.join(path.strip_prefix(there).ok()?)));
    Ok(whole.unwrap_or(path))
}

/// A path without steps upwards in its middle.
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

/// A file as seen from a folder; both absolute.
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
