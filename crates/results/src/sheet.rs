//! CSV files being written, field by field.

use std::io::{self, BufWriter};
use tempfile::NamedTempFile;

/// A CSV file being written. Its words and numbers are what a run with rows spends most of its time on: a call for each
/// would cost 2 % of it.
pub(crate) struct Sheet {
    writer: csv::Writer<BufWriter<NamedTempFile>>,
    digits: zmij::Buffer,
}

impl Sheet {
    /// A sheet with a line of column names.
    pub(crate) fn new<'a>(file: NamedTempFile, head: impl IntoIterator<Item = &'a str>) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(BufWriter::with_capacity(1 << 16, file));
        writer.write_record(head)?;
        Ok(Self { writer, digits: zmij::Buffer::new() })
    }

    /// Writes a word.
    #[inline(always)]
    pub(crate) fn text(&mut self, text: &str) -> io::Result<()> {
        Ok(self.writer.write_field(text)?)
    }

    /// Writes a number.
    #[inline(always)]
    pub(crate) fn number(&mut self, value: f64) -> io::Result<()> {
        // The shortest digits that read back to the same bits, several times faster than the standard library, whose
        // printing took most of the time of a run with rows.
        Ok(self.writer.write_field(self.digits.format(value))?)
    }

    /// Ends a line.
    #[inline(always)]
    pub(crate) fn end_line(&mut self) -> io::Result<()> {
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    /// The written file.
    pub(crate) fn finish(self) -> io::Result<NamedTempFile> {
        let buffered = self.writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
        buffered.into_inner().map_err(io::IntoInnerError::into_error)
    }
}
