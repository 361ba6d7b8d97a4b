//! `steps.csv`: every step of a drive.

use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_measure::Stride;
use stickslip_quantity::columns::STEPS;
use tempfile::NamedTempFile;

/// The table as its run goes on.
pub(crate) struct StepsTable {
    sheet: Sheet,
    count: usize,
}

impl StepsTable {
    pub(crate) fn new(file: NamedTempFile) -> Self {
        Self { sheet: Sheet::new(file, STEPS.names.iter().copied()), count: 0 }
    }

    /// Writes the next step, that of a period between two times, s.
    pub(crate) fn write(&mut self, [start, end]: [f64; 2], stride: Stride) {
        self.count += 1;
        self.sheet.word(&self.count.to_string());
        let Stride { start: x, least, most, .. } = stride;
        [start, end, stride.length(), x, least, most].into_iter().for_each(|value| self.sheet.number(value));
        self.sheet.end_line();
    }

    /// Whether its file takes no more.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// The written file; none of a drive without a whole period.
    pub(crate) fn finish(self) -> io::Result<Option<Written>> {
        if self.count == 0 { Ok(None) } else { self.sheet.finish().map(Some) }
    }
}
