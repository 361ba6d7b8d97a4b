//! Limits on the size of results, checked before a run.

use crate::theory::LINE_WIDTH;
use std::sync::Arc;
use stickslip_contact::{Curve, Interface, Memory, Springs};
use stickslip_drive::{Model, State};
use stickslip_quantity::columns::{FIELDS, MEMORY, SPRINGS};
use stickslip_scenario::{Scenario, ScenarioError};

/// Maximum number of values of a table. A table of this size takes up to 2 GB in memory and about 5 GB on disk.
pub(crate) const MOST_VALUES: u64 = 250_000_000;

/// Checks the number of rows.
///
/// # Errors
/// The rows exceed the memory limit.
pub(crate) fn check_rows(scenario: &Scenario, width: usize) -> Result<(), ScenarioError> {
    let Some(every) = scenario.plan.every else { return Ok(()) };
    let [from, to] = scenario.written.window;
    let time = to.min(scenario.plan.duration) - from;
    let rows = time / every;
    let most = MOST_VALUES as f64 / width as f64;
    if rows <= most {
        return Ok(());
    }
    let message =
        format!("the run would have {rows:.3e} rows of {width} channels, expected at most {most:.3e}");
    let help = format!(
        "write a row every {:.1e} s or less often, or only rows of a part of the run (output.window)",
        time / most
    );
    Err(scenario.locate("output.every", message, Some(help)))
}

/// Returns the springs of each contact that a run writes: those of a spring row, or a grid that samples the slip memory curve.
///
/// A contact that is never pressed has no springs.
///
/// # Errors
/// The table of springs would exceed the maximum size of a table.
pub(crate) fn grids(
    scenario: &Scenario,
    model: &Model,
    start: &State,
) -> Result<Vec<Option<Arc<Springs>>>, ScenarioError> {
    let Some(asked) = &scenario.springs else { return Ok(Vec::new()) };
    let contacts = model.contacts().zip(start.memories()).enumerate();
    let grid = |(c, ((_, law), memory)): (usize, ((&str, &Interface), &Memory))| match memory {
        Memory::Row(row) => Some(Arc::clone(&row.springs)),
        Memory::Curve(_) => {
            // Only a contact without width has no springs. Such a contact is never pressed.
            let width = model.contact_width(c).unwrap_or(0.0);
            Springs::new(law.profile(), asked.count, width).ok().map(Arc::new)
        }
    };
    let grids: Vec<_> = contacts.map(grid).collect();
    let springs: usize = grids.iter().flatten().map(|grid| grid.count()).sum();
    let moments = asked.moments.count(scenario.plan.duration);
    let (lines, most) = (springs as f64 * moments, MOST_VALUES as f64 / SPRINGS.names.len() as f64);
    if lines <= most {
        return Ok(grids);
    }
    let message = format!(
        "{springs} springs at {moments:.3e} times give {lines:.3e} lines, expected at most {most:.3e}"
    );
    let help = "give output.springs a larger interval \"every\", or a smaller \"count\"";
    Err(scenario.locate(&asked.asked_by, message, Some(help.to_owned())))
}

/// Checks the size of the table of fields.
///
/// # Errors
/// The table of fields would exceed the maximum size of a table.
pub(crate) fn check_fields(scenario: &Scenario) -> Result<(), ScenarioError> {
    let Some(asked) = &scenario.fields else { return Ok(()) };
    let moments = asked.moments.count(scenario.plan.duration);
    let lines = moments * (asked.radii * scenario.scene.contacts.len()) as f64;
    let most = MOST_VALUES as f64 / FIELDS.names.len() as f64;
    if lines <= most {
        return Ok(());
    }
    let message = format!(
        "{} radii of {} contacts at {moments:.3e} times give {lines:.3e} lines, expected at most {most:.3e}",
        asked.radii,
        scenario.scene.contacts.len()
    );
    let help = "give output.fields a larger interval \"every\", a list \"at\", or fewer \"radii\"";
    Err(scenario.locate(&asked.asked_by, message, Some(help.to_owned())))
}

/// Checks the size of the table of slip memory curves.
///
/// # Errors
/// The table of slip memory curves may exceed the maximum size of a table.
pub(crate) fn check_curves(scenario: &Scenario) -> Result<(), ScenarioError> {
    let Some(asked) = &scenario.memory else { return Ok(()) };
    let curves = asked.moments.count(scenario.plan.duration) * scenario.scene.contacts.len() as f64;
    let lines = curves * Curve::DEFAULT_CAPACITY as f64;
    let most = MOST_VALUES as f64 / MEMORY.names.len() as f64;
    if lines <= most {
        return Ok(());
    }
    let message = format!(
        "{curves:.3e} curves of up to {} corners may give {lines:.3e} lines, expected at most {most:.3e}",
        Curve::DEFAULT_CAPACITY
    );
    let help = "give output.memory a larger interval \"every\", or a list \"at\"";
    Err(scenario.locate(&asked.asked_by, message, Some(help.to_owned())))
}

/// Checks the memory for the springs of a load history: they are written at `moments` times and stored for `frames` animation frames.
///
/// # Errors
/// The table of springs would exceed the maximum size of a table.
pub(crate) fn check_history(springs: usize, moments: usize, frames: usize) -> Result<(), String> {
    let (looks, most) = (moments + frames, MOST_VALUES / LINE_WIDTH as u64);
    let lines = springs as u64 * looks as u64;
    if lines <= most {
        return Ok(());
    }
    let room = most / springs as u64;
    let help = match (room.saturating_sub(2), frames) {
        (_, 1..) => "leave out --animate, or give the list fewer springs".to_owned(),
        (0, _) => format!("give the list at most {} springs", most / 2),
        (corners, _) => format!("give at most {corners} corners, or the list fewer springs"),
    };
    Err(format!(
        "{springs} springs at {looks} times give {lines} lines, expected at most {most}\n   help: {help}"
    ))
}

#[cfg(test)]
mod tests {
    use super::check_history;

    #[test]
    fn springs_of_a_history_have_a_bound_that_their_refusal_names() {
        assert_eq!(check_history(0, 1001, 60), Ok(()));
        assert_eq!(check_history(121, 1001, 60), Ok(()));
        // 250 million numbers in lines of 13.
        assert_eq!(check_history(1_000_000, 19, 0), Ok(()));
        let refused = check_history(1_000_000, 20, 0).unwrap_err();
        assert!(refused.contains("20000000 lines, expected at most 19230769"), "{refused}");
        assert!(refused.contains("at most 17 corners"), "{refused}");
        assert!(check_history(1_000_000, 2, 60).unwrap_err().contains("leave out --animate"));
        assert!(check_history(20_000_000, 2, 0).unwrap_err().contains("at most 9615384 springs"));
    }
}
