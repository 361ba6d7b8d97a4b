//! Fingerprints of the tables of a run: a digest of every block of rows in every column.
//!
//! Runs with equal fingerprints have equal tables. Otherwise the first different block gives the time of the first difference.

mod sketch;

use serde::{Deserialize, Serialize};
use sketch::{MOST_BLOCKS, halved};
use thiserror::Error;

pub use sketch::Sketch;

/// Number of hexadecimal digits of a digest.
const DIGITS: usize = 16;

/// Fingerprint of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fingerprint {
    /// Fingerprint of the trace.
    pub trace: TablePrint,
    /// Fingerprint of the events.
    pub events: TablePrint,
}

/// Fingerprint of a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TablePrint {
    /// Number of rows.
    pub rows: u64,
    /// Number of rows per block, a power of two. The last block may have fewer rows.
    block: u64,
    /// Time of the first row of each block, s.
    starts: Vec<f64>,
    /// Columns, the time first.
    pub columns: Vec<ColumnPrint>,
}

/// Fingerprint of a column.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColumnPrint {
    name: String,
    /// Sixteen hexadecimal digits per block.
    digests: String,
}

/// A difference of two tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Kind of the difference.
    pub what: Differing,
    /// Time of the first row of the first different block, s.
    pub from: f64,
    /// Number of rows of the first different block.
    pub within: u64,
}

/// Kind of a difference.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Differing {
    /// The values of a column differ.
    Column(String),
    /// The second table lacks this column.
    Missing(String),
    /// Only the second table has this column.
    Added(String),
    /// The numbers of rows differ.
    Rows(u64, u64),
}

/// Error of reading a fingerprint.
#[derive(Debug, Error)]
pub enum FingerprintError {
    /// The text does not have the format of a fingerprint.
    #[error("{0}")]
    Form(#[from] serde_json::Error),
    /// The numbers in the fingerprint are inconsistent.
    #[error("its numbers are inconsistent")]
    Numbers,
}

impl Fingerprint {
    /// Returns the fingerprint as JSON text.
    pub fn text(&self) -> String {
        // Serialisation cannot fail. A time that is not finite becomes null, and reading this text fails.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Reads a fingerprint from the JSON text that [`Self::text`] returns.
    ///
    /// # Errors
    /// The text does not have the format of a fingerprint, or its numbers are inconsistent.
    pub fn parse(text: &str) -> Result<Self, FingerprintError> {
        let print: Self = serde_json::from_str(text)?;
        if print.trace.is_sound() && print.events.is_sound() {
            Ok(print)
        } else {
            Err(FingerprintError::Numbers)
        }
    }
}

impl TablePrint {
    fn is_sound(&self) -> bool {
        let blocks = self.starts.len();
        let fits = |column: &ColumnPrint| {
            column.digests.len() == DIGITS * blocks && column.digests.bytes().all(|b| b.is_ascii_hexdigit())
        };
        self.block.is_power_of_two()
            && blocks <= MOST_BLOCKS
            && self.rows.div_ceil(self.block) == blocks as u64
            && self.columns.iter().all(fits)
    }

    /// Returns the differences from another table, the earliest first.
    pub fn differences(&self, other: &Self) -> Vec<Difference> {
        let block = self.block.max(other.block);
        let [(starts, ours), (other_starts, others)] = [self, other].map(|print| print.in_blocks_of(block));
        let length =
            |rows: u64, place: usize| rows.saturating_sub((place as u64).saturating_mul(block)).min(block);
        // Number of leading blocks with equal numbers of rows in both tables.
        let common = (0..starts.len().min(other_starts.len()))
            .take_while(|&place| length(self.rows, place) == length(other.rows, place))
            .count();
        let at = |place: usize, what| {
            let start = starts.get(place).or(other_starts.get(place));
            let within = length(self.rows.max(other.rows), place);
            Difference { what, from: start.copied().unwrap_or(0.0), within }
        };
        let mut found = Vec::new();
        for (column, digests) in self.columns.iter().zip(&ours) {
            let same = other.columns.iter().position(|other| other.name == column.name);
            match same.and_then(|place| others.get(place)) {
                None => found.push(at(0, Differing::Missing(column.name.clone()))),
                Some(others) => {
                    let first = (0..common).find(|&place| digests.get(place) != others.get(place));
                    found.extend(first.map(|place| at(place, Differing::Column(column.name.clone()))));
                }
            }
        }
        let is_new = |column: &&ColumnPrint| !self.columns.iter().any(|ours| ours.name == column.name);
        let added = other.columns.iter().filter(is_new);
        found.extend(added.map(|column| at(0, Differing::Added(column.name.clone()))));
        if self.rows != other.rows {
            found.push(at(common, Differing::Rows(self.rows, other.rows)));
        }
        found.sort_by(|a, b| a.from.total_cmp(&b.from));
        found
    }

    /// Merges blocks to `rows` rows, at least the block size, and returns their start times and the digests of all columns.
    fn in_blocks_of(&self, rows: u64) -> (Vec<f64>, Vec<Vec<u64>>) {
        let mut starts = self.starts.clone();
        let digit = |column: &ColumnPrint| -> Vec<u64> {
            let digits = column.digests.as_bytes().chunks(DIGITS);
            let number =
                |digits| std::str::from_utf8(digits).ok().and_then(|text| u64::from_str_radix(text, 16).ok());
            digits.map(|digits| number(digits).unwrap_or(0)).collect()
        };
        let mut columns: Vec<Vec<u64>> = self.columns.iter().map(digit).collect();
        let mut block = self.block;
        while block < rows {
            let last = match self.rows % block {
                0 => block,
                rest => rest,
            };
            let halves: Vec<_> =
                columns.iter().map(|column| halved(&starts, column, (block, last))).collect();
            starts = starts.iter().copied().step_by(2).collect();
            columns = halves.into_iter().map(|(_, digests)| digests).collect();
            block *= 2;
        }
        (starts, columns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::Columns;
    use stickslip_drive::Channel;

    /// Returns the fingerprint of rows with a time, a position and a state.
    fn print(rows: &[[f64; 3]]) -> TablePrint {
        let names = ["time_s", "slider.x_m", "ball.state"];
        let channel = |name: &str| Channel { name: name.to_owned(), is_state: name.ends_with("state") };
        let mut sketch = Sketch::new(Columns::all(&names.map(channel)));
        rows.iter().for_each(|row| sketch.row(row));
        sketch.finish().trace
    }

    fn rows(count: u32) -> Vec<[f64; 3]> {
        (0..count).map(f64::from).map(|i| [0.5 * i, (0.1 * i).sin(), f64::from(i as u32 % 4)]).collect()
    }

    fn column(name: &str, from: f64, within: u64) -> Vec<Difference> {
        vec![Difference { what: Differing::Column(name.to_owned()), from, within }]
    }

    #[test]
    fn every_changed_value_is_found_in_its_column_and_block() {
        for (count, block) in [(1, 1), (63, 1), (64, 2), (200, 4), (1000, 16)] {
            let whole = rows(count);
            let before = print(&whole);
            assert!(before.differences(&print(&whole)).is_empty());
            for place in 0..count as usize {
                let start = place - place % block;
                let within = block.min(count as usize - start) as u64;
                let mut changed = whole.clone();
                changed[place][1] = f64::from_bits(changed[place][1].to_bits() + 1);
                let want = column("slider.x_m", 0.5 * start as f64, within);
                assert_eq!(before.differences(&print(&changed)), want, "{place} of {count}");
                changed = whole.clone();
                changed[place][2] = f64::from((place as u32 + 1) % 4);
                let want = column("ball.state", 0.5 * start as f64, within);
                assert_eq!(before.differences(&print(&changed)), want, "{place} of {count}");
            }
        }
    }

    #[test]
    fn changes_that_could_cancel_do_not() {
        let whole = rows(2000);
        let before = print(&whole);
        // Two signs changed in one block, two values exchanged, zeros of either sign.
        let mut signs = whole.clone();
        (signs[40][1], signs[41][1]) = (-signs[40][1], -signs[41][1]);
        assert_eq!(before.differences(&print(&signs)), column("slider.x_m", 16.0, 32));
        let mut swapped = whole.clone();
        (swapped[40][1], swapped[44][1]) = (swapped[44][1], swapped[40][1]);
        assert_eq!(before.differences(&print(&swapped)), column("slider.x_m", 16.0, 32));
        let mut zero = whole;
        zero[0][1] = -0.0;
        assert_eq!(before.differences(&print(&zero)), column("slider.x_m", 0.0, 32));
    }

    #[test]
    fn runs_of_other_lengths_are_compared_as_far_as_they_go() {
        // Blocks of 16 rows compared with blocks of 1, 2, 4 and 8 rows, the last ones incomplete.
        let whole = rows(1000);
        let long = print(&whole);
        for count in [1, 50, 64, 100, 129, 333, 511] {
            let short = print(&whole[..count]);
            let start = 0.5 * (count - count % 16) as f64;
            let want = |before, now| {
                vec![Difference { what: Differing::Rows(before, now), from: start, within: 16 }]
            };
            assert_eq!(short.differences(&long), want(count as u64, 1000), "{count}");
            assert_eq!(long.differences(&short), want(1000, count as u64), "{count}");
        }
        let mut changed = whole[..333].to_vec();
        changed[100][1] = 7.0;
        let found = print(&changed).differences(&long);
        assert_eq!(found[..1], column("slider.x_m", 48.0, 16));
        assert_eq!(found.len(), 2);
    }

    #[test]
    fn a_text_reads_back_and_a_damaged_one_does_not() {
        let (trace, events) = (print(&rows(300)), print(&rows(3)));
        let fingerprint = Fingerprint { trace, events };
        let text = fingerprint.text();
        assert_eq!(Fingerprint::parse(&text).unwrap(), fingerprint);
        for (from, to) in
            [("\"rows\":300", "\"rows\":400"), ("\"block\":8", "\"block\":0"), ("0.0,4.0,", "0.0,")]
        {
            assert!(text.contains(from), "{text}");
            let refused = Fingerprint::parse(&text.replacen(from, to, 1)).unwrap_err();
            assert!(matches!(refused, FingerprintError::Numbers), "{to}: {refused}");
        }
        assert!(matches!(Fingerprint::parse(&text[1..]), Err(FingerprintError::Form(_))));
        assert!(matches!(
            Fingerprint::parse(&text.replacen("rows", "lines", 1)),
            Err(FingerprintError::Form(_))
        ));
    }

    #[test]
    fn columns_that_come_and_go_are_named() {
        let (before, mut now) = (print(&rows(10)), print(&rows(10)));
        now.columns[1].name = "slider.z_m".to_owned();
        let found: Vec<Differing> = before.differences(&now).into_iter().map(|d| d.what).collect();
        let want = [Differing::Missing("slider.x_m".to_owned()), Differing::Added("slider.z_m".to_owned())];
        assert_eq!(found, want);
    }
}
