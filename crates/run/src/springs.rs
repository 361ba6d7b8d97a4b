//! Reads `springs.csv`: slip states of the springs of each contact over time.

use crate::frame::FrameError;
use crate::rows::Rows;
use crate::seal::SealedTable;
use std::collections::HashMap;
use stickslip_contact::SpringState;
use stickslip_quantity::columns::SPRINGS;

/// Slip states of the springs of one contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Springs {
    /// Name of the contact.
    pub contact: String,
    /// Times, s.
    pub time: Vec<f64>,
    /// Positions of the springs, m. The positions are the same at all times.
    pub x: Vec<f64>,
    /// Slip states of all springs, time by time.
    pub states: Vec<SpringState>,
}

/// Reads the table, one line per spring and time.
///
/// # Errors
/// The file cannot be read, has other columns, or contains an inconsistent line.
pub fn read(table: &SealedTable) -> Result<Vec<Springs>, FrameError> {
    let mut rows = Rows::open(table)?;
    rows.check_head(SPRINGS.names)?;
    let mut contacts: Vec<Springs> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    while rows.advance()? {
        let (t, x) = (rows.number(0, SPRINGS.names[0])?, rows.number(2, SPRINGS.names[2])?);
        let contact = rows.text(1);
        let place = places.get(contact).copied().unwrap_or_else(|| {
            places.insert(contact.to_owned(), contacts.len());
            contacts.push(Springs::of(contact));
            contacts.len() - 1
        });
        let state = spring_state(&rows, 4)?;
        let springs = &mut contacts[place];
        if springs.time.last() != Some(&t) {
            springs.check_whole(&rows)?;
            springs.time.push(t);
        }
        springs.push(x, state, &rows)?;
    }
    contacts.iter().try_for_each(|springs| springs.check_whole(&rows))?;
    Ok(contacts)
}

impl Springs {
    fn of(contact: &str) -> Self {
        Self { contact: contact.to_owned(), time: Vec::new(), x: Vec::new(), states: Vec::new() }
    }

    /// Adds the next spring of the current time. The springs at the first time determine the positions.
    fn push(&mut self, x: f64, state: SpringState, rows: &Rows) -> Result<(), FrameError> {
        if self.time.len() == 1 {
            self.x.push(x);
        }
        let before = self.states.len() - (self.time.len() - 1) * self.x.len();
        match self.x.get(before) {
            Some(place) if *place == x => {
                self.states.push(state);
                Ok(())
            }
            Some(_) => {
                let text = rows.text(2).escape_debug();
                Err(rows.fault(format!("x_m: expected the positions of the first time, got {text}")))
            }
            None => Err(rows.fault(format!("x_m: expected {} springs at each time, got more", self.x.len()))),
        }
    }

    /// Checks that the table has as many springs at the last time as at the first time.
    fn check_whole(&self, rows: &Rows) -> Result<(), FrameError> {
        if self.states.len() == self.time.len() * self.x.len() {
            return Ok(());
        }
        let message =
            format!("expected {} springs of \"{}\" at each time", self.x.len(), self.contact.escape_debug());
        Err(rows.fault(message))
    }
}

/// Returns the slip state for the word in a column of the current row.
pub(crate) fn spring_state(rows: &Rows, column: usize) -> Result<SpringState, FrameError> {
    Ok(match rows.text(column) {
        "open" => SpringState::Open,
        "stick" => SpringState::Stick,
        "slip+" => SpringState::SlipForward,
        "slip-" => SpringState::SlipBackward,
        text => {
            let text = text.escape_debug();
            return Err(rows.fault(format!("state: expected open, stick, slip+ or slip-, got \"{text}\"")));
        }
    })
}
