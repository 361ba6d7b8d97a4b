//! Incremental computation of a fingerprint.

use super::{ColumnPrint, Fingerprint, TablePrint};
use crate::columns::Columns;
use std::fmt::Write;
use stickslip_drive::{Channel, state_name};

/// Maximum number of blocks of a table. When a table reaches this number, neighbouring blocks are merged, and the block size doubles.
pub(super) const MOST_BLOCKS: usize = 64;
/// Multiplier of the polynomial digest. The multiplier has an inverse modulo 2⁶⁴, so no bit of earlier values is lost.
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

/// Fingerprint under construction.
#[derive(Debug, Clone)]
pub struct Sketch {
    columns: Columns,
    trace: TableSketch,
    events: TableSketch,
}

/// Fingerprint of a table under construction. Digests are stored block by block, and within a block in the order of the columns.
#[derive(Debug, Clone)]
struct TableSketch {
    names: Vec<String>,
    rows: u64,
    block: u64,
    starts: Vec<f64>,
    full: Vec<u64>,
    /// Digests of the current block and the number of its rows.
    current: Vec<u64>,
    filled: u64,
}

impl Sketch {
    /// Creates an empty fingerprint for tables with these columns.
    pub fn new(columns: Columns) -> Self {
        let channels = columns.channels();
        let names: Vec<&str> = channels.iter().map(|channel| channel.name.as_str()).collect();
        let (time, rest) = names.split_at(names.len().min(1));
        let words: &[&str] = if names.is_empty() { &[] } else { &["source", "kind"] };
        let (trace, events) = (TableSketch::new(&names), TableSketch::new(&[time, words, rest].concat()));
        Self { columns, trace, events }
    }

    /// Adds a row of the trace.
    pub fn row(&mut self, values: &[f64]) {
        self.trace.push(self.columns.of(values).map(digest));
    }

    /// Adds an event: its source and kind, and the channel values directly after it.
    pub fn event(&mut self, words: [&str; 2], values: &[f64]) {
        let mut values = self.columns.of(values).map(digest);
        let time = values.next();
        let words = words.map(|word| (0.0, of_word(word)));
        self.events.push(time.into_iter().chain(words).chain(values));
    }

    /// Returns the fingerprint of all rows so far.
    pub fn finish(&self) -> Fingerprint {
        Fingerprint { trace: self.trace.finish(), events: self.events.finish() }
    }
}

/// Returns a value with its digest.
fn digest((value, channel): (f64, &Channel)) -> (f64, u64) {
    (value, if channel.is_state { of_word(state_name(value)) } else { of_number(value) })
}

/// Returns the digest of a number. All NaN values have the same digest, because tables contain the same text for them.
fn of_number(value: f64) -> u64 {
    mixed(if value.is_nan() { f64::NAN } else { value }.to_bits())
}

fn of_word(word: &str) -> u64 {
    word.bytes().fold(word.len() as u64, |digest, byte| mixed(digest ^ u64::from(byte)))
}

/// Mixes the bits of a value. The function is invertible, and every input bit affects about half of the output bits.
///
/// The function is the finaliser of Steele, Lea, Flood, *Fast splittable pseudorandom number generators* (2014).
fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// Returns the digest of two consecutive blocks from their digests. The second block has `rows` rows.
fn joined(first: u64, second: u64, rows: u64) -> u64 {
    let (mut power, mut base, mut rest) = (1_u64, FACTOR, rows);
    while rest > 0 {
        if rest % 2 == 1 {
            power = power.wrapping_mul(base);
        }
        base = base.wrapping_mul(base);
        rest /= 2;
    }
    first.wrapping_mul(power).wrapping_add(second)
}

impl TableSketch {
    fn new(names: &[&str]) -> Self {
        Self {
            names: names.iter().map(|name| (*name).to_owned()).collect(),
            rows: 0,
            block: 1,
            starts: Vec::new(),
            full: Vec::new(),
            current: vec![0; names.len()],
            filled: 0,
        }
    }

    /// Adds a row of values with their digests, the time first.
    fn push(&mut self, row: impl Iterator<Item = (f64, u64)>) {
        for (place, (digest, (value, next))) in self.current.iter_mut().zip(row).enumerate() {
            *digest = digest.wrapping_mul(FACTOR).wrapping_add(next);
            if place == 0 && self.filled == 0 {
                self.starts.push(value);
            }
        }
        self.rows += 1;
        self.filled += 1;
        if self.filled == self.block {
            self.full.extend(&self.current);
            self.current.fill(0);
            self.filled = 0;
            if self.starts.len() == MOST_BLOCKS {
                (self.starts, self.full) = halved(&self.starts, &self.full, (self.block, self.block));
                self.block *= 2;
            }
        }
    }

    fn finish(&self) -> TablePrint {
        let mut digests = self.full.clone();
        if self.filled > 0 {
            digests.extend(&self.current);
        }
        let width = self.names.len();
        let column = |(place, name): (usize, &String)| ColumnPrint {
            name: name.clone(),
            digests: digests.iter().skip(place).step_by(width).fold(String::new(), |mut text, digest| {
                // Writing to a string cannot fail.
                let _ = write!(text, "{digest:016x}");
                text
            }),
        };
        let columns = self.names.iter().enumerate().map(column).collect();
        TablePrint { rows: self.rows, block: self.block, starts: self.starts.clone(), columns }
    }
}

/// Merges neighbouring blocks. `rows` contains the numbers of rows of a full block and of the last block.
pub(super) fn halved(starts: &[f64], digests: &[u64], rows: (u64, u64)) -> (Vec<f64>, Vec<u64>) {
    let blocks = starts.len();
    let width = digests.len() / blocks.max(1);
    let mut joint = Vec::with_capacity(digests.len().div_ceil(2));
    for (pair, block) in digests.chunks(2 * width.max(1)).enumerate() {
        let (first, second) = block.split_at(width);
        let length = if 2 * pair + 2 == blocks { rows.1 } else { rows.0 };
        match second {
            [] => joint.extend(first),
            second => joint.extend(first.iter().zip(second).map(|(a, b)| joined(*a, *b, length))),
        }
    }
    (starts.iter().copied().step_by(2).collect(), joint)
}
