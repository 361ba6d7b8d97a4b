//! The journal of a search: every evaluation as a line of a file, so that an interrupted search continues where it was.

use crate::sweep::StudyError;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};
use stickslip_run::folder;

/// Its name in the folder of the results.
pub(crate) const NAME: &str = "evaluations.txt";

/// Results of one point, or why it has none.
pub(crate) type Found = Result<Vec<f64>, String>;

/// All evaluations so far, by the bits of their points.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    head: String,
    file: File,
    known: BTreeMap<Vec<u64>, Found>,
    /// Why it cannot be written, where it cannot.
    pub(crate) fault: Option<StudyError>,
}

impl Journal {
    /// Opens the journal of a study in a folder, which is made. A last line that is not whole is dropped.
    ///
    /// # Errors
    /// The journal of another study, and what cannot be read or written.
    pub(crate) fn open(out: &Path, hash: &str, is_fresh: bool) -> Result<Self, StudyError> {
        let path = out.join(NAME);
        let failed = |source| StudyError::Disk { path: path.clone(), source };
        let head = format!("study {hash}\n");
        fs::create_dir_all(out).map_err(failed)?;
        let mut text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            Err(error) => return Err(failed(error)),
        };
        text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
        if !text.is_empty() && !text.starts_with(&head) {
            let why = "its scenario, ranges or goal were others, or another version of the program wrote it"
                .to_owned();
            return Err(StudyError::Foreign { path, why });
        }
        if is_fresh || text.is_empty() {
            text.clone_from(&head);
        }
        folder::write(&path, text.as_bytes()).map_err(failed)?;
        let file = OpenOptions::new().append(true).open(&path).map_err(failed)?;
        let known = text.lines().skip(1).filter_map(read).collect();
        Ok(Self { path, head, file, known, fault: None })
    }

    pub(crate) fn get(&self, point: &[f64]) -> Option<Found> {
        self.known.get(&bits(point)).cloned()
    }

    /// Writes down an evaluation.
    pub(crate) fn add(&mut self, point: &[f64], found: Found) {
        let key = bits(point);
        let written = self.file.write_all(line(&key, &found).as_bytes()).and_then(|()| self.file.flush());
        if let Err(source) = written {
            self.fault.get_or_insert(StudyError::Disk { path: self.path.clone(), source });
        }
        self.known.insert(key, found);
    }

    /// Number of evaluations, and of those without a result.
    pub(crate) fn counts(&self) -> (usize, usize) {
        let has_none =
            |found: &&Found| !found.as_ref().is_ok_and(|values| values.iter().all(|x| x.is_finite()));
        (self.known.len(), self.known.values().filter(has_none).count())
    }

    /// Why the first point without a result has none.
    pub(crate) fn reason(&self) -> String {
        let mut reasons = self.known.values().filter_map(|found| found.as_ref().err());
        reasons.next().cloned().unwrap_or_else(|| "the result has no value".to_owned())
    }

    /// Writes the lines in order: those of a search that was interrupted are the same.
    ///
    /// # Errors
    /// What cannot be written.
    pub(crate) fn sort(&self) -> Result<(), StudyError> {
        let lines = self.known.iter().map(|(key, found)| line(key, found));
        let text: String = std::iter::once(self.head.clone()).chain(lines).collect();
        folder::write(&self.path, text.as_bytes())
            .map_err(|source| StudyError::Disk { path: self.path.clone(), source })
    }
}

fn bits(point: &[f64]) -> Vec<u64> {
    point.iter().map(|x| x.to_bits()).collect()
}

/// The bits of a point, a sign, and the bits of its results; or the reason why it has none.
fn line(key: &[u64], found: &Found) -> String {
    let mut line = String::new();
    let words = |line: &mut String, words: &mut dyn Iterator<Item = u64>| {
        // Writing to a string cannot fail.
        words.for_each(|word| {
            let _ = write!(line, "{word:016x} ");
        });
    };
    words(&mut line, &mut key.iter().copied());
    match found {
        Ok(values) => {
            line.push_str("= ");
            words(&mut line, &mut values.iter().map(|value| value.to_bits()));
        }
        Err(why) => line.extend(["! ", &why.replace(['\n', '\r'], " "), " "]),
    }
    line.pop();
    line.push('\n');
    line
}

fn read(line: &str) -> Option<(Vec<u64>, Found)> {
    let words = |text: &str| -> Option<Vec<u64>> {
        text.split_whitespace().map(|word| u64::from_str_radix(word, 16).ok()).collect()
    };
    if let Some((key, why)) = line.split_once(" ! ") {
        return Some((words(key)?, Err(why.to_owned())));
    }
    let (key, values) = line.split_once(" = ")?;
    Some((words(key)?, Ok(words(values)?.into_iter().map(f64::from_bits).collect())))
}
