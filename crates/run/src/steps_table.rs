//! Table `steps.csv`: all steps of a drive, one per period.

use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_measure::Stride;
use stickslip_quantity::columns::STEPS;
use tempfile::NamedTempFile;

/// Writer of `steps.csv`.
pub(crate) struct StepsTable {
    sheet: Sheet,
    count: usize,
}

impl StepsTable {
    pub(crate) fn new(file: NamedTempFile) -> Self {
        Self { sheet: Sheet::new(file, STEPS.names.iter().copied()), count: 0 }
    }

    /// Writes the step of a drive period from `start` to `end`, s.
    pub(crate) fn write(&mut self, [start, end]: [f64; 2], stride: Stride) {
        self.count += 1;
        self.sheet.word(&self.count.to_string());
        let Stride { start: x, least, most, .. } = stride;
        [start, end, stride.length(), x, least, most].into_iter().for_each(|value| self.sheet.number(value));
        self.sheet.end_line();
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// Returns the written file. Returns `None` if there was no whole period.
    pub(crate) fn finish(self) -> io::Result<Option<Written>> {
        if self.count == 0 { Ok(None) } else { self.sheet.finish().map(Some) }
    }
}
