//! Writer of CSV files that counts the rows and computes the SHA-256 (the seal).

use crate::digest::Digest;
use crate::seal::Seal;
use std::io::{self, Seek, SeekFrom, Write};
use tempfile::NamedTempFile;

/// Size of a block that is written and hashed at once, in bytes.
const BLOCK: usize = 1 << 16;

/// Maximum size of the last block, in bytes, unless its last line is unusually long.
pub(crate) const LAST_BLOCK: usize = BLOCK + BLOCK / 8;

/// Writer of a CSV file. Cells are appended to a block in memory, and full blocks are written to the file and hashed.
///
/// After a write error, the file ends with its last complete block. Later data are lost, and [`Self::finish`] returns the error.
pub(crate) struct Sheet<F = NamedTempFile> {
    file: F,
    /// Complete lines and the current line. Every cell ends with a comma, and the last comma of a line becomes the line end.
    block: Vec<u8>,
    digits: zmij::Buffer,
    /// Digest of the written data.
    digest: Digest,
    /// Numbers of rows in the file and in the block.
    rows: [u64; 2],
    failure: Option<io::Error>,
    /// Whether a block has been written to the file.
    has_block: bool,
    /// If the first block could not be written: the block and its number of rows.
    first: Option<(Vec<u8>, u64)>,
}

/// A file that can be truncated.
pub(crate) trait Target: Write {
    /// Truncates the file to a length in bytes.
    fn cut(&mut self, length: u64) -> io::Result<()>;
}

/// A complete CSV file.
pub(crate) struct Written<F = NamedTempFile> {
    pub(crate) file: F,
    pub(crate) seal: Seal,
    /// Write error that ended the table early.
    pub(crate) failure: Option<io::Error>,
}

impl<F: Target> Sheet<F> {
    /// Creates a sheet with a line of column names.
    pub(crate) fn new<'a>(file: F, head: impl IntoIterator<Item = &'a str>) -> Self {
        let block = Vec::with_capacity(LAST_BLOCK);
        let digest = Digest::default();
        let mut sheet = Self {
            file,
            block,
            digits: zmij::Buffer::new(),
            digest,
            rows: [0; 2],
            failure: None,
            has_block: false,
            first: None,
        };
        head.into_iter().for_each(|name| sheet.text(name));
        if let Some(last) = sheet.block.last_mut() {
            *last = b'\n';
        }
        sheet
    }

    /// Writes a word that needs no quotes.
    #[inline(always)]
    pub(crate) fn word(&mut self, word: &str) {
        self.block.extend_from_slice(word.as_bytes());
        self.block.push(b',');
    }

    /// Writes a text, with quotes if necessary (RFC 4180).
    #[inline(always)]
    pub(crate) fn text(&mut self, text: &str) {
        if text.bytes().any(|byte| matches!(byte, b',' | b'"' | b'\n' | b'\r')) {
            self.word(&format!("\"{}\"", text.replace('"', "\"\"")));
        } else {
            self.word(text);
        }
    }

    /// Writes a number with the fewest digits that give the same value when read.
    #[inline(always)]
    pub(crate) fn number(&mut self, value: f64) {
        // This formatter is several times faster than that of the standard library.
        self.block.extend_from_slice(self.digits.format(value).as_bytes());
        self.block.push(b',');
    }

    /// Ends a line.
    #[inline(always)]
    pub(crate) fn end_line(&mut self) {
        if let Some(last) = self.block.last_mut() {
            *last = b'\n';
        }
        self.rows[1] += 1;
        if self.block.len() >= BLOCK {
            self.flush(false);
        }
    }

    /// Returns whether a write has failed.
    pub(crate) fn has_failed(&self) -> bool {
        self.failure.is_some()
    }

    /// Writes the current block to the file, completely or not at all.
    fn flush(&mut self, is_last: bool) {
        let rows = std::mem::take(&mut self.rows[1]);
        if self.failure.is_none() {
            match self.file.write_all(&self.block) {
                Ok(()) => {
                    self.block = self.digest.take(std::mem::take(&mut self.block), is_last);
                    self.rows[0] += rows;
                    self.has_block = true;
                }
                Err(failure) => {
                    self.failure = Some(failure);
                    if !self.has_block {
                        self.first = Some((std::mem::take(&mut self.block), rows));
                    }
                }
            }
        }
        // Data after a write error are lost.
        self.block.clear();
    }

    /// Writes the last block and returns the file.
    ///
    /// # Errors
    /// The first block cannot be written, or the file cannot be truncated to its complete blocks.
    pub(crate) fn finish(mut self) -> io::Result<Written<F>> {
        self.flush(true);
        let is_cut = self.failure.is_some();
        if let Some((block, rows)) = self.first.take() {
            // The reserved disk space has been released, so the first block is written again.
            self.file.cut(0)?;
            self.file.write_all(&block)?;
            self.digest.take(block, true);
            self.rows[0] = rows;
        }
        let (length, sha256) = self.digest.finish()?;
        if is_cut {
            self.file.cut(length)?;
        }
        Ok(Written { file: self.file, seal: Seal { rows: self.rows[0], sha256 }, failure: self.failure })
    }
}

impl Target for NamedTempFile {
    fn cut(&mut self, length: u64) -> io::Result<()> {
        self.as_file().set_len(length)?;
        self.seek(SeekFrom::Start(length)).map(|_| ())
    }
}

/// A table of which only the seal is needed.
impl Target for io::Sink {
    fn cut(&mut self, _: u64) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seal::hash;
    use proptest::prelude::*;

    /// A file on a disk with limited space.
    struct Small {
        bytes: Vec<u8>,
        room: usize,
    }

    impl Write for Small {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let left = self.room - self.bytes.len();
            if left == 0 {
                return Err(io::ErrorKind::StorageFull.into());
            }
            let taken = left.min(bytes.len());
            self.bytes.extend(&bytes[..taken]);
            Ok(taken)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Target for Small {
        fn cut(&mut self, length: u64) -> io::Result<()> {
            self.bytes.truncate(length as usize);
            Ok(())
        }
    }

    fn small(room: usize) -> Small {
        Small { bytes: Vec::new(), room }
    }

    #[test]
    fn a_disk_that_is_full_at_any_byte_keeps_whole_lines_and_their_seal() {
        let rows = 20_000_u32;
        let fill = |room: usize| {
            let mut sheet = Sheet::new(small(room), ["time_s", "ball.state"]);
            for row in 0..rows {
                sheet.number(f64::from(row));
                sheet.word("stick");
                sheet.end_line();
            }
            sheet.finish()
        };
        let whole = fill(usize::MAX).unwrap();
        assert_eq!((whole.seal.rows, whole.failure.is_none()), (u64::from(rows), true));
        let length = whole.file.bytes.len();
        let rooms = (0..length).step_by(977).chain([1, BLOCK - 1, BLOCK, BLOCK + 100, length - 1]);
        for room in rooms {
            let Ok(Written { file, seal, failure }) = fill(room) else {
                assert!(room < 2 * BLOCK, "{room}");
                continue;
            };
            assert_eq!(failure.unwrap().kind(), io::ErrorKind::StorageFull);
            let text = String::from_utf8(file.bytes).unwrap();
            assert!(text.ends_with('\n') && whole.file.bytes.starts_with(text.as_bytes()), "{room}");
            assert!(text.len() + 2 * BLOCK > room, "{room}: {} bytes are left", text.len());
            assert_eq!(seal, Seal { rows: text.lines().count() as u64 - 1, sha256: hash(&text) });
        }
        assert_eq!(fill(length).unwrap().seal, whole.seal);
    }

    /// The first block of a table is written to the reserved space if the disk was full before.
    #[test]
    fn a_first_block_goes_where_room_was_left_for_the_end() {
        let mut sheet = Sheet::new(small(100), ["time_s", "ball.state"]);
        for row in 0..20_000_u32 {
            sheet.number(f64::from(row));
            sheet.word("stick");
            sheet.end_line();
        }
        assert!(sheet.has_failed());
        sheet.file.room = LAST_BLOCK;
        let Written { file, seal, failure } = sheet.finish().unwrap();
        assert_eq!(failure.unwrap().kind(), io::ErrorKind::StorageFull);
        let text = String::from_utf8(file.bytes).unwrap();
        assert!(text.len() >= BLOCK && text.starts_with("time_s,ball.state\n0.0,stick\n"));
        assert_eq!(seal, Seal { rows: text.lines().count() as u64 - 1, sha256: hash(&text) });
    }

    proptest! {
        #[test]
        fn texts_and_numbers_are_written_as_by_the_library(
            rows in prop::collection::vec((any::<f64>(), "[a-c,\"\r\n µ+-]{0,6}"), 1..20)
        ) {
            let mut sheet = Sheet::new(small(usize::MAX), ["time_s", "a,b"]);
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(["time_s", "a,b"]).unwrap();
            for (number, text) in &rows {
                sheet.number(*number);
                sheet.text(text);
                sheet.end_line();
                writer.write_record([zmij::Buffer::new().format(*number), text]).unwrap();
            }
            let written = sheet.finish().unwrap();
            let expected = writer.into_inner().unwrap();
            prop_assert_eq!(&written.file.bytes, &expected);
            prop_assert_eq!(written.seal.rows, rows.len() as u64);
        }
    }
}
