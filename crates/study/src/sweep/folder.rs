//! The folder of the parts: it is the result.

use super::part::{self, Label, Open};
use super::{Study, StudyError};
use parquet::errors::ParquetError;
use std::fs;
use std::io;
use std::path::Path;

/// Which parts are there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Status {
    /// Number of parts that are there.
    pub parts: u64,
    /// Number of parts of the study.
    pub of: u64,
    /// Those that are missing, or not whole.
    pub missing: Vec<u64>,
    /// Of these, those that are there and not whole: they are computed anew.
    pub damaged: Vec<u64>,
}

impl Study {
    /// Which parts are in a folder; nothing is written. A part of the same study with fewer cases counts as missing.
    ///
    /// # Errors
    /// Parts of another study, more cases than the study has, or a folder that cannot be read.
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
                    "it has {rows} cases, this study has {own} there: \"cases\" was larger"
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
            "" => "it was not written by this program".to_owned(),
            program if program != own => format!("it was computed by {program}, this is {own}"),
            _ => "scenario, variations, results or chunk were others".to_owned(),
        }
    }

    /// The numbers of the files that have names of parts.
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

    /// Removes all parts of this study from a folder.
    ///
    /// # Errors
    /// Parts of another study; then none is removed. A part that cannot be removed.
    pub fn remove(&self, folder: &Path) -> Result<(), StudyError> {
        self.status(folder)?;
        for number in self.numbers(folder)? {
            let path = folder.join(part::name(number));
            fs::remove_file(&path).map_err(|source| StudyError::Disk { path, source })?;
        }
        Ok(())
    }

    /// That all parts are in a folder.
    ///
    /// # Errors
    /// Parts that are missing; those of [`Self::status`].
    pub(crate) fn check_complete(&self, folder: &Path) -> Result<(), StudyError> {
        let Status { missing, of, .. } = self.status(folder)?;
        match missing.len() as u64 {
            0 => Ok(()),
            missing => Err(StudyError::Incomplete { missing, of }),
        }
    }

    /// Does something with every part, in order, of a folder that has them all.
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
