//! SHA-256 of what is written, block by block, computed beside the run.
//!
//! A processor that has no instructions for it executes more to hash a table of many rows than the whole run does to compute
//! and write it. So the blocks of a table that is longer than one go to a thread of their own, which the run does not wait for
//! until it ends.

use crate::seal::Digester;
use std::io;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Blocks that wait to be hashed before the run waits for the hash.
const WAITING: usize = 8;

/// The digest of a table that is being written.
#[derive(Debug, Default)]
pub(crate) struct Digest {
    /// Of the blocks before there was a thread.
    here: Digester,
    beside: Option<Beside>,
}

/// A thread that hashes.
#[derive(Debug)]
struct Beside {
    full: SyncSender<Vec<u8>>,
    /// Blocks that were hashed, to be filled again.
    hashed: Receiver<Vec<u8>>,
    thread: JoinHandle<Digester>,
}

impl Digest {
    /// Takes the next block; gives an empty one. The last block of a table may stay here, the others go beside.
    pub(crate) fn take(&mut self, mut block: Vec<u8>, is_last: bool) -> Vec<u8> {
        if self.beside.is_none() && !is_last {
            self.beside = Beside::begin(self.here.clone());
        }
        match &self.beside {
            Some(beside) => {
                let next = beside.hashed.try_recv().unwrap_or_else(|_| Vec::with_capacity(block.capacity()));
                // A thread that is gone is noticed at the end.
                let _ = beside.full.send(block);
                next
            }
            // Where no thread can be had the run takes longer.
            None => {
                self.here.update(&block);
                block.clear();
                block
            }
        }
    }

    /// Number of bytes, and their digest in hexadecimal digits.
    ///
    /// # Errors
    /// A thread that came to a bad end.
    pub(crate) fn finish(self) -> io::Result<(u64, String)> {
        let Some(Beside { full, hashed, thread }) = self.beside else { return Ok(self.here.finish()) };
        drop((full, hashed));
        let digester = thread.join().map_err(|_| io::Error::other("the hash of a table was lost"))?;
        Ok(digester.finish())
    }
}

impl Beside {
    /// Goes on from a digest.
    fn begin(mut digester: Digester) -> Option<Self> {
        let (full, blocks) = sync_channel::<Vec<u8>>(WAITING);
        let (back, hashed) = channel();
        let hash = move || {
            for mut block in blocks {
                digester.update(&block);
                block.clear();
                // Nobody fills it any more once the table has come to its end.
                let _ = back.send(block);
            }
            digester
        };
        let thread = Builder::new().name("hash".to_owned()).spawn(hash).ok()?;
        Some(Self { full, hashed, thread })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seal::hash;

    #[test]
    fn here_or_beside_a_digest_is_the_same() {
        for blocks in [0, 1, 2, 100] {
            let (mut digest, mut whole) = (Digest::default(), String::new());
            let mut block = Vec::new();
            for k in 0..blocks {
                let text = format!("{k},").repeat(k % 7 + 1);
                whole += &text;
                block.extend(text.as_bytes());
                block = digest.take(block, k + 1 == blocks);
                assert!(block.is_empty());
            }
            assert_eq!(digest.beside.is_some(), blocks > 1);
            assert_eq!(digest.finish().unwrap(), (whole.len() as u64, hash(&whole)));
        }
    }
}
