//! A table of results read back from its file: columns of numbers or words.

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

/// Quantities whose columns hold words; all others hold numbers.
const WORDS: [&str; 4] = ["state", "source", "kind", "contact"];

/// Most different words of a column: names of contacts and waveforms.
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
    /// The file.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Another table than the one that the summary beside it seals.
    #[error("{}: is not the table that its run wrote: its SHA-256 is not that in summary.json\n   help: it was changed after the run, or is that of another run; run the scenario again", .0.display())]
    Changed(PathBuf),
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

impl Frame {
    /// Reads a CSV with one line of names.
    ///
    /// # Errors
    /// A file that cannot be read or is not the sealed one, two columns of one name, a cell that is no number where one is
    /// expected, more numbers or different words than a run writes.
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
    /// Takes the word of the next row; `false` where it is one too many.
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

    /// The word of a row.
    pub fn get(&self, row: usize) -> Option<&str> {
        let code = *self.codes.get(row)?;
        self.dictionary.get(code as usize).map(String::as_str)
    }
}

/// The word of a cell: a state may stand there as its number.
fn word<'a>(column: &str, text: &'a str) -> &'a str {
    if !column.ends_with(".state") {
        return text;
    }
    match state_code(text) {
        Some(code) => state_name(code),
        None => text,
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
