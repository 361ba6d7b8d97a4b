//! Table `pulses.csv`: the step of each pulse of a burst or a sequence.

use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_measure::pulses::Pulse;
use stickslip_quantity::columns::PULSES;
use tempfile::NamedTempFile;

/// Writer of `pulses.csv`.
pub(crate) struct PulsesTable {
    sheet: Sheet,
    is_empty: bool,
}

impl PulsesTable {
    pub(crate) fn new(file: NamedTempFile) -> Self {
        Self { sheet: Sheet::new(file, PULSES.names.iter().copied()), is_empty: true }
    }

    pub(crate) fn write(&mut self, pulse: &Pulse) {
        self.is_empty = false;
        self.sheet.word(&pulse.number.to_string());
        pulse.span.into_iter().for_each(|value| self.sheet.number(value));
        self.sheet.word(&pulse.direction.to_string());
        self.sheet.number(pulse.step);
        self.sheet.word(if pulse.after_turn { "true" } else { "false" });
        self.sheet.end_line();
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// Returns the written file. Returns `None` if no pulse was complete.
    pub(crate) fn finish(self) -> io::Result<Option<Written>> {
        if self.is_empty { Ok(None) } else { self.sheet.finish().map(Some) }
    }
}
