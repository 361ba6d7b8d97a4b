//! Reads CSV files: headers, numbers, and the byte range of each cell.

use crate::document::shown;
use crate::quantity::{LARGEST, convert, number_help};
use crate::units::Scale;
use std::ops::Range;

/// Error in a CSV text.
#[derive(Debug, PartialEq)]
pub(super) struct Slip {
    pub(super) range: Range<usize>,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

/// Returns the names of the columns.
pub(super) fn header(text: &str) -> Result<Vec<String>, Slip> {
    match reader(text).headers() {
        Ok(header) if !header.is_empty() => Ok(header.iter().map(str::to_owned).collect()),
        _ => Err(Slip {
            range: 0..1,
            message: "expected a first line with the names of the columns, got nothing".to_owned(),
            help: Some("such as \"time,value\"".to_owned()),
        }),
    }
}

/// Returns the numbers of some columns, in SI by the scale of each column. Every row must have `width` fields.
pub(super) fn numbers<const N: usize>(
    text: &str,
    columns: [(usize, Scale); N],
    width: usize,
) -> Result<Vec<[f64; N]>, Slip> {
    let mut rows = Vec::new();
    for record in reader(text).records() {
        // Reading a text in memory cannot fail, and rows may have any length.
        let Ok(record) = record else { continue };
        let start = start_of(text, &record);
        if record.len() != width {
            let fields = if width == 1 { "1 field" } else { &format!("{width} fields") };
            return Err(Slip {
                range: line_at(text, start),
                message: format!("expected {fields} like the first line, got {}", record.len()),
                help: Some("commas separate the fields; the decimal sign is a point".to_owned()),
            });
        }
        let number = |(column, scale): (usize, Scale)| {
            let field = record.get(column).unwrap_or("");
            let value = field.parse::<f64>().ok().filter(|value| value.is_finite());
            match value.map(|_| convert(field, scale)) {
                Some(value) if value.abs() <= LARGEST => Ok(value),
                Some(_) => Err(Slip {
                    range: field_at(text, start, column),
                    message: format!(
                        "expected a number between -{LARGEST:e} and {LARGEST:e} in SI, got \"{}\"",
                        shown(field)
                    ),
                    help: None,
                }),
                None => Err(Slip {
                    range: field_at(text, start, column),
                    message: format!("expected a number, got \"{}\"", shown(field)),
                    help: Some(
                        number_help(field)
                            .unwrap_or("numbers without units; the unit can be in the header of the column")
                            .to_owned(),
                    ),
                }),
            }
        };
        let mut row = [0.0; N];
        for (value, column) in row.iter_mut().zip(columns) {
            *value = number(column)?;
        }
        rows.push(row);
    }
    if rows.is_empty() {
        let range = line_at(text, start_of(text, &csv::StringRecord::new()));
        let message = "expected rows of numbers below the names of the columns, got none".to_owned();
        return Err(Slip { range, message, help: None });
    }
    Ok(rows)
}

/// Returns the range of the line that begins at a byte.
fn line_at(text: &str, start: usize) -> Range<usize> {
    start..start + text[start..].lines().next().unwrap_or("").len()
}

/// Returns the range of the header of a column.
pub(super) fn head(text: &str, column: usize) -> Range<usize> {
    // The first record is the header line.
    field_at(text, start_of(text, &csv::StringRecord::new()), column)
}

/// Returns the range of a cell by data row and column.
pub(super) fn cell(text: &str, row: usize, column: usize) -> Option<Range<usize>> {
    let record = reader(text).into_records().nth(row)?.ok()?;
    Some(field_at(text, start_of(text, &record), column))
}

fn reader(text: &str) -> csv::Reader<&[u8]> {
    let mut builder = csv::ReaderBuilder::new();
    builder.trim(csv::Trim::All).comment(Some(b'#')).flexible(true).from_reader(text.as_bytes())
}

/// Returns the start of a record, without preceding comments and blank lines, which the CSV reader includes.
fn start_of(text: &str, record: &csv::StringRecord) -> usize {
    let noted = record.position().map_or(0, csv::Position::byte) as usize;
    let mut start = noted.min(text.len());
    for line in text[start..].split_inclusive('\n') {
        if !line.starts_with('#') && !line.trim_end_matches(['\r', '\n']).is_empty() {
            break;
        }
        start += line.len();
    }
    start
}

/// Returns the range of a field of a record, without the blanks around it.
fn field_at(text: &str, start: usize, column: usize) -> Range<usize> {
    let (mut field, mut from, mut quoted, mut after_quote) = (0, start, false, false);
    let mut end = text.len();
    for (i, byte) in text.bytes().enumerate().skip(start) {
        match byte {
            b'"' if quoted => quoted = false,
            // A quote at the start of a field opens it; two quotes stand for one.
            b'"' => quoted = i == from || after_quote,
            b',' if !quoted && field < column => (field, from) = (field + 1, i + 1),
            b',' | b'\n' if !quoted => {
                end = i;
                break;
            }
            _ => {}
        }
        after_quote = byte == b'"' && !quoted;
    }
    let whole = &text[from..end];
    let before = whole.len() - whole.trim_start().len();
    from + before..from + before + whole.trim().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "# measured\n time ,\"x, m\",note\r\n\r\n# more\n 0, 1e-6 ,\"a \"\"b\"\"\nc\"\n1 ,2, d\n";

    const SI: [(usize, Scale); 2] = [(0, Scale::Ten(0)), (1, Scale::Ten(0))];

    #[test]
    fn numbers_have_the_bits_of_their_literals_in_any_unit() {
        let columns = [(0, Scale::Ten(-3)), (1, Scale::Ten(-6))];
        assert_eq!(
            numbers("t,x\n.5,1.7E2\n+3,-1e-2\n", columns, 2).unwrap(),
            [[0.5e-3, 1.7e-4], [3e-3, -1e-8]]
        );
        assert!(numbers("t,x\n1,1e308\n", [(0, Scale::Ten(0)), (1, Scale::Ten(6))], 2).is_err());
        assert_eq!(&TEXT[head(TEXT, 0)], "time");
        assert_eq!(&TEXT[head(TEXT, 1)], "\"x, m\"");
    }

    #[test]
    fn cells_are_read_and_found() {
        assert_eq!(header(TEXT).unwrap(), ["time", "x, m", "note"]);
        assert_eq!(numbers(TEXT, SI, 3).unwrap(), [[0.0, 1e-6], [1.0, 2.0]]);
        let found = |row, column| &TEXT[cell(TEXT, row, column).unwrap()];
        assert_eq!([found(0, 0), found(0, 1), found(0, 2)], ["0", "1e-6", "\"a \"\"b\"\"\nc\""]);
        assert_eq!([found(1, 0), found(1, 1), found(1, 2)], ["1", "2", "d"]);
        assert_eq!(cell(TEXT, 2, 0), None);
    }

    #[test]
    fn what_is_no_number_is_pointed_at() {
        let slip = |text: &str, width| {
            let slip = numbers(text, SI, width).unwrap_err();
            (text[slip.range].to_owned(), slip.message)
        };
        let number = |got: &str| (got.to_owned(), format!("expected a number, got \"{got}\""));
        assert_eq!(slip("t,x\n0,0\n1, far \n", 2), number("far"));
        assert_eq!(slip("t,x\n0,0\n\n#\n1,nan\n", 2), number("nan"));
        assert_eq!(slip("t,x\n0,1e999", 2), number("1e999"));
        assert_eq!(slip("t,x\n0,\n", 2), number(""));
        let fields = ("0,5,1".to_owned(), "expected 2 fields like the first line, got 3".to_owned());
        assert_eq!(slip("t,x\n0,5,1\n", 2), fields);
        assert_eq!(header("").unwrap_err().range, 0..1);
        assert!(header("\n# only\n").is_err());
    }
}
