//! Row counts and SHA-256 of tables, by which readers detect incomplete or changed tables.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::path::PathBuf;

/// Row count and SHA-256 of a table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema, Deserialize)]
pub struct Seal {
    /// number of rows of the table, without the header
    pub rows: u64,
    /// SHA-256 of the table. Commands that read the table reject another value.
    pub sha256: String,
}

/// Table file with its expected content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SealedTable {
    /// Path of the file.
    pub path: PathBuf,
    /// Row count and SHA-256. `None` while the run has no summary.
    pub seal: Option<Seal>,
}

impl From<PathBuf> for SealedTable {
    fn from(path: PathBuf) -> Self {
        Self { path, seal: None }
    }
}

/// Incremental SHA-256 with the number of bytes.
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

    /// Returns the number of bytes and their SHA-256 in hexadecimal digits.
    pub(crate) fn finish(&self) -> (u64, String) {
        (self.length, digits(&self.digest.clone().finalize()))
    }
}

/// Returns the SHA-256 of a text in hexadecimal digits.
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
