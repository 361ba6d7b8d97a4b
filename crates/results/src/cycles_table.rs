//! `cycles.csv`: every cycle of the contacts that come back along u.

use crate::files::CYCLES;
use crate::folder::Folder;
use crate::record::Draft;
use crate::sheet::{Sheet, Written};
use crate::summary::{JudgedCycle, Summary};
use std::io;

/// Place of `closed` among the values, after both times.
const CLOSED: usize = 2;
/// Names of the columns.
pub(crate) const HEAD: [&str; 19] = [
    "contact",
    "cycle",
    "start_s",
    "end_s",
    "closed",
    "displacement_amplitude_m",
    "force_amplitude_N",
    "half_opening_m",
    "dissipated_J",
    "mean_normal_force_N",
    "energy_ratio",
    "system_free_ratio",
    "slip_ratio",
    "energy_coefficient_of_friction",
    "stiffness_after_maximum_N_m",
    "stiffness_after_minimum_N_m",
    "secant_after_maximum_N_m",
    "secant_after_minimum_N_m",
    "regime",
];

/// Writes the table of a run; none where no contact has a cycle. Forces and work are those of all identical contacts together;
/// what a cycle does not have is left empty.
///
/// # Errors
/// What the system says of writing it.
pub fn cycles_table(summary: &Summary, folder: &Folder) -> io::Result<Option<Draft>> {
    let contacts = summary.contacts.0.iter();
    let all = contacts.flat_map(|(name, contact)| contact.cycles.iter().enumerate().map(move |c| (name, c)));
    let mut all = all.peekable();
    if all.peek().is_none() {
        return Ok(None);
    }
    let mut sheet = Sheet::new(folder.draft(CYCLES)?, HEAD);
    for (name, (number, cycle)) in all {
        sheet.text(name);
        sheet.word(&(number + 1).to_string());
        for (place, value) in values(cycle).into_iter().enumerate() {
            match value {
                _ if place == CLOSED => sheet.word(if cycle.figures.is_closed { "yes" } else { "no" }),
                Some(value) => sheet.number(value),
                None => sheet.word(""),
            }
        }
        sheet.word(cycle.regime.unwrap_or_default());
        sheet.end_line();
    }
    let Written { file, seal, failure } = sheet.finish()?;
    failure.map_or(Ok(Some(Draft { name: CYCLES, file, seal })), Err)
}

/// The numbers of a cycle, in the order of the columns; in the place of `closed` none.
fn values(JudgedCycle { figures, .. }: &JudgedCycle) -> [Option<f64>; 16] {
    let cycle = figures.cycle;
    let if_closed = |value: Option<f64>| value.filter(|_| figures.is_closed);
    [
        Some(figures.time[0]),
        Some(figures.time[1]),
        None,
        Some(cycle.displacement_amplitude),
        Some(cycle.force_amplitude),
        if_closed(cycle.half_opening),
        Some(cycle.dissipated),
        Some(figures.normal),
        if_closed(cycle.energy_ratio()),
        if_closed(cycle.system_free_ratio()),
        if_closed(cycle.slip_ratio()),
        if_closed(cycle.friction_coefficient(figures.normal)),
        cycle.stiffness_after_maximum,
        cycle.stiffness_after_minimum,
        if_closed(figures.secants[0]),
        if_closed(figures.secants[1]),
    ]
}
