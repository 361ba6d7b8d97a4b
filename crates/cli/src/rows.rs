//! A table of results read row by row, for those too long to be held whole.

use crate::frame::FrameError;
use std::fs::File;
use std::path::{Path, PathBuf};

/// An open table, at one of its rows.
pub(crate) struct Rows {
    path: PathBuf,
    reader: csv::Reader<File>,
    record: csv::StringRecord,
}

impl Rows {
    /// Opens a CSV with one line of names, before its first row.
    pub(crate) fn open(path: &Path) -> Result<Self, FrameError> {
        let csv = |source| FrameError::Csv { path: path.to_owned(), source };
        let mut reader = csv::Reader::from_path(path).map_err(csv)?;
        reader.headers().map_err(csv)?;
        Ok(Self { path: path.to_owned(), reader, record: csv::StringRecord::new() })
    }

    /// The file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the columns.
    pub(crate) fn head(&mut self) -> Result<&csv::StringRecord, FrameError> {
        self.reader.headers().map_err(|source| FrameError::Csv { path: self.path.clone(), source })
    }

    /// Goes on to the next row; `false` after the last.
    pub(crate) fn advance(&mut self) -> Result<bool, FrameError> {
        let csv = |source| FrameError::Csv { path: self.path.clone(), source };
        self.reader.read_record(&mut self.record).map_err(csv)
    }

    /// Line of the row, from 1.
    pub(crate) fn line(&self) -> u64 {
        self.record.position().map_or(0, csv::Position::line)
    }

    /// A cell; empty where there is no such column.
    pub(crate) fn text(&self, column: usize) -> &str {
        self.record.get(column).unwrap_or_default()
    }

    /// A cell as a number; `name` is that of its column.
    pub(crate) fn number(&self, column: usize, name: &str) -> Result<f64, FrameError> {
        let text = self.text(column);
        text.parse().map_err(|_| FrameError::Number {
            path: self.path.clone(),
            line: self.line(),
            column: name.to_owned(),
            text: text.to_owned(),
        })
    }
}
