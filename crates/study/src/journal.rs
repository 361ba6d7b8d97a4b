//! What a study has computed, in a file as it comes: the same command continues after a kill, or computes nothing anew.
//!
//! A line for each result: what was asked for and what came of it, both as JSON with a tab between. Numbers are read back to the bit.
//! A result depends on what was asked for and on what the first line says alone; so one that stands in the file counts as computed.

use serde::{Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use stickslip_run::{folder, program};

/// Results by what was asked for; without a file it remembers nothing.
#[derive(Debug, Default)]
pub struct Journal(Option<Mutex<Lines>>);

#[derive(Debug)]
struct Lines {
    path: PathBuf,
    head: String,
    known: BTreeMap<String, String>,
    /// None before the first line that is added.
    file: Option<File>,
    /// Why it cannot be written, where it cannot.
    fault: Option<io::Error>,
}

/// What the file of a journal is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Held {
    /// New, or empty.
    Nothing,
    /// Results of the same study.
    Own,
    /// Results of another study, or of another version of the program.
    Foreign,
}

impl Journal {
    /// Opens the journal of a study: the scenario and all that its results depend on stand in `of`. One of another study, or of another version of the
    /// program, begins anew, as does any where `is_fresh`. Nothing is written before the first result.
    ///
    /// # Errors
    /// What cannot be read.
    pub fn open(path: PathBuf, of: &impl Serialize, is_fresh: bool) -> io::Result<Self> {
        Ok(Self::held(path, of, is_fresh)?.0)
    }

    /// The same, and what the file was.
    pub(crate) fn held(path: PathBuf, of: &impl Serialize, is_fresh: bool) -> io::Result<(Self, Held)> {
        let head = format!("{}\t{}\n", json(&format!("{} {}", program::NAME, program::VERSION)), json(of));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
            // Nobody's journal: bytes that are no text.
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
            // A last line that is not whole is dropped.
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

    /// The result of what is asked for by a key: known, or computed and written down where it is to be kept.
    pub(crate) fn found<T: Serialize + DeserializeOwned>(
        &self,
        key: &impl Serialize,
        compute: impl FnOnce() -> T,
        is_kept: impl FnOnce(&T) -> bool,
    ) -> T {
        let Some(lines) = &self.0 else { return compute() };
        let key = json(key);
        // Not in the condition, whose lock would last as long as its body.
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

    /// All results, in the order of their keys.
    pub(crate) fn all<T: DeserializeOwned>(&self) -> Vec<T> {
        let Some(lines) = &self.0 else { return Vec::new() };
        lock(lines).known.values().filter_map(|text| serde_json::from_str(text).ok()).collect()
    }

    /// Why it could not be written, once.
    pub(crate) fn fault(&self) -> Option<io::Error> {
        lock(self.0.as_ref()?).fault.take()
    }

    /// Writes the lines in order: those of an interrupted study are the same then.
    ///
    /// # Errors
    /// What cannot be written.
    pub(crate) fn sort(&self) -> io::Result<()> {
        let Some(lines) = &self.0 else { return Ok(()) };
        let lines = lock(lines);
        let all = lines.known.iter().map(|(key, value)| format!("{key}\t{value}\n"));
        let text: String = std::iter::once(lines.head.clone()).chain(all).collect();
        folder::write(&lines.path, text.as_bytes())
    }

    /// Removes the file: all results are where they belong.
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

/// Maps as lists: keys of JSON are words.
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

/// Numbers, words and lists: there is nothing that JSON could refuse.
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
