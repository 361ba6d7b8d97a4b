//! Row-by-row reader of a CSV table of results.
//!
//! A table has one line per row, and cells contain no line ends. The sizes of lines, cells and columns are limited, because the file may
//! come from an unknown source. At the end of a table, its row count and SHA-256 are checked.

use crate::frame::FrameError;
use crate::guard;
use crate::seal::{Digester, Seal, SealedTable};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;

/// Maximum size of a cell, in bytes. The longest cells are column names: a name of 64 characters and a quantity.
const MOST_CELL: usize = 1024;
/// Maximum number of columns. Ten thousand bodies and as many contacts have 140 000.
const MOST_COLUMNS: usize = 200_000;
/// Maximum size of a line, in bytes.
const MOST_LINE: u64 = 16 << 20;

/// An open table and its current row.
pub struct Rows {
    path: PathBuf,
    reader: BufReader<File>,
    digest: Option<(Digester, Seal)>,
    head: Vec<String>,
    /// Bytes and text of the current line. Bytes and text differ if cells are quoted.
    bytes: Vec<u8>,
    text: String,
    /// End of each cell in the text; a comma follows it.
    ends: Vec<usize>,
    /// Line number of the current row, from 1, and number of rows read so far.
    line: u64,
    rows: u64,
}

impl Rows {
    /// Opens a CSV file with one heading line.
    ///
    /// # Errors
    /// The file cannot be read, or the heading line is invalid.
    pub fn open(table: &SealedTable) -> Result<Self, FrameError> {
        let path = table.path.clone();
        let file = guard::open(&path).map_err(|source| FrameError::Read { path: path.clone(), source })?;
        let mut rows = Self {
            path,
            reader: BufReader::with_capacity(1 << 16, file),
            digest: table.seal.clone().map(|seal| (Digester::default(), seal)),
            head: Vec::new(),
            bytes: Vec::new(),
            text: String::new(),
            ends: Vec::new(),
            line: 0,
            rows: 0,
        };
        if rows.next_line()? {
            rows.head = (0..rows.ends.len()).map(|column| rows.text(column).to_owned()).collect();
        }
        Ok(rows)
    }

    /// Returns the column names.
    pub fn head(&self) -> &[String] {
        &self.head
    }

    /// Reads the next row. Returns `false` after the last row.
    ///
    /// # Errors
    /// The file cannot be read, a line is invalid, or the complete table does not match its seal.
    pub fn advance(&mut self) -> Result<bool, FrameError> {
        if !self.next_line()? {
            return self.check_seal().map(|()| false);
        }
        self.rows += 1;
        let (expected, got) = (self.head.len(), self.ends.len());
        if got != expected {
            let cells = if expected == 1 { "1 cell" } else { &format!("{expected} cells") };
            return Err(self.fault(format!("expected {cells} like the first line, got {got}")));
        }
        Ok(true)
    }

    /// Reads the next line. Returns `false` after the last line.
    fn next_line(&mut self) -> Result<bool, FrameError> {
        self.bytes.clear();
        let mut bounded = (&mut self.reader).take(MOST_LINE);
        let read = bounded.read_until(b'\n', &mut self.bytes);
        read.map_err(|source| FrameError::Read { path: self.path.clone(), source })?;
        if self.bytes.is_empty() {
            return Ok(false);
        }
        if let Some((digest, _)) = &mut self.digest {
            digest.update(&self.bytes);
        }
        self.line += 1;
        if self.bytes.pop_if(|last| *last == b'\n').is_some() {
            self.bytes.pop_if(|last| *last == b'\r');
        } else if self.bytes.len() as u64 == MOST_LINE {
            return Err(self.fault(format!("the line has more than {MOST_LINE} bytes")));
        }
        self.cut().map_err(|message| self.fault(message)).map(|()| true)
    }

    /// Splits the line into cells.
    fn cut(&mut self) -> Result<(), String> {
        self.text.clear();
        self.ends.clear();
        let line = std::str::from_utf8(&self.bytes).map_err(|_| "is not UTF-8 text".to_owned())?;
        if line.bytes().any(|byte| byte.is_ascii_control()) {
            return Err("has a control character".to_owned());
        }
        // The number of cells is checked before memory is allocated.
        let cells = 1 + line.bytes().filter(|byte| *byte == b',').count();
        if cells > MOST_COLUMNS && !line.contains('"') {
            return Err(format!("expected at most {MOST_COLUMNS} cells, got {cells}"));
        }
        if line.contains('"') {
            unquote(line, &mut self.text, &mut self.ends)?;
        } else {
            self.text.push_str(line);
            self.ends.extend(line.bytes().enumerate().filter(|(_, byte)| *byte == b',').map(|(i, _)| i));
            self.ends.push(line.len());
        }
        let lengths = self.ends.iter().scan(0, |start, end| {
            let length = end - *start;
            *start = end + 1;
            Some(length)
        });
        if self.ends.len() > MOST_COLUMNS {
            return Err(format!("expected at most {MOST_COLUMNS} cells, got {}", self.ends.len()));
        }
        match lengths.max() {
            Some(longest) if longest > MOST_CELL => {
                Err(format!("a cell has {longest} bytes, expected at most {MOST_CELL}"))
            }
            _ => Ok(()),
        }
    }

    /// Compares the number of rows and the SHA-256 of the table with its seal.
    fn check_seal(&self) -> Result<(), FrameError> {
        let Some((digest, seal)) = &self.digest else { return Ok(()) };
        if self.rows != seal.rows {
            let message = format!("expected {} rows by summary.json, got {}", seal.rows, self.rows);
            return Err(self.fault(message));
        }
        if digest.finish().1 != seal.sha256 {
            return Err(FrameError::Changed(self.path.clone()));
        }
        Ok(())
    }

    /// Checks the column names.
    ///
    /// # Errors
    /// The columns differ from `names`.
    pub fn check_head(&mut self, names: &[&str]) -> Result<(), FrameError> {
        let head = |place: usize| self.head.get(place).map(String::as_str);
        let differs = (0..names.len().max(self.head.len())).find(|&i| head(i) != names.get(i).copied());
        let Some(place) = differs else { return Ok(()) };
        let quoted = |name: Option<&str>| match name {
            Some(name) => format!("\"{}\"", name.escape_debug()),
            None => "nothing".to_owned(),
        };
        let (expected, got) = (quoted(names.get(place).copied()), quoted(head(place)));
        Err(FrameError::Head { path: self.path.clone(), place: place + 1, expected, got })
    }

    /// Returns an error with the line number of the current row, or of the last row after the end of the table.
    pub fn fault(&self, message: String) -> FrameError {
        FrameError::Content { path: self.path.clone(), line: self.line.max(1), message }
    }

    /// Returns a cell of the current row. Returns an empty text if the column does not exist.
    pub fn text(&self, column: usize) -> &str {
        let start = column.checked_sub(1).map_or(Some(0), |before| Some(self.ends.get(before)? + 1));
        let range = start.zip(self.ends.get(column)).map(|(start, end)| start..*end);
        range.and_then(|range| self.text.get(range)).unwrap_or_default()
    }

    /// Returns a cell of the current row as a number. `name` is the column name for the error message.
    ///
    /// # Errors
    /// The cell is not a number.
    pub fn number(&self, column: usize, name: &str) -> Result<f64, FrameError> {
        let text = self.text(column);
        text.parse().map_err(|_| FrameError::Number {
            path: self.path.clone(),
            line: self.line,
            column: name.to_owned(),
            text: text.to_owned(),
        })
    }
}

/// Splits a line with quoted cells (RFC 4180).
fn unquote(line: &str, text: &mut String, ends: &mut Vec<usize>) -> Result<(), String> {
    let mut rest = line;
    loop {
        rest = match rest.strip_prefix('"') {
            None => {
                let end = rest.find(',').unwrap_or(rest.len());
                text.push_str(&rest[..end]);
                &rest[end..]
            }
            Some(mut inside) => loop {
                let end = inside.find('"').ok_or("a quoted cell does not end in its line")?;
                text.push_str(&inside[..end]);
                inside = &inside[end + 1..];
                match inside.strip_prefix('"') {
                    // Two quotes in a quoted cell stand for one quote.
                    Some(more) => {
                        text.push('"');
                        inside = more;
                    }
                    None => break inside,
                }
            },
        };
        ends.push(text.len());
        match rest.strip_prefix(',') {
            Some(more) => rest = more,
            None if rest.is_empty() => return Ok(()),
            None => return Err("expected a comma after a quoted cell".to_owned()),
        }
        text.push(',');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seal::hash;
    use proptest::prelude::*;
    use tempfile::NamedTempFile;

    /// Returns the rows of a text, headings first, or the error message.
    fn rows(text: &[u8], seal: Option<Seal>) -> Result<Vec<Vec<String>>, String> {
        let file = NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let table = SealedTable { path: file.path().to_owned(), seal };
        let read = || -> Result<_, FrameError> {
            let mut rows = Rows::open(&table)?;
            let mut all = vec![rows.head().to_vec()];
            while rows.advance()? {
                all.push((0..rows.ends.len()).map(|column| rows.text(column).to_owned()).collect());
            }
            Ok(all)
        };
        read().map_err(|error| error.to_string().replace(file.path().to_str().unwrap(), "T"))
    }

    proptest! {
        #[test]
        fn what_the_library_writes_is_read(
            cells in prop::collection::vec(prop::collection::vec("[a-c,\" µ]{0,4}x", 3), 1..9)
        ) {
            let mut writer = csv::Writer::from_writer(Vec::new());
            cells.iter().for_each(|cells| writer.write_record(cells).unwrap());
            prop_assert_eq!(rows(&writer.into_inner().unwrap(), None), Ok(cells));
        }
    }

    #[test]
    fn lines_that_are_no_rows_are_named() {
        let fault = |text: &str| rows(text.as_bytes(), None).unwrap_err();
        assert_eq!(fault("a,b\n1,2\n\n3\n"), "T:3  expected 2 cells like the first line, got 1");
        assert_eq!(fault("a\n1,2\n"), "T:2  expected 1 cell like the first line, got 2");
        assert_eq!(fault("a,b\n1,\"2\n\""), "T:2  a quoted cell does not end in its line");
        assert_eq!(fault("a,b\n\"1\"2,3\n"), "T:2  expected a comma after a quoted cell");
        assert_eq!(rows(b"a\n\xff\n", None).unwrap_err(), "T:2  is not UTF-8 text");
        assert_eq!(fault("a\n\u{1b}[2J\n"), "T:2  has a control character");
        assert_eq!(rows(b"", None), Ok(vec![vec![]]));
        assert_eq!(rows(b"a,\r\n1,2", None).unwrap()[1], ["1", "2"]);
    }

    #[test]
    fn cells_columns_and_lines_have_an_end() {
        let fault = |text: String| rows(text.as_bytes(), None).unwrap_err();
        let long = "x".repeat(1025);
        assert_eq!(fault(format!("a\n{long}\n")), "T:2  a cell has 1025 bytes, expected at most 1024");
        assert_eq!(fault(format!("\"{long}\"\n")), "T:1  a cell has 1025 bytes, expected at most 1024");
        assert!(rows(format!("a\n{}\n", &long[1..]).as_bytes(), None).is_ok());
        assert_eq!(fault(",".repeat(200_000)), "T:1  expected at most 200000 cells, got 200001");
        assert_eq!(fault("x".repeat(50_000_000)), "T:1  the line has more than 16777216 bytes");
    }

    #[test]
    fn a_table_is_held_against_its_seal() {
        let text = "a,b\n1,2\n3,4\n";
        let seal = |text: &str, rows| Some(Seal { rows, sha256: hash(text) });
        assert!(rows(text.as_bytes(), seal(text, 2)).is_ok());
        let fewer = rows(b"a,b\n1,2\n", seal(text, 2)).unwrap_err();
        assert_eq!(fewer, "T:2  expected 2 rows by summary.json, got 1");
        for other in ["a,b\n1,2\n3,5\n", "a,b\n1,2\n3,4", "a,c\n1,2\n3,4\n", "a,b\r\n1,2\n3,4\n"] {
            let changed = rows(other.as_bytes(), seal(text, 2)).unwrap_err();
            assert!(changed.starts_with("T: is not the table of its run"), "{changed}");
        }
    }
}
