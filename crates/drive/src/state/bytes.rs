//! A state as bytes: plain data, from which a run goes on to the same bits in another process.
//!
//! | bytes | what |
//! | --- | --- |
//! | 8 | `stickslp` |
//! | 8 | version of the format |
//! | 32 | key of the model |
//! | 8 | number of words that follow |
//! | 8 each | words: numbers by their bits, counts, flags |
//! | 8 | CRC-32 of all before |
//!
//! Everything is little-endian. What the model holds is not inside: no stiffness, no limit, no place of a spring; pieces of
//! waveforms are their index, but for those that are supplied or generated. A reader takes words of this model only and refuses all others; none makes it panic.

mod generated;
mod read;
mod write;

use super::State;
use crate::Model;
use stickslip_contact::Words;
use thiserror::Error;

const MAGIC: [u8; 8] = *b"stickslp";
/// Version of the format: 2 counts the steps whose estimate missed, 3 has parts, one method more, and a driver's charge of strain,
/// 4 an implicit method, 5 one of few stages more.
const VERSION: u64 = 5;
/// Steppers at fixed step, by their number.
const FIXED: [&str; 3] = ["rk4", "verlet", "frames"];
/// Bytes before the words.
const HEAD: usize = 56;
/// Bytes of a word.
const WORD: usize = 8;

/// Why bytes are no state of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum BytesError {
    /// They begin otherwise.
    #[error("not the state of a run")]
    Foreign,
    /// Of a later program.
    #[error("the state has format {0}, this program reads up to {VERSION}")]
    Newer(u64),
    /// Of an earlier program.
    #[error("the state has format {0}, this program reads format {VERSION}")]
    Older(u64),
    /// Of another model.
    #[error("the state of a run of another scenario")]
    OtherModel,
    /// Some are missing, or too many.
    #[error("the state has {got} bytes where {expected} are expected")]
    Length {
        /// Bytes that its head tells of, or that a head has.
        expected: u64,
        /// Bytes there are.
        got: u64,
    },
    /// Their checksum is another one.
    #[error("the state is damaged: its checksum is not that of its bytes")]
    Damaged,
    /// Whole, but nothing that a run of this model could have left.
    #[error("the state does not fit its scenario")]
    Unfit,
}

impl State {
    /// The state as bytes, under a key that tells its model from all others.
    ///
    /// `key` is the caller's: a hash of whatever the model was made from, such as the crate `stickslip-run` makes of a
    /// scenario. What inputs have been supplied is inside, and what
    /// generators have been commanded. Bytes are read on any machine; to the same bits goes on whatever
    /// computes alike, which one build does.
    pub fn to_bytes(&self, model: &Model, key: &[u8; 32]) -> Vec<u8> {
        let mut words = Vec::new();
        write::state(self, model, &mut words);
        let mut bytes = Vec::with_capacity(HEAD + WORD * (words.len() + 1));
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(key);
        bytes.extend((words.len() as u64).to_le_bytes());
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let sum = u64::from(crc32fast::hash(&bytes));
        bytes.extend(sum.to_le_bytes());
        bytes
    }

    /// The state that [`Self::to_bytes`] wrote of a model under a key.
    ///
    /// # Errors
    ///
    /// Bytes of something else, of another format, of another model; too few, too many, damaged.
    pub fn from_bytes(model: &Model, key: &[u8; 32], bytes: &[u8]) -> Result<Self, BytesError> {
        let words = words(key, bytes)?;
        let mut reader = Words::new(&words);
        let state = read::state(model, &mut reader).ok_or(BytesError::Unfit)?;
        if reader.is_empty() { Ok(state) } else { Err(BytesError::Unfit) }
    }
}

/// The words of whole bytes under a key.
fn words(key: &[u8; 32], bytes: &[u8]) -> Result<Vec<u64>, BytesError> {
    let got = bytes.len() as u64;
    let short = BytesError::Length { expected: (HEAD + WORD) as u64, got };
    if !bytes.starts_with(&MAGIC[..bytes.len().min(MAGIC.len())]) {
        return Err(BytesError::Foreign);
    }
    let version = word(bytes, 1).ok_or(short)?;
    if version > VERSION {
        return Err(BytesError::Newer(version));
    }
    let (count, rest) = (word(bytes, 6).ok_or(short)?, bytes.get(HEAD..).ok_or(short)?);
    // What a damaged head asks for may be more than there is in the world.
    let expected = count.saturating_add(1).saturating_mul(WORD as u64).saturating_add(HEAD as u64);
    if expected != got {
        return Err(BytesError::Length { expected, got });
    }
    let (body, sum) = (&rest[..rest.len() - WORD], word(bytes, bytes.len() / WORD - 1));
    if sum != Some(u64::from(crc32fast::hash(&bytes[..bytes.len() - WORD]))) || version == 0 {
        return Err(BytesError::Damaged);
    }
    if version < VERSION {
        return Err(BytesError::Older(version));
    }
    if bytes[2 * WORD..6 * WORD] != key[..] {
        return Err(BytesError::OtherModel);
    }
    Ok((0..body.len() / WORD).filter_map(|i| word(body, i)).collect())
}

/// Word `i` of some bytes.
fn word(bytes: &[u8], i: usize) -> Option<u64> {
    let bytes = bytes.get(i * WORD..(i + 1) * WORD)?;
    bytes.try_into().ok().map(u64::from_le_bytes)
}
