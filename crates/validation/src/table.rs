//! Tables and paragraphs in Markdown.

use std::fmt::Write;

/// A table with a header; all columns except the first are numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    /// Text above the table.
    pub(crate) caption: String,
    pub(crate) heads: Vec<&'static str>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(caption: &str, heads: &[&'static str]) -> Self {
        Self { caption: caption.to_owned(), heads: heads.to_vec(), rows: Vec::new() }
    }

    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    pub(crate) fn markdown(&self) -> String {
        let mut text = format!("{}\n\n| {} |\n|", self.caption, self.heads.join(" | "));
        for (place, _) in self.heads.iter().enumerate() {
            text += if place == 0 { " --- |" } else { " ---: |" };
        }
        text.push('\n');
        for row in &self.rows {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "| {} |", row.join(" | "));
        }
        text
    }
}

/// Formats a number with significant digits: in fixed notation if that is short, otherwise with an exponent.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let after = digits.saturating_sub(1);
    let long = format!("{value:.after$e}");
    let exponent: i32 = long.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
    match exponent {
        -3..=5 => format!("{value:.*}", usize::try_from(after as i32 - exponent).unwrap_or(0)),
        // "2e-1" replaces "2.0e-1" if the omitted digits are zeros.
        _ => long.replacen(&format!(".{}e", "0".repeat(after)), "e", 1),
    }
}

/// Formats a number with decimal places, without a sign if it rounds to zero.
pub(crate) fn places(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        text.replace('-', "")
    } else {
        text
    }
}

/// Breaks paragraphs, separated by blank lines, into lines. Fenced blocks are unchanged.
pub(crate) fn wrapped(text: &str) -> String {
    let paragraph = |text: &str| {
        if text.starts_with("```") {
            return text.to_owned();
        }
        let (mut lines, mut length) = (String::new(), 0);
        for word in text.split_whitespace() {
            let more = word.chars().count() + 1;
            if length > 0 && length + more > WIDTH {
                lines.push('\n');
                length = 0;
            } else if length > 0 {
                lines.push(' ');
            }
            lines += word;
            length += more;
        }
        lines
    };
    text.split("\n\n").map(paragraph).collect::<Vec<_>>().join("\n\n")
}

/// Maximum number of characters per line.
const WIDTH: usize = 121;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        let cases = [
            (0.020_000_1, 4, "0.02000"),
            (1234.5, 3, "1234"),
            (3.042e-6, 4, "3.042e-6"),
            (1e-10, 2, "1e-10"),
            (-0.5, 2, "-0.50"),
            (0.0, 3, "0"),
        ];
        for (value, digits, text) in cases {
            assert_eq!(significant(value, digits), text);
        }
        assert_eq!((places(-1e-9, 3), places(-0.5, 1)), ("0.000".to_owned(), "-0.5".to_owned()));
    }

    #[test]
    fn paragraphs_are_broken_and_commands_are_not() {
        let word = "abcdefghi";
        let long = [word; 13].join(" ");
        let text = format!("{long}\n\n```sh\na  b\n```\n\nc\nd");
        let line = [word; 12].join(" ");
        assert_eq!(wrapped(&text), format!("{line}\n{word}\n\n```sh\na  b\n```\n\nc d"));
    }

    #[test]
    fn a_table_lines_up_its_numbers() {
        let mut table = Table::new("Them:", &["case", "d"]);
        table.row(["a".to_owned(), "1".to_owned()]);
        assert_eq!(table.markdown(), "Them:\n\n| case | d |\n| --- | ---: |\n| a | 1 |\n");
    }
}
