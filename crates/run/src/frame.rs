//! Tables of results, read into memory as columns of numbers or words.

use crate::complaint::words;
use crate::limits::MOST_VALUES;
use crate::rows::Rows;
use crate::seal::SealedTable;
use crate::states::state_code;
use std::collections::{HashMap, HashSet};
use std::io;
use std::path::PathBuf;
use stickslip_drive::state_name;
use thiserror::Error;

/// Quantities whose columns contain words. All other columns contain numbers.
const WORDS: [&str; 4] = ["state", "source", "kind", "contact"];

/// Maximum number of different words of a column.
const MOST_WORDS: usize = 100_000;

/// A table in memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    columns: Vec<Column>,
    rows: usize,
}

/// A named column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name with its SI unit, such as `slider.x_m`.
    pub name: String,
    /// Values of the column.
    pub values: Values,
}

/// Values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// One number per row, in the SI unit of the name.
    Numbers(Vec<f64>),
    /// One word per row.
    Words(Words),
}

/// Words of a column, stored with a dictionary.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Words {
    /// Different words of the column in order of first occurrence.
    pub dictionary: Vec<String>,
    /// Index of the word of each row in the dictionary.
    pub codes: Vec<u32>,
}

/// Error of reading a table.
#[derive(Debug, Error)]
pub enum FrameError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The SHA-256 of the table differs from that in the summary.
    #[error("{}: is not the table of its run: its SHA-256 differs from that in summary.json\n   help: the file was changed after the run, or is of another run; run the scenario again", .0.display())]
    Changed(PathBuf),
    /// A cell is not a number.
    #[error("{}:{line}  {column}: expected a number, got \"{}\"", .path.display(), .text.escape_debug())]
    Number {
        /// Path of the file.
        path: PathBuf,
        /// Line number, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// Text of the cell.
        text: String,
    },
    /// A column has an unexpected name.
    #[error("{}:1  column {place}: expected {expected}, got {got}", .path.display())]
    Head {
        /// Path of the file.
        path: PathBuf,
        /// Number of the column, from 1.
        place: usize,
        /// Expected name.
        expected: String,
        /// Actual name.
        got: String,
    },
    /// The contents of a line are invalid.
    #[error("{}:{line}  {message}", .path.display())]
    Content {
        /// Path of the file.
        path: PathBuf,
        /// Line number, from 1.
        line: u64,
        /// Description of the error.
        message: String,
    },
}

impl Frame {
    /// Reads a CSV file with one heading line.
    ///
    /// # Errors
    /// The file cannot be read, differs from its seal or is too large, two columns have the same name, or a cell is not a number.
    pub fn read(table: &SealedTable) -> Result<Self, FrameError> {
        let mut rows = Rows::open(table)?;
        let mut columns: Vec<Filling> = rows.head().iter().map(|name| Filling::new(name)).collect();
        let mut names = HashSet::new();
        if let Some(twice) = rows.head().iter().find(|name| !names.insert(name.as_str())) {
            return Err(rows.fault(format!("there are two columns \"{}\"", twice.escape_debug())));
        }
        let mut count = 0;
        while rows.advance()? {
            for (place, column) in columns.iter_mut().enumerate() {
                match &mut column.values {
                    Values::Numbers(values) => values.push(rows.number(place, &column.name)?),
                    Values::Words(words) => {
                        let word = word(&column.name, rows.text(place));
                        if !words.push(word, &mut column.known) {
                            return Err(rows.fault(format!("expected at most {MOST_WORDS} different words")));
                        }
                    }
                }
            }
            count += 1;
            if (count * columns.len()) as u64 > MOST_VALUES {
                return Err(rows.fault(format!("expected at most {MOST_VALUES} values")));
            }
        }
        Ok(Self { columns: columns.into_iter().map(Filling::into_column).collect(), rows: count })
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns all columns in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns a column of numbers by its name. Returns `None` if no such column exists or if it contains words.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).and_then(|column| match &column.values {
            Values::Numbers(values) => Some(values.as_slice()),
            Values::Words(_) => None,
        })
    }

    /// Returns a column of words by its name. Returns `None` if no such column exists or if it contains numbers.
    pub fn words(&self, name: &str) -> Option<&Words> {
        self.columns.iter().find(|column| column.name == name).and_then(|column| match &column.values {
            Values::Words(words) => Some(words),
            Values::Numbers(_) => None,
        })
    }
}

impl Words {
    /// Adds the word of the next row. Returns `false` if there are too many different words.
    fn push(&mut self, word: &str, known: &mut HashMap<String, u32>) -> bool {
        let code = known.get(word).copied().unwrap_or_else(|| {
            let code = self.dictionary.len() as u32;
            known.insert(word.to_owned(), code);
            self.dictionary.push(word.to_owned());
            code
        });
        self.codes.push(code);
        self.dictionary.len() <= MOST_WORDS
    }

    /// Returns the word of a row.
    pub fn get(&self, row: usize) -> Option<&str> {
        let code = *self.codes.get(row)?;
        self.dictionary.get(code as usize).map(String::as_str)
    }
}

/// Returns the word of a cell. States may be written as numbers.
fn word<'a>(column: &str, text: &'a str) -> &'a str {
    if !column.ends_with(".state") {
        return text;
    }
    match state_code(text) {
        Some(code) => state_name(code),
        None => text,
    }
}

/// A column that is being read.
struct Filling {
    name: String,
    values: Values,
    known: HashMap<String, u32>,
}

impl Filling {
    fn new(name: &str) -> Self {
        let quantity = name.rsplit_once('.').map_or(name, |(_, quantity)| quantity);
        let words = WORDS.contains(&quantity);
        let values = if words { Values::Words(Words::default()) } else { Values::Numbers(Vec::new()) };
        Self { name: name.to_owned(), values, known: HashMap::new() }
    }

    fn into_column(self) -> Column {
        Column { name: self.name, values: self.values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Frame, FrameError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        Frame::read(&file.path().to_owned().into())
    }

    #[test]
    fn numbers_come_back_to_the_bit_and_words_as_words() {
        let frame =
            read("time_s,source,ball.u_m,ball.state\n0,ball,1e-8,stick\n0.1,foot,-0.3,stick\n").unwrap();
        assert_eq!((frame.rows(), frame.columns().len()), (2, 4));
        assert_eq!(frame.numbers("ball.u_m").unwrap(), [1e-8, -0.3]);
        assert_eq!(frame.words("source").unwrap().get(1), Some("foot"));
        assert_eq!(frame.words("ball.state").unwrap().dictionary, ["stick"]);
        assert!(frame.numbers("ball.state").is_none() && frame.words("time_s").is_none());
    }

    #[test]
    fn what_is_no_number_is_named_with_its_place() {
        let error = read("time_s,ball.u_m\n0,1\n1,one\n").unwrap_err().to_string();
        assert!(error.ends_with(":3  ball.u_m: expected a number, got \"one\""), "{error}");
        let short = read("time_s,ball.u_m\n0\n").unwrap_err().to_string();
        assert!(short.ends_with(":2  expected 2 cells like the first line, got 1"), "{short}");
        let missing = Frame::read(&PathBuf::from("no/such.csv").into()).unwrap_err().to_string();
        assert!(missing.starts_with("no/such.csv: cannot be read: "), "{missing}");
        let twice = read("time_s,a.x_m,a.x_m\n").unwrap_err().to_string();
        assert!(twice.ends_with(":1  there are two columns \"a.x_m\""), "{twice}");
        let lines: String = (0..=MOST_WORDS).map(|word| format!("{word}\n")).collect();
        let many = read(&format!("source\n{lines}")).unwrap_err().to_string();
        assert!(many.ends_with(":100002  expected at most 100000 different words"), "{many}");
    }
}
