//! Writer of the CSV tables `trace.csv` and `events.csv`.

use crate::columns::Columns;
use crate::sheet::{Sheet, Target, Written};
use crate::states::state_digit;
use std::io;
use stickslip_drive::state_name;
use tempfile::NamedTempFile;

/// A table that is being written.
pub(crate) struct Table<F = NamedTempFile> {
    sheet: Sheet<F>,
    columns: Columns,
    /// Whether contact states are written as numbers instead of words.
    states: bool,
}

impl<F: Target> Table<F> {
    /// Creates a table with the text columns `extra` after the time. `states` selects numbers instead of words for contact states.
    pub(crate) fn new(file: F, columns: Columns, extra: &[&str], states: bool) -> Self {
        let mut names = columns.names();
        let time = names.next();
        let sheet = Sheet::new(file, time.into_iter().chain(extra.iter().copied()).chain(names));
        Self { sheet, columns, states }
    }

    /// Writes a row from the `values` of all channels, with the texts after the time.
    pub(crate) fn write(&mut self, extra: &[&str], values: &[f64]) {
        for (i, (place, channel)) in self.columns.places().iter().enumerate() {
            let value = values.get(*place).copied().unwrap_or(f64::NAN);
            if channel.is_state && self.states {
                self.sheet.word(state_digit(value));
            } else if channel.is_state {
                self.sheet.word(state_name(value));
            } else {
                self.sheet.number(value);
            }
            if i == 0 {
                extra.iter().for_each(|text| self.sheet.text(text));
            }
        }
        self.sheet.end_line();
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        self.sheet.has_failed()
    }

    /// Returns the written file.
    pub(crate) fn finish(self) -> io::Result<Written<F>> {
        self.sheet.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_drive::Channel;

    fn channels() -> Vec<Channel> {
        let names = ["time_s", "slider.x_m", "ball.state"];
        names.map(|name| Channel { name: name.to_owned(), is_state: name.ends_with("state") }).to_vec()
    }

    fn written(columns: Columns, extra: &[&str], values: &[f64]) -> String {
        let head: Vec<&str> = extra.iter().map(|_| "kind").collect();
        let mut table = Table::new(NamedTempFile::new().unwrap(), columns, &head, false);
        table.write(extra, values);
        std::fs::read_to_string(table.finish().unwrap().file.path()).unwrap()
    }

    #[test]
    fn numbers_read_back_to_the_same_bits_and_states_are_words() {
        let x = f64::from_bits(0x3e45_798e_e230_8c3a);
        let text = written(Columns::all(&channels()), &[], &[0.1, x, 2.0]);
        assert_eq!(text, "time_s,slider.x_m,ball.state\n0.1,1e-8,partial\n");
        assert_eq!("1e-8".parse::<f64>().unwrap().to_bits(), x.to_bits());
    }

    #[test]
    fn the_time_comes_first_whatever_is_chosen() {
        let text = written(Columns::chosen(&channels(), &[2, 0]), &["touch"], &[0.5, 1.0, 0.0]);
        assert_eq!(text, "time_s,kind,ball.state\n0.5,touch,open\n");
    }
}
