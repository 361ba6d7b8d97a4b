//! Seals: by them readers tell whether a table is the one that its run wrote, whole and unchanged.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::path::PathBuf;

/// What a summary says of a table beside it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema, Deserialize)]
pub struct Seal {
    /// lines of the table, without its head
    pub rows: u64,
    /// its SHA-256; readers refuse another
    pub sha256: String,
}

/// A table on disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SealedTable {
    /// Where it lies.
    pub path: PathBuf,
    /// Its seal; none while the run that writes it has no summary yet.
    pub seal: Option<Seal>,
}

impl From<PathBuf> for SealedTable {
    fn from(path: PathBuf) -> Self {
        Self { path, seal: None }
    }
}

/// A SHA-256 under way, with the number of bytes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Digester {
    digest: Sha256,
    length: u64,
}

impl Digester {
    pub(crate) fn update(&mut self, bytes: &[u8]) {
        self.digest.update(bytes);
        self.length += bytes.len() as u64;
    }

    /// Number of bytes, and their digest in hexadecimal digits.
    pub(crate) fn finish(&self) -> (u64, String) {
        (self.length, digits(&self.digest.clone().finalize()))
    }
}

/// SHA-256 of a text, in hexadecimal digits.
pub fn hash(text: &str) -> String {
    digits(&Sha256::digest(text.as_bytes()))
}

fn digits(digest: &[u8]) -> String {
    digest.iter().fold(String::new(), |mut digits, byte| {
        // Writing to a string cannot fail.
        let _ = write!(digits, "{byte:02x}");
        digits
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_sha_256() {
        // FIPS 180-2, appendix B.1.
        let known = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let mut digester = Digester::default();
        digester.update(b"a");
        digester.update(b"bc");
        assert_eq!((hash("abc"), digester.finish()), (known.to_owned(), (3, known.to_owned())));
    }
}
