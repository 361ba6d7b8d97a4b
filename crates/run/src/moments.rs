//! Reads `fields.csv` and `friction.csv`: quantities versus radius for each time and contact.

use crate::frame::FrameError;
use crate::limits::MOST_VALUES;
use crate::rows::Rows;
use crate::seal::SealedTable;
use crate::springs::spring_state;
use stickslip_contact::SpringState;
use stickslip_quantity::columns::{FIELDS, FRICTION};

/// Quantities of a contact at one time as functions of the distance r from its axis.
#[derive(Debug, Clone, PartialEq)]
pub struct OverRadius {
    /// Name of the contact.
    pub contact: String,
    /// Time, s.
    pub time: f64,
    /// Numeric columns of the table, beginning with the radius r.
    pub columns: Vec<Vec<f64>>,
    /// Slip states at these radii, if the table has a column of states.
    pub states: Vec<SpringState>,
}

/// Index of the column `state` in `fields.csv`.
const STATE: usize = 8;

/// Reads `fields.csv`: r, p, τ, u, slip, w.
///
/// # Errors
/// The file cannot be read, has other columns, or contains an invalid cell.
pub fn fields(table: &SealedTable) -> Result<Vec<OverRadius>, FrameError> {
    read(table, FIELDS.names, (STATE, true))
}

/// Reads `friction.csv`: r, friction work per area, slip path.
///
/// # Errors
/// The same errors as for [`fields`].
pub fn friction(table: &SealedTable) -> Result<Vec<OverRadius>, FrameError> {
    read(table, FRICTION.names, (FRICTION.names.len(), false))
}

fn read(
    table: &SealedTable,
    head: &[&str],
    (end, has_state): (usize, bool),
) -> Result<Vec<OverRadius>, FrameError> {
    let mut rows = Rows::open(table)?;
    rows.check_head(head)?;
    let (mut moments, mut values) = (Vec::<OverRadius>::new(), 0_u64);
    while rows.advance()? {
        let time = rows.number(0, head[0])?;
        let contact = rows.text(1);
        if moments.last().is_none_or(|last| last.time != time || last.contact != contact) {
            let columns = vec![Vec::new(); end - 2];
            moments.push(OverRadius { contact: contact.to_owned(), time, columns, states: Vec::new() });
        }
        values += end as u64;
        if values > MOST_VALUES {
            return Err(rows.fault(format!("expected at most {MOST_VALUES} values")));
        }
        let Some(moment) = moments.last_mut() else { continue };
        for (k, column) in moment.columns.iter_mut().enumerate() {
            column.push(rows.number(k + 2, head[k + 2])?);
        }
        if has_state {
            moment.states.push(spring_state(&rows, end)?);
        }
    }
    Ok(moments)
}
