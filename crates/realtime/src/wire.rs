//! Format of the packets with inputs and outputs. All values are little-endian.
//!
//! | bytes | content |
//! | --- | --- |
//! | 0–3 | `sslp` |
//! | 4–5 | version, u16: 1 |
//! | 6–7 | number of values n, u16 |
//! | 8–15 | scenario number, u64 |
//! | 16–23 | sequence number, u64 |
//! | 24–31 | time stamp, f64: simulated time, s |
//! | 32–… | n values, f64, SI |

use std::iter;

/// First bytes of every packet.
pub const MAGIC: [u8; 4] = *b"sslp";
/// Version of the packet format.
pub const VERSION: u16 = 1;
/// Size of the header, in bytes.
pub const HEAD: usize = 32;
/// Size of a word, in bytes.
const WORD: usize = 8;
/// Number of words of the header: magic with version and number of values, scenario number, sequence number, time.
pub(crate) const HEAD_WORDS: usize = HEAD / WORD;
/// Maximum number of values of a packet. The resulting packet size of 1 232 bytes needs no fragmentation in usual networks.
pub const MOST_VALUES: usize = 150;

/// Sequence number and time of a packet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stamp {
    /// Sequence number, counted by the sender.
    pub sequence: u64,
    /// Simulated time, s. For outputs, it is the time of the values. For inputs, it is the time of the outputs to which they respond.
    pub time: f64,
}

/// Reason why a packet is not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misfit {
    /// The length of the packet does not fit the number of values.
    Length,
    /// The magic bytes, the version or the number of values is wrong.
    Foreign,
    /// The scenario number differs from that of the loop.
    Scenario,
}

/// Returns the size of a packet with `values` values, in bytes.
pub const fn length(values: usize) -> usize {
    HEAD + WORD * values
}

/// Writes a packet into a buffer, whose size must be its [`length`].
pub fn encode(bytes: &mut [u8], scenario: u64, stamp: Stamp, values: &[f64]) {
    let words = words(scenario, stamp, values);
    for (bytes, word) in bytes.chunks_exact_mut(WORD).zip(words) {
        bytes.copy_from_slice(&word.to_le_bytes());
    }
}

/// Index of the sequence number in the words of a packet.
pub(crate) const SEQUENCE: usize = 2;

/// Returns the words of a packet.
pub(crate) fn words(scenario: u64, stamp: Stamp, values: &[f64]) -> impl Iterator<Item = u64> {
    let head = [first_word(values.len()), scenario, stamp.sequence, stamp.time.to_bits()];
    head.into_iter().chain(values.iter().map(|value| value.to_bits()))
}

/// Returns the word with magic bytes, version and number of values.
fn first_word(values: usize) -> u64 {
    let magic = u64::from(u32::from_le_bytes(MAGIC));
    // A packet has at most [`MOST_VALUES`] values.
    magic | u64::from(VERSION) << 32 | (values as u64 & 0xffff) << 48
}

/// Reads a packet with `values.len()` values.
///
/// # Errors
/// The length, the format or the scenario number of the packet is wrong. `values` may be partly overwritten.
pub fn decode(bytes: &[u8], scenario: u64, values: &mut [f64]) -> Result<Stamp, Misfit> {
    if bytes.len() >= MAGIC.len() && bytes[..MAGIC.len()] != MAGIC {
        return Err(Misfit::Foreign);
    }
    if bytes.len() != length(values.len()) {
        return Err(Misfit::Length);
    }
    let mut words = bytes.chunks_exact(WORD).map(|bytes| {
        let mut word = [0; WORD];
        word.copy_from_slice(bytes);
        u64::from_le_bytes(word)
    });
    read(iter::from_fn(|| words.next()), scenario, values)
}

/// Reads a packet from words.
///
/// # Errors
/// The same errors as for [`decode`].
pub(crate) fn read(
    mut words: impl Iterator<Item = u64>,
    scenario: u64,
    values: &mut [f64],
) -> Result<Stamp, Misfit> {
    let mut next = || words.next().ok_or(Misfit::Length);
    if next()? != first_word(values.len()) {
        return Err(Misfit::Foreign);
    }
    if next()? != scenario {
        return Err(Misfit::Scenario);
    }
    let stamp = Stamp { sequence: next()?, time: f64::from_bits(next()?) };
    for value in values {
        *value = f64::from_bits(next()?);
    }
    Ok(stamp)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The expected bytes are written by hand from the table above.
    #[test]
    fn a_packet_is_what_the_table_says() {
        let mut bytes = [0; length(2)];
        let stamp = Stamp { sequence: 0x0102, time: 1.0 };
        encode(&mut bytes, 0x1122_3344_5566_7788, stamp, &[-2.0, 0.5]);
        let mut expected =
            b"sslp\x01\x00\x02\x00\x88\x77\x66\x55\x44\x33\x22\x11\x02\x01\0\0\0\0\0\0".to_vec();
        expected
            .extend([0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0xc0, 0, 0, 0, 0, 0, 0, 0xe0, 0x3f]);
        assert_eq!(bytes.to_vec(), expected);
        let mut values = [0.0; 2];
        assert_eq!(decode(&bytes, 0x1122_3344_5566_7788, &mut values), Ok(stamp));
        assert_eq!(values, [-2.0, 0.5]);
    }

    #[test]
    fn what_is_no_packet_is_told_from_what_is_for_another() {
        let (mut bytes, mut values) = ([0; length(1)], [0.0]);
        encode(&mut bytes, 7, Stamp { sequence: 1, time: 0.0 }, &[1.0]);
        assert_eq!(decode(&bytes, 8, &mut values), Err(Misfit::Scenario));
        for wrong in [&bytes[..39], &bytes[..3], &[], &[&bytes[..], &[0]].concat()] {
            assert_eq!(decode(wrong, 7, &mut values), Err(Misfit::Length));
        }
        for place in 0..8 {
            let mut wrong = bytes;
            wrong[place] ^= 0x10;
            assert_eq!(decode(&wrong, 7, &mut values), Err(Misfit::Foreign), "byte {place}");
        }
    }
}
