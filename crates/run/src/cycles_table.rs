//! Table `cycles.csv`: all load cycles of the contacts at whose end the displacement u returns to its initial value.

use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_measure::contact_cycles::JudgedCycle;
use stickslip_quantity::columns::CYCLES;
use tempfile::NamedTempFile;

/// Index of the column `closed` among the values.
const CLOSED: usize = 2;
/// Writer of `cycles.csv`. Cycles are written in the order in which they end.
///
/// Forces and energies are sums over identical contacts. Missing values are empty.
pub(crate) struct CyclesTable {
    sheet: Sheet,
    is_empty: bool,
}

impl CyclesTable {
    pub(crate) fn new(file: NamedTempFile) -> Self {
        Self { sheet: Sheet::new(file, CYCLES.names.iter().copied()), is_empty: true }
    }

    /// Writes a cycle of the contact `name`. Cycles of a contact are numbered from 1.
    pub(crate) fn write(&mut self, (name, number): (&str, usize), cycle: &JudgedCycle) {
        self.is_empty = false;
        self.sheet.text(name);
        self.sheet.word(&number.to_string());
        for (place, value) in values(cycle).into_iter().enumerate() {
            match value {
                _ if place == CLOSED => self.sheet.word(if cycle.figures.is_closed { "yes" } else { "no" }),
                Some(value) => self.sheet.number(value),
                None => self.sheet.word(""),
            }
        }
        self.sheet.word(cycle.regime.unwrap_or_default());
        self.sheet.end_line();
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// Returns the written file. Returns `None` if there was no cycle.
    pub(crate) fn finish(self) -> io::Result<Option<Written>> {
        if self.is_empty { Ok(None) } else { self.sheet.finish().map(Some) }
    }
}

/// Returns the values of a cycle in the order of the columns, with `None` for `closed`.
fn values(JudgedCycle { figures, .. }: &JudgedCycle) -> [Option<f64>; 17] {
    let cycle = figures.cycle;
    [
        Some(figures.time[0]),
        Some(figures.time[1]),
        None,
        Some(cycle.displacement_amplitude),
        Some(cycle.force_amplitude),
        figures.of_loop(cycle.half_opening),
        figures.dissipated(),
        figures.damping,
        Some(figures.normal),
        figures.ratio(cycle.energy_ratio()),
        figures.ratio(cycle.system_free_ratio()),
        figures.of_loop(cycle.slip_ratio()),
        figures.ratio(cycle.friction_coefficient(figures.normal)),
        cycle.stiffness_after_maximum,
        cycle.stiffness_after_minimum,
        figures.of_loop(figures.secants[0]),
        figures.of_loop(figures.secants[1]),
    ]
}
