//! Journal: file with the results of a study, written as they are computed. After an interruption, the same command reads the journal and
//! computes only the missing results.
//!
//! Each line has one result: its key and its value as JSON, separated by a tab. Numbers are restored to all bits. A result depends only on
//! its key and on the first line of the file.

use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use stickslip_run::{folder, program};

/// Results with their keys. A default journal has no file and stores nothing.
#[derive(Debug, Default)]
pub struct Journal(Option<Mutex<Lines>>);

#[derive(Debug)]
struct Lines {
    path: PathBuf,
    head: String,
    known: BTreeMap<String, String>,
    /// `None` before the first line is written.
    file: Option<File>,
    /// First write error.
    fault: Option<io::Error>,
}

/// Content of a journal file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Held {
    /// The file is missing or empty.
    Nothing,
    /// The file has results of the same study.
    Own,
    /// The file has results of another study or program version.
    Foreign,
}

// Optima, which are not in a browser, use more of it.
#[cfg_attr(target_family = "wasm", allow(dead_code))]
impl Journal {
    /// Opens the journal of a study. `of` contains everything on which the results depend, such as the scenario.
    ///
    /// Results of another study or program version are discarded; all results are discarded if `is_fresh`. The file is written when the
    /// first new result is known.
    ///
    /// # Errors
    /// Fails if the file cannot be read.
    pub fn open(path: PathBuf, of: &impl Serialize, is_fresh: bool) -> io::Result<Self> {
        Ok(Self::held(path, of, is_fresh)?.0)
    }

    /// Opens a journal like [`Self::open`]. Also returns whether the file contained results of this study or of another study.
    pub(crate) fn held(path: PathBuf, of: &impl Serialize, is_fresh: bool) -> io::Result<(Self, Held)> {
        let head = format!("{}\t{}\n", json(&format!("{} {}", program::NAME, program::VERSION)), json(of));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            // A file that is not valid UTF-8 does not belong to this study.
            Err(error) if error.kind() == ErrorKind::InvalidData => " ".to_owned(),
            Err(error) => return Err(error),
        };
        let held = match () {
            () if text.is_empty() => Held::Nothing,
            () if text.starts_with(&head) => Held::Own,
            () => Held::Foreign,
        };
        let mut known = BTreeMap::new();
        let mut file = None;
        if held == Held::Own && !is_fresh {
            // Drop an incomplete last line.
            let whole = text.rfind('\n').map_or(0, |end| end + 1);
            let line =
                |line: &str| line.split_once('\t').map(|(key, value)| (key.to_owned(), value.to_owned()));
            known.extend(text[head.len()..whole].lines().filter_map(line));
            let own = OpenOptions::new().append(true).open(&path)?;
            own.set_len(whole as u64)?;
            file = Some(own);
        }
        Ok((Self(Some(Mutex::new(Lines { path, head, known, file, fault: None }))), held))
    }

    /// Returns the result for a key from the journal, or computes it. The journal stores a computed result if `is_kept` accepts it.
    pub(crate) fn found<T: Serialize + DeserializeOwned>(
        &self,
        key: &impl Serialize,
        compute: impl FnOnce() -> T,
        is_kept: impl FnOnce(&T) -> bool,
    ) -> T {
        let Some(lines) = &self.0 else { return compute() };
        let key = json(key);
        // The lookup is outside the `if` condition, because a lock in the condition would be held during the body.
        let known = lock(lines).known.get(&key).and_then(|text| serde_json::from_str(text).ok());
        if let Some(known) = known {
            return known;
        }
        let found = compute();
        if is_kept(&found) {
            lock(lines).add(key, json(&found));
        }
        found
    }

    /// Returns all results, ordered by key.
    pub(crate) fn all<T: DeserializeOwned>(&self) -> Vec<T> {
        let Some(lines) = &self.0 else { return Vec::new() };
        lock(lines).known.values().filter_map(|text| serde_json::from_str(text).ok()).collect()
    }

    /// Returns the first write error. Later calls return `None`.
    pub(crate) fn fault(&self) -> Option<io::Error> {
        lock(self.0.as_ref()?).fault.take()
    }

    /// Rewrites the file with its lines in order, so that the journal of an interrupted study is reproducible.
    ///
    /// # Errors
    /// Fails if the file cannot be written.
    pub(crate) fn sort(&self) -> io::Result<()> {
        let Some(lines) = &self.0 else { return Ok(()) };
        let lines = lock(lines);
        let all = lines.known.iter().map(|(key, value)| format!("{key}\t{value}\n"));
        let text: String = std::iter::once(lines.head.clone()).chain(all).collect();
        folder::write(&lines.path, text.as_bytes())
    }

    /// Deletes the file after all results have been written elsewhere.
    pub fn remove(&self) {
        if let Some(lines) = &self.0 {
            let mut lines = lock(lines);
            drop(lines.file.take());
            drop(fs::remove_file(&lines.path));
        }
    }
}

impl Lines {
    fn add(&mut self, key: String, value: String) {
        if let Err(error) = self.write(&format!("{key}\t{value}\n")) {
            self.fault.get_or_insert(error);
        }
        self.known.insert(key, value);
    }

    fn write(&mut self, line: &str) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            None => {
                let mut file = File::create(&self.path)?;
                file.write_all(self.head.as_bytes())?;
                self.file.insert(file)
            }
        };
        file.write_all(line.as_bytes())
    }
}

fn lock(lines: &Mutex<Lines>) -> MutexGuard<'_, Lines> {
    lines.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Serialises maps as lists of pairs, because keys of JSON objects are strings.
pub(crate) mod pairs {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::collections::BTreeMap;

    pub(crate) fn serialize<K: Serialize, V: Serialize, S: Serializer>(
        all: &BTreeMap<K, V>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_seq(all)
    }

    pub(crate) fn deserialize<'d, K: Deserialize<'d> + Ord, V: Deserialize<'d>, D: Deserializer<'d>>(
        from: D,
    ) -> Result<BTreeMap<K, V>, D::Error> {
        Ok(Vec::deserialize(from)?.into_iter().collect())
    }
}

/// Serialises numbers, strings and lists as JSON, which cannot fail.
fn json(what: &impl Serialize) -> String {
    serde_json::to_string(what).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;

    #[test]
    fn results_come_back_to_the_bit_and_torn_lines_do_not() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a.journal");
        let open = |of: &str, is_fresh| Journal::held(path.clone(), &of, is_fresh).unwrap();
        let (journal, held) = open("a", false);
        assert!(held == Held::Nothing && !path.exists());
        let value = [0.1 + 0.2, -0.0, f64::MIN_POSITIVE / 3.0];
        journal.found(&("x", 1.5), || value, |_| true);
        journal.found(&"cut", || value, |_| false);
        drop(journal);
        OpenOptions::new().append(true).open(&path).unwrap().write_all(b"\"torn\"\t[1").unwrap();
        let (journal, held) = open("a", false);
        assert_eq!(held, Held::Own);
        let again = journal.found(&("x", 1.5), || [0.0; 3], |_| true);
        assert_eq!(again.map(f64::to_bits), value.map(f64::to_bits));
        assert_eq!(journal.found(&"torn", || 7.0, |_| true), 7.0);
        drop(journal);
        assert_eq!(open("a", false).0.found(&"torn", || 8.0, |_| true), 7.0);
        assert_eq!(open("a", true).0.found(&"torn", || 8.0, |_| true), 8.0);
        let (other, held) = open("b", false);
        assert!(held == Held::Foreign && other.all::<f64>().is_empty());
        // What is not a number is computed anew.
        assert!(other.found(&"none", || f64::NAN, |_| true).is_nan());
        assert_eq!(other.found(&"none", || 1.0, |_| true), 1.0);
        other.remove();
        assert!(!path.exists());
    }
}
