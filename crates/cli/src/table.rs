//! Tables as CSV: `trace.csv` and `events.csv`.

use std::io::{self, BufWriter};
use stickslip_drive::{Channel, state_name};
use tempfile::NamedTempFile;

/// The columns of a table: places among a model's channels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Columns {
    chosen: Vec<(usize, Channel)>,
}

impl Columns {
    /// All channels.
    pub(crate) fn all(channels: &[Channel]) -> Self {
        Self { chosen: channels.iter().cloned().enumerate().collect() }
    }

    /// The channels at these places, in this order, after the time.
    pub(crate) fn chosen(channels: &[Channel], places: &[usize]) -> Self {
        let rest = places.iter().copied().filter(|place| *place > 0);
        let chosen = std::iter::once(0).chain(rest);
        Self { chosen: chosen.filter_map(|place| Some((place, channels.get(place)?.clone()))).collect() }
    }

    /// Number of columns.
    pub(crate) fn len(&self) -> usize {
        self.chosen.len()
    }
}

/// A table being written.
pub(crate) struct Table {
    writer: csv::Writer<BufWriter<NamedTempFile>>,
    columns: Columns,
    digits: zmij::Buffer,
}

impl Table {
    /// A table with `extra` columns of text after the time.
    pub(crate) fn new(file: NamedTempFile, columns: Columns, extra: &[&str]) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(BufWriter::with_capacity(1 << 16, file));
        let mut names = columns.chosen.iter().map(|(_, channel)| channel.name.as_str());
        let time = names.next();
        writer.write_record(time.into_iter().chain(extra.iter().copied()).chain(names))?;
        Ok(Self { writer, columns, digits: zmij::Buffer::new() })
    }

    /// Writes a row: the chosen of all channels' `values`, with the texts after the time.
    pub(crate) fn write(&mut self, extra: &[&str], values: &[f64]) -> io::Result<()> {
        for (i, (place, channel)) in self.columns.chosen.iter().enumerate() {
            let value = values.get(*place).copied().unwrap_or(f64::NAN);
            if channel.is_state {
                self.writer.write_field(state_name(value))?;
            } else {
                // The shortest digits that read back to the same bits, several times faster than the standard library,
                // whose printing took most of the time of a run with rows.
                self.writer.write_field(self.digits.format(value))?;
            }
            if i == 0 {
                extra.iter().try_for_each(|text| self.writer.write_field(text))?;
            }
        }
        self.writer.write_record(None::<&[u8]>)?;
        Ok(())
    }

    /// The written file.
    pub(crate) fn finish(self) -> io::Result<NamedTempFile> {
        let buffered = self.writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
        buffered.into_inner().map_err(io::IntoInnerError::into_error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels() -> Vec<Channel> {
        let names = ["time_s", "slider.x_m", "ball.state"];
        names.map(|name| Channel { name: name.to_owned(), is_state: name.ends_with("state") }).to_vec()
    }

    fn written(columns: Columns, extra: &[&str], values: &[f64]) -> String {
        let head: Vec<&str> = extra.iter().map(|_| "kind").collect();
        let mut table = Table::new(NamedTempFile::new().unwrap(), columns, &head).unwrap();
        table.write(extra, values).unwrap();
        std::fs::read_to_string(table.finish().unwrap().path()).unwrap()
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
