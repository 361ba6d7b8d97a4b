//! `cycles.csv`: every cycle of the contacts that come back along u.

use crate::summary::{JudgedCycle, Summary};
use std::io;

/// Names of the columns.
const HEAD: [&str; 19] = [
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

/// The table of a run; none where no contact has a cycle. Forces and work are those of all identical contacts together; what a
/// cycle does not have is left empty.
///
/// # Errors
/// None but what the writer may find wrong.
pub fn cycles_table(summary: &Summary) -> io::Result<Option<Vec<u8>>> {
    let contacts = summary.contacts.0.iter();
    let all = contacts.flat_map(|(name, contact)| contact.cycles.iter().enumerate().map(move |c| (name, c)));
    let mut all = all.peekable();
    if all.peek().is_none() {
        return Ok(None);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(HEAD)?;
    let mut digits = zmij::Buffer::new();
    for (name, (number, cycle)) in all {
        writer.write_field(name)?;
        writer.write_field((number + 1).to_string())?;
        for value in values(cycle).into_iter().enumerate() {
            match value {
                (2, _) => writer.write_field(if cycle.figures.is_closed { "yes" } else { "no" })?,
                (_, Some(value)) => writer.write_field(digits.format(value))?,
                (_, None) => writer.write_field("")?,
            }
        }
        writer.write_field(cycle.regime.unwrap_or_default())?;
        writer.write_record(None::<&[u8]>)?;
    }
    writer.into_inner().map(Some).map_err(csv::IntoInnerError::into_error)
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
