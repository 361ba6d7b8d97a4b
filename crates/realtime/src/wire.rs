//! A packet, byte by byte: the same for inputs and outputs, everything little-endian.
//!
//! | bytes | what |
//! | --- | --- |
//! | 0–3 | `sslp` |
//! | 4–5 | version, u16: 1 |
//! | 6–7 | number of values n, u16 |
//! | 8–15 | scenario, u64: tells it from all others |
//! | 16–23 | sequence number, u64 |
//! | 24–31 | time stamp, f64: simulated time, s |
//! | 32–… | n values, f64, SI |

use std::iter;

/// How every packet begins.
pub const MAGIC: [u8; 4] = *b"sslp";
/// Version of the packets.
pub const VERSION: u16 = 1;
/// Bytes before the values.
pub const HEAD: usize = 32;
/// Bytes of a word.
const WORD: usize = 8;
/// Words before the values: magic with version and number, scenario, sequence, time.
pub(crate) const HEAD_WORDS: usize = HEAD / WORD;
/// Most values of a packet: 1 232 bytes go over any network in one piece.
pub const MOST_VALUES: usize = 150;

/// What a packet says besides its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stamp {
    /// Counted by whoever sends.
    pub sequence: u64,
    /// Of outputs: simulated time of the values, s. Of inputs: that of the outputs that they answer.
    pub time: f64,
}

/// Why bytes are no packet for this loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misfit {
    /// Too long or too short for the values.
    Length,
    /// It does not begin as packets do, has another version, or its own number of values is wrong.
    Foreign,
    /// Another scenario's.
    Scenario,
}

/// Bytes of a packet of so many values.
pub const fn length(values: usize) -> usize {
    HEAD + WORD * values
}

/// Writes a packet into bytes of its [`length`].
pub fn encode(bytes: &mut [u8], scenario: u64, stamp: Stamp, values: &[f64]) {
    let words = words(scenario, stamp, values);
    for (bytes, word) in bytes.chunks_exact_mut(WORD).zip(words) {
        bytes.copy_from_slice(&word.to_le_bytes());
    }
}

/// Place of the sequence number among the words of a packet.
pub(crate) const SEQUENCE: usize = 2;

/// The words of a packet.
pub(crate) fn words(scenario: u64, stamp: Stamp, values: &[f64]) -> impl Iterator<Item = u64> {
    let head = [first_word(values.len()), scenario, stamp.sequence, stamp.time.to_bits()];
    head.into_iter().chain(values.iter().map(|value| value.to_bits()))
}

/// Magic, version and number of values.
fn first_word(values: usize) -> u64 {
    let magic = u64::from(u32::from_le_bytes(MAGIC));
    // A loop has at most [`MOST_VALUES`].
    magic | u64::from(VERSION) << 32 | (values as u64 & 0xffff) << 48
}

/// Reads a packet of as many values as there is room for.
///
/// # Errors
/// Whatever does not fit; `values` may have been written to.
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

/// The same from words, of which there are enough.
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

    /// Written by hand, from the table above.
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
