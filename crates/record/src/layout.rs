//! Detects the layout of a table from the beginning of a file: delimiter, decimal sign, heading lines and first row.

use crate::cell::{Cell, DAY, Digits, trimmed};
use crate::recipe::{Encoding, Recipe};
use crate::unit;

/// Combinations of delimiter and decimal sign, in the order in which they are tried. Among equally good ones the first is used.
const WAYS: [(char, char); 9] = [
    ('\t', '.'),
    (';', '.'),
    (',', '.'),
    ('|', '.'),
    (' ', '.'),
    ('\t', ','),
    (';', ','),
    ('|', ','),
    (' ', ','),
];
/// Thousands separators that are tried.
const GROUPS: [Option<char>; 5] = [None, Some('.'), Some(','), Some('\''), Some('\u{a0}')];
/// Minimum fraction of numbers in the rows of a numeric column.
const MOSTLY: f64 = 0.8;
/// Maximum number of heading lines from which names and units are read.
const HEADS: usize = 2;

/// A column with the information of its heading.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name of the column; empty if there is none.
    pub name: String,
    /// Unit as written in the heading.
    pub unit: Option<String>,
    /// Whether the column contains numbers or clock times.
    pub is_number: bool,
    /// Whether the column contains clock times.
    pub is_clock: bool,
    /// Whether the values ascend strictly in the examined part of the file.
    pub rises: bool,
}

/// Layout of a table in a text file.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Encoding of the text.
    pub encoding: Encoding,
    /// Delimiter between fields. A blank stands for any number of blanks and tabs.
    pub delimiter: char,
    /// Decimal sign.
    pub decimal: char,
    /// Thousands separator.
    pub thousands: Option<char>,
    /// Number of lines before the first row.
    pub skip: usize,
    /// Prefix of comment lines, which are skipped.
    pub comment: Option<String>,
    /// Additional words for missing values.
    pub missing: Vec<String>,
    /// Columns of the table.
    pub columns: Vec<Column>,
    /// Time of the first row and interval of the rows, s, if the heading or the recipe gives them.
    pub pace: Option<[f64; 2]>,
    /// The first three rows as text.
    pub rows: Vec<Vec<String>>,
}

impl Layout {
    /// Detects the layout from the first lines of a file. Settings of the recipe override the detection.
    ///
    /// Returns `None` if there are no rows of numbers.
    pub(crate) fn guess(lines: &[&str], encoding: Encoding, recipe: &Recipe) -> Option<Self> {
        let comment = recipe.comment.clone();
        let missing = recipe.missing.clone().unwrap_or_default();
        let is_comment = |line: &str| comment.as_deref().is_some_and(|sign| line.starts_with(sign));
        let lines: Vec<&str> = lines.iter().map(|line| if is_comment(line) { "" } else { *line }).collect();
        let (delimiter, digits) = way(&lines, recipe, &missing)?;
        let cells = |line: &str| -> Vec<Cell> {
            fields(line, delimiter).iter().map(|field| Cell::read(field, digits, &missing)).collect()
        };
        let all: Vec<Vec<Cell>> = lines.iter().map(|line| cells(line)).collect();
        let said = recipe.skip.unwrap_or(0);
        let numbers = number_columns(&all[said.min(all.len())..])?;
        let is_row = |cells: &[Cell]| is_row(cells, &numbers);
        let first = match recipe.skip {
            Some(skip) => skip,
            None => (0..all.len()).find(|k| {
                is_row(&all[*k])
                    && all[k + 1..].iter().find(|next| !next.is_empty()).is_none_or(|next| is_row(next))
            })?,
        };
        let rows: Vec<&Vec<Cell>> = all.iter().skip(first).filter(|cells| is_row(cells)).collect();
        let heads: Vec<Vec<String>> = heads(&lines[..first], delimiter, numbers.len());
        let width = rows.iter().map(|cells| cells.len()).max().unwrap_or(0).max(numbers.len());
        let columns = (0..width).map(|place| column(place, &heads, &rows, &numbers)).collect();
        let texts = lines.iter().zip(&all).skip(first).filter(|(_, cells)| is_row(cells));
        let texts = texts.take(3).map(|(line, _)| {
            fields(line, delimiter).into_iter().map(|field| trimmed(&field).to_owned()).collect()
        });
        let pace = recipe
            .increment
            .map(|increment| [recipe.start.unwrap_or(0.0), increment])
            .or_else(|| pace(&heads, digits));
        Some(Self {
            encoding,
            delimiter,
            decimal: digits.decimal,
            thousands: digits.thousands,
            skip: first,
            comment,
            missing,
            columns,
            pace,
            rows: texts.collect(),
        })
    }

    pub(crate) fn digits(&self) -> Digits {
        Digits { decimal: self.decimal, thousands: self.thousands }
    }

    /// Returns the numbers, names and units of the columns as text: `1 "t [s]", 2 "disp"`.
    #[must_use]
    pub fn words(&self) -> String {
        let one = |(place, column): (usize, &Column)| {
            let unit = column.unit.as_ref().map_or_else(String::new, |unit| format!(" [{unit}]"));
            match column.name.as_str() {
                "" if unit.is_empty() => format!("{}", place + 1),
                name => format!("{} \"{}\"", place + 1, format!("{name}{unit}").trim()),
            }
        };
        self.columns.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
    }
}

/// Splits a line into fields. A delimiter within quotes does not split.
///
/// An empty line has no fields. Empty fields at the end of a line are dropped.
pub(crate) fn fields(line: &str, delimiter: char) -> Vec<String> {
    if line.trim().is_empty() {
        return Vec::new();
    }
    if delimiter == ' ' {
        return line.split_whitespace().map(str::to_owned).collect();
    }
    let (mut fields, mut field, mut is_quoted) = (Vec::new(), String::new(), false);
    for c in line.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            c if c == delimiter && !is_quoted => fields.push(std::mem::take(&mut field)),
            c => field.push(c),
        }
    }
    fields.push(field);
    while fields.len() > 1 && fields.last().is_some_and(|last| last.trim().is_empty()) {
        fields.pop();
    }
    fields
}

/// Returns the delimiter and the number format with the most numbers and the fewest words.
fn way(lines: &[&str], recipe: &Recipe, missing: &[String]) -> Option<(char, Digits)> {
    // The later half of the lines certainly contains rows.
    let lines = &lines[(lines.len() / 2).min(lines.len().saturating_sub(1))..];
    let score = |delimiter: char, digits: Digits| {
        let of = |line: &&str| {
            let cells = fields(line, delimiter);
            let cells = cells.iter().map(|field| Cell::read(field, digits, missing));
            cells
                .map(|cell| {
                    if cell.is_value() {
                        1
                    } else if cell == Cell::Word {
                        -2
                    } else {
                        0
                    }
                })
                .sum::<i64>()
                .max(0)
        };
        lines.iter().map(of).sum::<i64>()
    };
    let ways = WAYS.into_iter().filter(|(delimiter, decimal)| {
        recipe.delimiter.is_none_or(|own| own == *delimiter)
            && recipe.decimal.is_none_or(|own| own == *decimal)
    });
    let own = recipe.delimiter.map(|delimiter| (delimiter, recipe.decimal.unwrap_or('.')));
    let ways: Vec<_> = ways.chain(own).collect();
    let mut best: Option<(i64, (char, Digits))> = None;
    for thousands in GROUPS {
        let thousands = recipe.thousands.or(thousands);
        for (delimiter, decimal) in ways.iter().copied().filter(|(delimiter, decimal)| {
            thousands.is_none_or(|sign| sign != *delimiter && sign != *decimal)
        }) {
            let digits = Digits { decimal, thousands };
            let found = score(delimiter, digits);
            if found > 0 && best.is_none_or(|(most, _)| found > most) {
                best = Some((found, (delimiter, digits)));
            }
        }
    }
    best.map(|(_, way)| way)
}

/// Returns which columns are numeric, judged by the later half of the lines.
fn number_columns(all: &[Vec<Cell>]) -> Option<Vec<bool>> {
    let later = &all[all.len() / 2..];
    let with_numbers: Vec<&Vec<Cell>> =
        later.iter().filter(|cells| cells.iter().any(|cell| cell.is_value())).collect();
    let width = with_numbers.iter().map(|cells| cells.len()).max()?;
    let share = |place: usize| {
        let values = with_numbers.iter().filter(|cells| cells.get(place).is_some_and(|cell| cell.is_value()));
        values.count() as f64 / with_numbers.len() as f64
    };
    let numbers: Vec<bool> = (0..width).map(|place| share(place) >= MOSTLY).collect();
    let last = numbers.iter().rposition(|is| *is)?;
    Some(numbers[..=last].to_vec())
}

/// Returns whether a line is a row: the numeric columns contain numbers or missing values, and at least one number.
pub(crate) fn is_row(cells: &[Cell], numbers: &[bool]) -> bool {
    let own = || cells.iter().zip(numbers).filter(|(_, is_number)| **is_number).map(|(cell, _)| cell);
    own().any(|cell| cell.is_value()) && own().all(|cell| *cell != Cell::Word)
}

/// Returns the heading lines directly above the rows, in order from top to bottom.
fn heads(above: &[&str], delimiter: char, width: usize) -> Vec<Vec<String>> {
    let filled = above.iter().rev().skip_while(|line| line.trim().is_empty());
    let lines = filled.take_while(|line| !line.trim().is_empty()).map(|line| {
        fields(line, delimiter).into_iter().map(|field| trimmed(&field).to_owned()).collect::<Vec<_>>()
    });
    let enough = width.min(2);
    let mut heads: Vec<Vec<String>> = lines.take_while(|fields| fields.len() >= enough).take(HEADS).collect();
    heads.reverse();
    heads
}

fn column(place: usize, heads: &[Vec<String>], rows: &[&Vec<Cell>], numbers: &[bool]) -> Column {
    let (mut names, mut unit) = (Vec::new(), None);
    for cell in heads.iter().filter_map(|fields| fields.get(place)).filter(|cell| !cell.is_empty()) {
        let (name, own) = unit::part(cell);
        // If both lines contain a unit, the lower one counts.
        unit = own.or(unit);
        if !name.is_empty() {
            names.push(name);
        }
    }
    let values: Vec<f64> = rows
        .iter()
        .filter_map(|cells| match cells.get(place) {
            Some(Cell::Number(value)) => Some(*value),
            Some(Cell::Clock(days, seconds)) => Some(DAY * days + seconds),
            _ => None,
        })
        .collect();
    let clocks = rows.iter().filter(|cells| matches!(cells.get(place), Some(Cell::Clock(..)))).count();
    Column {
        name: names.join(" "),
        unit,
        is_number: numbers.get(place).copied().unwrap_or(false),
        is_clock: 2 * clocks > rows.len(),
        rises: values.len() > 1 && values.windows(2).all(|pair| pair[1] > pair[0]),
    }
}

/// Returns the start time and the increment, which oscilloscopes write in the line below these words.
fn pace(heads: &[Vec<String>], digits: Digits) -> Option<[f64; 2]> {
    let [names, values] = heads else { return None };
    let of = |words: &[&str]| {
        let place = names.iter().position(|name| words.contains(&name.to_lowercase().as_str()))?;
        match Cell::read(values.get(place)?, digits, &[]) {
            Cell::Number(value) => Some(value),
            _ => None,
        }
    };
    Some([of(&["start"])?, of(&["increment", "delta", "interval"])?])
}
