//! `cycles.csv`: every cycle of the contacts that come back along u.

use crate::sheet::{Sheet, Written};
use std::io;
use stickslip_measure::contact_cycles::JudgedCycle;
use stickslip_quantity::columns::CYCLES;
use tempfile::NamedTempFile;

/// Place of `closed` among the values, after both times.
const CLOSED: usize = 2;
/// The table as its run goes on: cycles in the order in which they end. Forces and work are those of all identical contacts
/// together; what a cycle does not have is left empty.
pub(crate) struct CyclesTable {
    sheet: Sheet,
    is_empty: bool,
}

impl CyclesTable {
    pub(crate) fn new(file: NamedTempFile) -> Self {
        Self { sheet: Sheet::new(file, CYCLES.names.iter().copied()), is_empty: true }
    }

    /// Writes a cycle of a contact by name, with its number, from 1.
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

    /// Whether its file takes no more.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// The written file; none where no contact has a cycle.
    pub(crate) fn finish(self) -> io::Result<Option<Written>> {
        if self.is_empty { Ok(None) } else { self.sheet.finish().map(Some) }
    }
}

/// The numbers of a cycle, in the order of the columns; in the place of `closed` none.
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
