//! Reads the numeric columns of a file line by line.

use crate::cell::{Cell, DAY, Digits, unwind};
use crate::error::RecordError;
use crate::layout::{Layout, fields, is_row};
use crate::recipe::{ColumnRecipe, Encoding, Place, Recipe, Role};
use crate::roles::{Reading, readings};
use crate::sheet;
use crate::unit::{self, Kind};
use encoding_rs::{UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use encoding_rs_io::{DecodeReaderBytes, DecodeReaderBytesBuilder};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// Size of the beginning of a file from which the layout is detected, in bytes.
const SAMPLE: u64 = 1 << 18;
/// Maximum number of lines for the detection.
const LINES: usize = 600;
/// Number of consecutive text lines that separate two blocks of rows.
const HEAD: usize = 2;

/// Numbers of skipped lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Passed {
    /// Empty lines below the first row.
    pub empty: usize,
    /// Comment lines.
    pub comments: usize,
    /// Text lines, such as headings of blocks and footers.
    pub words: usize,
    /// Rows with a missing value.
    pub missing: usize,
}

/// Columns of a table in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Layout of the file.
    pub layout: Layout,
    /// Columns by role, all of equal length. Times are absent if the file contains none.
    pub columns: BTreeMap<Role, Vec<f64>>,
    /// Number of rows.
    pub rows: usize,
    /// Index of the first row of each block. The first index is 0.
    pub blocks: Vec<usize>,
    /// Numbers of skipped lines.
    pub passed: Passed,
    /// Notes on assumptions and skipped lines, as sentences.
    pub notes: Vec<String>,
    readings: BTreeMap<Role, Reading>,
}

impl Record {
    /// Reads a file. Settings that the recipe omits are detected. Only the roles in `wanted` are required.
    ///
    /// # Errors
    /// The file cannot be read, contains no rows of numbers, or lacks a required column.
    pub fn read(path: &Path, recipe: &Recipe, wanted: &[Role]) -> Result<Self, RecordError> {
        let name = path.display().to_string();
        let failed = |source| RecordError::File { file: name.clone(), source };
        if sheet::is_sheet(&name) {
            return Self::of(&name, &std::fs::read(path).map_err(failed)?, recipe, wanted);
        }
        let sample = sample(path).map_err(failed)?;
        let file = File::open(path).map_err(failed)?;
        Self::from(&name, &sample, file, recipe, wanted)
    }

    /// Reads the bytes of a file in memory. `name` is used in errors.
    ///
    /// # Errors
    /// As for [`Record::read`].
    pub fn of(name: &str, bytes: &[u8], recipe: &Recipe, wanted: &[Role]) -> Result<Self, RecordError> {
        let text = if sheet::is_sheet(name) { Some(sheet::text(name, bytes)?) } else { None };
        let bytes = text.as_ref().map_or(bytes, |text| text.as_bytes());
        let sample = &bytes[..bytes.len().min(SAMPLE as usize)];
        Self::from(name, sample, bytes, recipe, wanted)
    }

    fn from(
        name: &str,
        sample: &[u8],
        whole: impl Read,
        recipe: &Recipe,
        wanted: &[Role],
    ) -> Result<Self, RecordError> {
        let failed = |source| RecordError::File { file: name.to_owned(), source };
        let encoding = recipe.encoding.unwrap_or_else(|| encoding(sample));
        let codec = codec(encoding, sample);
        let mut text = String::new();
        decoded(sample, codec).read_to_string(&mut text).map_err(failed)?;
        // The last line of a partly read file may be incomplete.
        let end =
            if sample.len() as u64 == SAMPLE { text.rfind('\n').unwrap_or(text.len()) } else { text.len() };
        let lines: Vec<&str> = text[..end].lines().take(LINES).collect();
        let layout = Layout::guess(&lines, encoding, recipe).ok_or_else(|| {
            let first = lines.iter().find(|line| !line.trim().is_empty());
            let why = first.map_or(": it is empty".to_owned(), |line| {
                format!("; it begins with {:?}", line.chars().take(60).collect::<String>())
            });
            RecordError::NoRows { file: name.to_owned(), why }
        })?;
        let readings = readings(name, &layout, recipe, wanted)?;
        let mut record = Self {
            columns: readings.keys().map(|role| (*role, Vec::new())).collect(),
            layout,
            rows: 0,
            blocks: Vec::new(),
            passed: Passed::default(),
            notes: Vec::new(),
            readings,
        };
        record.fill(BufReader::with_capacity(1 << 16, decoded(whole, codec))).map_err(failed)?;
        record.finish(name)?;
        Ok(record)
    }

    /// Returns a recipe that contains all detected settings.
    #[must_use]
    pub fn recipe(&self) -> Recipe {
        let column = |(role, reading): (&Role, &Reading)| {
            let Reading { place, gain, offset, unit, .. } = reading;
            let own = ColumnRecipe {
                column: Some(Place::Number(place + 1)),
                unit: Some(unit.clone()),
                gain: (*gain != 1.0).then_some(*gain),
                offset: (*offset != 0.0).then_some(*offset),
            };
            (*role, own)
        };
        let Layout { encoding, delimiter, decimal, thousands, skip, ref comment, ref missing, pace, .. } =
            self.layout;
        Recipe {
            encoding: Some(encoding),
            skip: Some(skip),
            delimiter: Some(delimiter),
            decimal: Some(decimal),
            thousands,
            comment: comment.clone(),
            missing: Some(missing.clone()).filter(|missing| !missing.is_empty()),
            start: pace.map(|[start, _]| start),
            increment: pace.map(|[_, increment]| increment),
            columns: self.readings.iter().map(column).collect(),
        }
    }

    /// Returns the kind of quantity of a role's unit. Returns `None` if the column is absent or its unit was assumed.
    #[must_use]
    pub fn kind(&self, role: Role) -> Option<Kind> {
        let reading = self.readings.get(&role).filter(|reading| !reading.is_assumed)?;
        unit::find(&reading.unit).map(|(kind, _)| kind)
    }

    /// Returns the role and the unit of a column by its index.
    #[must_use]
    pub fn role(&self, place: usize) -> Option<(Role, &str)> {
        let found = self.readings.iter().find(|(_, reading)| reading.place == place);
        found.map(|(role, reading)| (*role, reading.unit.as_str()))
    }

    fn fill(&mut self, mut from: impl BufRead) -> io::Result<()> {
        let (mut line, mut number, mut words) = (String::new(), 0, 0);
        let readings: Vec<(Role, Reading)> =
            self.readings.iter().map(|(role, reading)| (*role, reading.clone())).collect();
        let (digits, delimiter, skip) = (self.layout.digits(), self.layout.delimiter, self.layout.skip);
        let (missing, comment) = (self.layout.missing.clone(), self.layout.comment.clone());
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); readings.len()];
        let (mut row, mut first) = (vec![0.0; readings.len()], None);
        loop {
            line.clear();
            if from.read_line(&mut line)? == 0 {
                break;
            }
            number += 1;
            if number <= skip {
                continue;
            }
            let text = line.trim_end_matches(['\n', '\r']);
            if text.trim().is_empty() {
                self.passed.empty += 1;
                continue;
            }
            if comment.as_deref().is_some_and(|sign| text.starts_with(sign)) {
                self.passed.comments += 1;
                continue;
            }
            let read = match readings.is_empty() {
                // If no column is read, rows are recognised by their form.
                true => self.is_row(text).then_some(true),
                false => read_row(text, (delimiter, digits, &missing), &readings, (&mut row, &mut first)),
            };
            match read {
                Some(true) => {
                    if self.rows == 0 || words >= HEAD {
                        self.blocks.push(self.rows);
                    }
                    words = 0;
                    self.rows += 1;
                    columns.iter_mut().zip(&row).for_each(|(column, value)| column.push(*value));
                }
                Some(false) => self.passed.missing += 1,
                None => (self.passed.words, words) = (self.passed.words + 1, words + 1),
            }
        }
        columns.iter_mut().for_each(Vec::shrink_to_fit);
        self.columns = readings.into_iter().map(|(role, _)| role).zip(columns).collect();
        Ok(())
    }

    fn is_row(&self, text: &str) -> bool {
        let layout = &self.layout;
        let cells = fields(text, layout.delimiter);
        let cells: Vec<Cell> =
            cells.iter().map(|field| Cell::read(field, layout.digits(), &layout.missing)).collect();
        is_row(&cells, &layout.columns.iter().map(|column| column.is_number).collect::<Vec<_>>())
    }

    /// Completes the columns after reading: clock times become times from 0, missing times are added and notes are collected.
    fn finish(&mut self, name: &str) -> Result<(), RecordError> {
        for (role, column) in &self.columns {
            if column.is_empty() {
                let column = self.readings.get(role).map_or(0, |reading| reading.place + 1);
                return Err(RecordError::NoNumbers { file: name.to_owned(), column, role: *role });
            }
        }
        let is_clock = self.readings.get(&Role::Time).is_some_and(|reading| reading.is_clock);
        if is_clock && let Some(times) = self.columns.get_mut(&Role::Time) {
            if unwind(times) {
                self.notes.push("clock times pass midnight: a day is added".to_owned());
            }
            let first = times.first().copied().unwrap_or(0.0);
            times.iter_mut().for_each(|time| *time -= first);
        }
        let assumed: Vec<String> = self
            .readings
            .iter()
            .filter(|(_, reading)| reading.is_assumed)
            .map(|(role, reading)| format!("column {} ({}) in {}", reading.place + 1, role.word(), role.si()))
            .collect();
        if !assumed.is_empty() {
            self.notes.push(format!(
                "without a unit, read in SI: {}; a unit may follow a column, such as 2:um",
                assumed.join(", ")
            ));
        }
        if let (Some([start, increment]), false) = (self.layout.pace, self.columns.contains_key(&Role::Time))
        {
            let times = (0..self.rows).map(|row| start + row as f64 * increment).collect();
            self.columns.insert(Role::Time, times);
        }
        let Passed { empty, comments, words, missing } = self.passed;
        let told = [
            (missing, "rows with a missing value"),
            (words, "lines of words"),
            (empty, "empty lines"),
            (comments, "comments"),
        ];
        let told: Vec<String> = told
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        if !told.is_empty() {
            self.notes.push(format!("skipped: {}", told.join(", ")));
        }
        if self.blocks.len() > 1 {
            self.notes.push(format!("{} blocks of rows, separated by lines of words", self.blocks.len()));
        }
        Ok(())
    }
}

/// Reads a row. Returns `Some(false)` if a value is missing and `None` if the line is not a row.
fn read_row(
    text: &str,
    (delimiter, digits, missing): (char, Digits, &[String]),
    readings: &[(Role, Reading)],
    (row, first): (&mut [f64], &mut Option<f64>),
) -> Option<bool> {
    let (mut is_whole, mut any) = (true, false);
    let mut take = |place: usize, field: Option<&str>| -> Option<()> {
        for ((_, reading), value) in
            readings.iter().zip(row.iter_mut()).filter(|((_, reading), _)| reading.place == place)
        {
            match field.map_or(Cell::Missing, |field| Cell::read(field, digits, missing)) {
                Cell::Number(number) if !reading.is_clock => *value = reading.si(number),
                // Days are counted from the first row to keep the resolution of the times.
                Cell::Clock(days, seconds) if reading.is_clock => {
                    *value = DAY * (days - *first.get_or_insert(days)) + seconds;
                }
                Cell::Missing => is_whole = false,
                _ => return None,
            }
            any |= is_whole;
        }
        Some(())
    };
    let last = readings.iter().map(|(_, reading)| reading.place).max()?;
    let mut count = 0;
    let mut each = |field: &str| -> Option<()> {
        take(count, Some(field))?;
        count += 1;
        Some(())
    };
    match delimiter {
        ' ' => text.split_ascii_whitespace().take(last + 1).try_for_each(&mut each)?,
        _ if text.contains('"') => {
            fields(text, delimiter).iter().take(last + 1).try_for_each(|field| each(field))?;
        }
        _ => text.split(delimiter).take(last + 1).try_for_each(&mut each)?,
    }
    for place in count..=last {
        take(place, None)?;
    }
    // A text line contains no digits.
    (any || text.chars().any(|c| c.is_ascii_digit())).then_some(is_whole)
}

/// Reads the beginning of a file.
fn sample(path: &Path) -> io::Result<Vec<u8>> {
    if path.canonicalize().is_ok_and(|named| !named.is_file()) {
        let kind = if path.is_dir() { io::ErrorKind::IsADirectory } else { io::ErrorKind::InvalidInput };
        return Err(io::Error::new(kind, "not a file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(SAMPLE).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Detects the encoding from the byte order mark, the zero bytes of UTF-16, or the validity as UTF-8.
fn encoding(bytes: &[u8]) -> Encoding {
    let zeros = bytes.iter().take(1000).filter(|byte| **byte == 0).count();
    if bytes.starts_with(&[0xff, 0xfe])
        || bytes.starts_with(&[0xfe, 0xff])
        || 4 * zeros > bytes.len().min(1000)
    {
        return Encoding::Utf16;
    }
    match std::str::from_utf8(bytes) {
        Ok(_) => Encoding::Utf8,
        // The last character may be incomplete.
        Err(error) if error.error_len().is_none() && bytes.len() as u64 == SAMPLE => Encoding::Utf8,
        Err(_) => Encoding::Latin1,
    }
}

/// Returns the decoder of an encoding. `sample` decides the byte order of UTF-16.
fn codec(encoding: Encoding, sample: &[u8]) -> &'static encoding_rs::Encoding {
    match encoding {
        Encoding::Utf8 => UTF_8,
        Encoding::Latin1 => WINDOWS_1252,
        // In UTF-16 big-endian, the zero byte of a Latin letter comes first.
        Encoding::Utf16 if sample.first() == Some(&0) => UTF_16BE,
        Encoding::Utf16 => UTF_16LE,
    }
}

/// Decodes a text to UTF-8. A byte order mark overrides the encoding.
fn decoded<R: Read>(from: R, codec: &'static encoding_rs::Encoding) -> DecodeReaderBytes<R, Vec<u8>> {
    DecodeReaderBytesBuilder::new().encoding(Some(codec)).bom_override(true).build(from)
}
