//! Folder of the parts of a study.

use super::part::{self, Label, Open};
use super::{Study, StudyError};
use parquet::errors::ParquetError;
use std::fs;
use std::io;
use std::path::Path;

/// State of a folder of parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Status {
    /// Number of parts in the folder.
    pub parts: u64,
    /// Number of parts of the study.
    pub of: u64,
    /// Numbers of the parts that are missing or damaged.
    pub missing: Vec<u64>,
    /// Numbers of damaged parts, which will be computed again.
    pub damaged: Vec<u64>,
}

impl Study {
    /// Returns which parts are in a folder, without writing to it. A part with fewer cases, written before the study was enlarged, counts
    /// as missing.
    ///
    /// # Errors
    /// Fails if the folder has parts of another study or with more cases than the study has, or cannot be read.
    pub fn status(&self, folder: &Path) -> Result<Status, StudyError> {
        let mut found = vec![false; usize::try_from(self.parts()).unwrap_or(usize::MAX)];
        let mut damaged = Vec::new();
        for number in self.numbers(folder)? {
            let path = folder.join(part::name(number));
            let label =
                part::label(&path).map_err(|source| StudyError::Disk { path: path.clone(), source })?;
            let Some(label) = label else {
                damaged.extend((number < self.parts()).then_some(number));
                continue;
            };
            let foreign = |why: String| Err(StudyError::Foreign { path: path.clone(), why });
            if label.study != self.hash {
                return foreign(self.difference(&label));
            }
            let cases = self.part(number);
            if label.rows > cases.end - cases.start {
                let (rows, own) = (label.rows, cases.end - cases.start);
                return foreign(format!(
                    "a part has {rows} cases, but this study has {own}: \"cases\" was larger"
                ));
            }
            if let Some(is_there) = found.get_mut(number as usize) {
                *is_there = label.first == cases.start && label.rows == cases.end - cases.start;
            }
        }
        let missing: Vec<u64> = (0..self.parts()).filter(|part| !found[*part as usize]).collect();
        Ok(Status { parts: self.parts() - missing.len() as u64, of: self.parts(), missing, damaged })
    }

    fn difference(&self, label: &Label) -> String {
        let own = format!("{} {}", stickslip_run::program::NAME, stickslip_run::program::VERSION);
        match label.program.as_str() {
            "" => "another program wrote it".to_owned(),
            program if program != own => format!("{program} computed it, this is {own}"),
            _ => "scenario, variations, results or chunk differ".to_owned(),
        }
    }

    /// Returns the part numbers in the names of all part files.
    fn numbers(&self, folder: &Path) -> Result<Vec<u64>, StudyError> {
        let failed = |source| StudyError::Disk { path: folder.to_owned(), source };
        let entries = match fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(failed(error)),
        };
        let mut numbers = Vec::new();
        for entry in entries {
            numbers.extend(entry.map_err(failed)?.file_name().to_str().and_then(part::number));
        }
        numbers.sort_unstable();
        Ok(numbers)
    }

    /// Deletes all parts of this study from a folder.
    ///
    /// # Errors
    /// Fails without deleting anything if the folder has parts of another study. Fails if a part cannot be deleted.
    pub fn remove(&self, folder: &Path) -> Result<(), StudyError> {
        self.status(folder)?;
        for number in self.numbers(folder)? {
            let path = folder.join(part::name(number));
            fs::remove_file(&path).map_err(|source| StudyError::Disk { path, source })?;
        }
        Ok(())
    }

    /// Checks that all parts are in a folder.
    ///
    /// # Errors
    /// Fails if parts are missing, or if [`Self::status`] fails.
    pub(crate) fn check_complete(&self, folder: &Path) -> Result<(), StudyError> {
        let Status { missing, of, .. } = self.status(folder)?;
        match missing.len() as u64 {
            0 => Ok(()),
            missing => Err(StudyError::Incomplete { missing, of }),
        }
    }

    /// Calls `act` for every part in order. The folder must contain all parts.
    pub(crate) fn each_part(
        &self,
        folder: &Path,
        mut act: impl FnMut(u64, &Open) -> Result<(), ParquetError>,
    ) -> Result<(), StudyError> {
        for number in 0..self.parts() {
            let path = folder.join(part::name(number));
            let done = Open::new(self, &path).and_then(|open| act(number, &open));
            done.map_err(|error| StudyError::Damaged { path, why: error.to_string() })?;
        }
        Ok(())
    }
}
