//! A table of results read back from its file: columns of numbers or words.

use crate::complaint::words;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Quantities whose columns hold words; all others hold numbers.
const WORDS: [&str; 4] = ["state", "source", "kind", "contact"];

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
    /// What it holds.
    pub values: Values,
}

/// What a column holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// A number in each row, in the SI unit of the name.
    Numbers(Vec<f64>),
    /// A word in each row.
    Words(Words),
}

/// Words of a column: few different ones, each kept once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Words {
    /// The different words, in order of appearance.
    pub dictionary: Vec<String>,
    /// Place of each row's word in the dictionary.
    pub codes: Vec<u32>,
}

/// Why a table cannot be read.
#[derive(Debug, Error)]
pub enum FrameError {
    /// The file, or the form of its rows.
    #[error("{}: {}", .path.display(), reason(.source))]
    Csv {
        /// Which file.
        path: PathBuf,
        /// What the reader says.
        source: csv::Error,
    },
    /// Something that is no number.
    #[error("{}:{line}  {column}: expected a number, got \"{}\"", .path.display(), .text.escape_debug())]
    Number {
        /// Which file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// A column where another is expected.
    #[error("{}:1  column {place}: expected {expected}, got {got}", .path.display())]
    Head {
        /// Which file.
        path: PathBuf,
        /// Place of the column, from 1.
        place: usize,
        /// The column that belongs there.
        expected: String,
        /// The one that stands there.
        got: String,
    },
    /// A line that says what cannot be.
    #[error("{}:{line}  {message}", .path.display())]
    Content {
        /// Which file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// What is wrong with it.
        message: String,
    },
}

/// A missing file is told in the system's words.
fn reason(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Io(error) => format!("cannot be read: {}", words(error)),
        _ => error.to_string(),
    }
}

impl Frame {
    /// Reads a CSV with one line of names.
    ///
    /// # Errors
    /// A file that cannot be read, or a cell that is no number where one is expected.
    pub fn read(path: &Path) -> Result<Self, FrameError> {
        let csv = |source| FrameError::Csv { path: path.to_owned(), source };
        let mut reader = csv::Reader::from_path(path).map_err(csv)?;
        let names = reader.headers().map_err(csv)?.clone();
        let mut columns: Vec<Filling> = names.iter().map(Filling::new).collect();
        let mut record = csv::StringRecord::new();
        let mut rows = 0;
        while reader.read_record(&mut record).map_err(csv)? {
            for (column, text) in columns.iter_mut().zip(&record) {
                if !column.push(text) {
                    let line = record.position().map_or(0, csv::Position::line);
                    let column = column.name.clone();
                    return Err(FrameError::Number {
                        path: path.to_owned(),
                        line,
                        column,
                        text: text.to_owned(),
                    });
                }
            }
            rows += 1;
        }
        Ok(Self { columns: columns.into_iter().map(Filling::into_column).collect(), rows })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// All columns in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// A column of numbers by name; none where there is no such column, or one of words.
    pub fn numbers(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).and_then(|column| match &column.values {
            Values::Numbers(values) => Some(values.as_slice()),
            Values::Words(_) => None,
        })
    }

    /// A column of words by name.
    pub fn words(&self, name: &str) -> Option<&Words> {
        self.columns.iter().find(|column| column.name == name).and_then(|column| match &column.values {
            Values::Words(words) => Some(words),
            Values::Numbers(_) => None,
        })
    }
}

impl Words {
    /// The word of a row.
    pub fn get(&self, row: usize) -> Option<&str> {
        let code = *self.codes.get(row)?;
        self.dictionary.get(code as usize).map(String::as_str)
    }
}

/// A column while it is read.
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

    /// Takes the next cell; `false` where it should be a number and is none.
    fn push(&mut self, text: &str) -> bool {
        match &mut self.values {
            Values::Numbers(values) => match text.parse() {
                Ok(value) => values.push(value),
                Err(_) => return false,
            },
            Values::Words(words) => {
                let code = *self.known.entry(text.to_owned()).or_insert_with(|| {
                    words.dictionary.push(text.to_owned());
                    words.dictionary.len() as u32 - 1
                });
                words.codes.push(code);
            }
        }
        true
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
        Frame::read(file.path())
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
        assert!(read("time_s,ball.u_m\n0\n").unwrap_err().to_string().contains("line: 2"));
        let missing = Frame::read(Path::new("no/such.csv")).unwrap_err().to_string();
        assert!(missing.starts_with("no/such.csv: cannot be read: "), "{missing}");
    }
}
