//! A table of results read row by row, for those too long to be held whole.

use crate::frame::FrameError;
use std::fs::File;
use std::path::{Path, PathBuf};

/// An open table, at one of its rows.
pub(crate) struct Rows {
    path: PathBuf,
    reader: csv::Reader<File>,
    record: csv::StringRecord,
    /// Line of the row, from 1.
    line: u64,
}

impl Rows {
    /// Opens a CSV with one line of names, before its first row.
    pub(crate) fn open(path: &Path) -> Result<Self, FrameError> {
        let csv = |source| FrameError::Csv { path: path.to_owned(), source };
        let mut reader = csv::Reader::from_path(path).map_err(csv)?;
        reader.headers().map_err(csv)?;
        Ok(Self { path: path.to_owned(), reader, record: csv::StringRecord::new(), line: 1 })
    }

    /// Goes on to the next row; `false` after the last.
    pub(crate) fn advance(&mut self) -> Result<bool, FrameError> {
        let csv = |source| FrameError::Csv { path: self.path.clone(), source };
        let is_there = self.reader.read_record(&mut self.record).map_err(csv)?;
        if let (true, Some(position)) = (is_there, self.record.position()) {
            self.line = position.line();
        }
        Ok(is_there)
    }

    /// Fails where the columns are not these.
    pub(crate) fn check_head(&mut self, names: &[&str]) -> Result<(), FrameError> {
        let head =
            self.reader.headers().map_err(|source| FrameError::Csv { path: self.path.clone(), source })?;
        let differs = (0..names.len().max(head.len())).find(|&i| head.get(i) != names.get(i).copied());
        let Some(place) = differs else { return Ok(()) };
        let quoted = |name: Option<&str>| match name {
            Some(name) => format!("\"{}\"", name.escape_debug()),
            None => "nothing".to_owned(),
        };
        let (expected, got) = (quoted(names.get(place).copied()), quoted(head.get(place)));
        Err(FrameError::Head { path: self.path.clone(), place: place + 1, expected, got })
    }

    /// What is wrong with the row; after the last, with that one.
    pub(crate) fn fault(&self, message: String) -> FrameError {
        FrameError::Content { path: self.path.clone(), line: self.line, message }
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
            line: self.line,
            column: name.to_owned(),
            text: text.to_owned(),
        })
    }
}
