//! The file `state` with the state of a run and all data for its resumption.
//!
//! Every format starts with a magic string, the format version (u32), the file length (u64) and the program. The contents of [`Stub`]
//! follow, and finally the SHA-256 of all preceding bytes. Numbers are little-endian. Texts and byte lists are preceded by their length
//! (u64).

use super::error::CheckpointError;
use super::journal::Mark;
use crate::program::this_program;
use sha2::{Digest, Sha256};
use std::path::Path;

const MAGIC: &[u8] = b"stickslip checkpoint\n";
/// Format version that this program reads and writes.
const FORM: u32 = 2;
/// Offset of the file length.
const LENGTH: usize = MAGIC.len() + 4;
/// Size of a digest, in bytes.
const DIGEST: usize = 32;

/// Contents of the state file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stub {
    /// Name of the run.
    pub(super) name: String,
    /// Hashes that [`model_key`](super::model_key) and `run_key` return for the scenario.
    pub(super) model_key: [u8; DIGEST],
    pub(super) run_key: [u8; DIGEST],
    /// Wall time between two checkpoints, s.
    pub(super) every: f64,
    /// Planned end of the run, s.
    pub(super) end: f64,
    /// Wall time of the run so far, s.
    pub(super) wall: f64,
    /// Length and digest of the journal.
    pub(super) mark: Mark,
    /// State of the run in binary form.
    pub(super) state: Vec<u8>,
}

impl Stub {
    /// Returns the contents of the state file.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(FORM.to_le_bytes());
        bytes.extend([0; 8]);
        text(&mut bytes, this_program().as_bytes());
        text(&mut bytes, self.name.as_bytes());
        bytes.extend([self.model_key, self.run_key].as_flattened());
        bytes.extend([self.every, self.end, self.wall].map(f64::to_le_bytes).as_flattened());
        bytes.extend(self.mark.length.to_le_bytes());
        bytes.extend(self.mark.digest);
        text(&mut bytes, &self.state);
        let length = (bytes.len() + DIGEST) as u64;
        bytes[LENGTH..LENGTH + 8].copy_from_slice(&length.to_le_bytes());
        let digest = Sha256::digest(&bytes);
        bytes.extend(digest);
        bytes
    }

    /// Decodes the contents of the state file at `path`.
    ///
    /// # Errors
    /// The file is not a complete checkpoint of this format.
    pub(super) fn from_bytes(bytes: &[u8], path: &Path) -> Result<Self, CheckpointError> {
        let path = || path.to_owned();
        let found = bytes.len() as u64;
        let short =
            |expected: usize| CheckpointError::Short { path: path(), expected: expected as u64, found };
        if !bytes.starts_with(&MAGIC[..MAGIC.len().min(bytes.len())]) {
            return Err(CheckpointError::Foreign(path()));
        }
        let mut reader = Reader { left: bytes.get(MAGIC.len()..).unwrap_or_default() };
        let head = reader.array().map(u32::from_le_bytes).zip(reader.array().map(u64::from_le_bytes));
        let Some((form, expected)) = head else { return Err(short(LENGTH + 8)) };
        if found < expected {
            return Err(CheckpointError::Short { path: path(), expected, found });
        }
        let program = reader.text();
        if form != FORM {
            let program = program.unwrap_or_else(|| "another program".to_owned());
            return Err(CheckpointError::Newer { path: path(), program });
        }
        let (all, digest) = bytes.split_at(bytes.len().saturating_sub(DIGEST));
        let whole = found == expected && form == FORM && Sha256::digest(all)[..] == *digest;
        match (program, reader.stub()) {
            (Some(program), _) if whole && program != this_program() => {
                Err(CheckpointError::OtherProgram { path: path(), program })
            }
            (Some(_), Some(stub)) if whole => Ok(stub),
            _ => Err(CheckpointError::Damaged(path())),
        }
    }
}

fn text(bytes: &mut Vec<u8>, text: &[u8]) {
    bytes.extend((text.len() as u64).to_le_bytes());
    bytes.extend(text);
}

/// Sequential reader of a file.
struct Reader<'a> {
    left: &'a [u8],
}

impl Reader<'_> {
    fn stub(&mut self) -> Option<Stub> {
        let stub = Stub {
            name: self.text()?,
            model_key: self.array()?,
            run_key: self.array()?,
            every: self.array().map(f64::from_le_bytes)?,
            end: self.array().map(f64::from_le_bytes)?,
            wall: self.array().map(f64::from_le_bytes)?,
            mark: Mark { length: self.array().map(u64::from_le_bytes)?, digest: self.array()? },
            state: self.list()?,
        };
        (self.left.len() == DIGEST).then_some(stub)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (array, rest) = self.left.split_first_chunk()?;
        self.left = rest;
        Some(*array)
    }

    fn list(&mut self) -> Option<Vec<u8>> {
        let length = usize::try_from(self.array().map(u64::from_le_bytes)?).ok()?;
        let (list, rest) = self.left.split_at_checked(length)?;
        self.left = rest;
        Some(list.to_vec())
    }

    fn text(&mut self) -> Option<String> {
        String::from_utf8(self.list()?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stub() -> Stub {
        let mark = Mark { length: 7, digest: [3; 32] };
        let state = b"where it stands".to_vec();
        Stub {
            name: "p1".to_owned(),
            model_key: [1; 32],
            run_key: [2; 32],
            every: 30.0,
            end: 2.0,
            wall: 1.5,
            mark,
            state,
        }
    }

    fn read(bytes: &[u8]) -> String {
        match Stub::from_bytes(bytes, Path::new("state")) {
            Ok(read) if read == stub() => "the same".to_owned(),
            Ok(_) => "another".to_owned(),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn what_is_read_is_what_was_written() {
        assert_eq!(read(&stub().to_bytes()), "the same");
    }

    #[test]
    fn no_part_of_a_checkpoint_is_taken_for_one() {
        let bytes = stub().to_bytes();
        for length in 0..bytes.len() {
            let said = read(&bytes[..length]);
            assert!(
                said.starts_with(&format!("state: is truncated: {length} bytes of ")),
                "{length}: {said}"
            );
        }
        let more = [&bytes[..], b"\0"].concat();
        assert!(read(&more).starts_with("state: is damaged"), "{}", read(&more));
    }

    #[test]
    fn no_byte_can_change_unnoticed() {
        let bytes = stub().to_bytes();
        for place in 0..bytes.len() {
            for change in [1, 0x80] {
                let mut changed = bytes.clone();
                changed[place] ^= change;
                assert!(!["the same", "another"].contains(&&*read(&changed)), "{place}");
            }
        }
    }

    #[test]
    fn what_a_later_program_wrote_is_told_from_what_is_damaged() {
        let mut bytes = stub().to_bytes();
        bytes[MAGIC.len()] = FORM.to_le_bytes()[0] + 1;
        let this = this_program();
        assert_eq!(
            read(&bytes),
            format!("state: written by {this} in a format that this program, {this}, does not know")
        );
        let mut bytes = stub().to_bytes();
        let place = LENGTH + 16 + this.len() - 1;
        bytes[place] = b'9';
        let all = bytes.len() - DIGEST;
        let digest = Sha256::digest(&bytes[..all]);
        bytes[all..].copy_from_slice(&digest);
        let other = format!("{}9", &this[..this.len() - 1]);
        assert!(
            read(&bytes)
                .starts_with(&format!("state: written by {other}, this is {this}: the results could"))
        );
        assert_eq!(read(b"%PDF"), "state: is not a checkpoint of stickslip");
    }
}
