//! Serialisation of a state. A run from the read state gives identical bits, also in another process.
//!
//! | bytes | content |
//! | --- | --- |
//! | 8 | `stickslp` |
//! | 8 | version of the format |
//! | 32 | key of the model |
//! | 8 | number of words that follow |
//! | 8 each | words: numbers by their bits, counts, flags |
//! | 8 | CRC-32 of all preceding bytes |
//!
//! All words are little-endian. Properties of the model are not stored. Pieces of waveforms are stored by index, except supplied
//! or generated ones. Reading fails for states of other models and never panics.

mod generated;
mod read;
mod write;

use super::State;
use crate::Model;
use stickslip_contact::Words;
use thiserror::Error;

const MAGIC: [u8; 8] = *b"stickslp";
/// Version of the format.
const VERSION: u64 = 5;
/// Names of fixed-step steppers by number.
const FIXED: [&str; 3] = ["rk4", "verlet", "frames"];
/// Number of bytes before the words.
const HEAD: usize = 56;
/// Number of bytes in a word.
const WORD: usize = 8;

/// Reason why bytes are not a state of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum BytesError {
    /// The bytes do not begin with the format's name.
    #[error("this is not the state of a run")]
    Foreign,
    /// The format is newer than this program.
    #[error("the state has format {0}, this program reads up to {VERSION}")]
    Newer(u64),
    /// The format is older than this program supports.
    #[error("the state has format {0}, this program reads format {VERSION}")]
    Older(u64),
    /// The state belongs to another model.
    #[error("this is the state of a run of another scenario")]
    OtherModel,
    /// The number of bytes is wrong.
    #[error("the state has {got} bytes, expected {expected}")]
    Length {
        /// Number of bytes according to the header, or the size of the smallest state.
        expected: u64,
        /// Number of bytes given.
        got: u64,
    },
    /// The checksum is wrong.
    #[error("the state is damaged: its checksum does not match")]
    Damaged,
    /// The bytes are intact, but no run of this model could have this state.
    #[error("the state does not fit its scenario")]
    Unfit,
}

impl State {
    /// Returns the state as bytes, with a key that identifies its model.
    ///
    /// `key` is chosen by the caller, such as the hash of a scenario that the crate `stickslip-run` computes. Supplied inputs and commands
    /// of generators are included. Bytes are portable between machines; a run by the same build continues with identical bits.
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

    /// Reads a state of a model that [`Self::to_bytes`] wrote with the same key.
    ///
    /// # Errors
    ///
    /// [`BytesError`]: other content, another format or model, a wrong length, or damaged bytes.
    pub fn from_bytes(model: &Model, key: &[u8; 32], bytes: &[u8]) -> Result<Self, BytesError> {
        let words = words(key, bytes)?;
        let mut reader = Words::new(&words);
        let state = read::state(model, &mut reader).ok_or(BytesError::Unfit)?;
        if reader.is_empty() { Ok(state) } else { Err(BytesError::Unfit) }
    }
}

/// Checks header, key, length and checksum of the bytes, and returns their words.
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
    // A damaged header may contain any number.
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

/// Returns word `i`, if it exists.
fn word(bytes: &[u8], i: usize) -> Option<u64> {
    let bytes = bytes.get(i * WORD..(i + 1) * WORD)?;
    bytes.try_into().ok().map(u64::from_le_bytes)
}
