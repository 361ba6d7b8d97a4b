//! SHA-256 of a table, computed in a separate thread while the table is written.
//!
//! On processors without SHA instructions, hashing takes longer than the simulation. Therefore a separate thread hashes the blocks of every
//! table with more than one block. The run waits for this thread only at its end.

use crate::seal::Digester;
use std::io;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Maximum number of blocks in the queue. If the queue is full, the run waits.
const WAITING: usize = 8;

/// Digest of a table that is being written.
#[derive(Debug, Default)]
pub(crate) struct Digest {
    /// Digest of the blocks that were written before the hashing thread was started.
    here: Digester,
    beside: Option<Beside>,
}

/// The hashing thread.
#[derive(Debug)]
struct Beside {
    full: SyncSender<Vec<u8>>,
    /// Blocks that have been hashed. The memory of these blocks is reused.
    hashed: Receiver<Vec<u8>>,
    thread: JoinHandle<Digester>,
}

impl Digest {
    /// Hashes a block and returns an empty block. A table with a single block is hashed without a thread.
    pub(crate) fn take(&mut self, mut block: Vec<u8>, is_last: bool) -> Vec<u8> {
        if self.beside.is_none() && !is_last {
            self.beside = Beside::begin(self.here.clone());
        }
        match &self.beside {
            Some(beside) => {
                let next = beside.hashed.try_recv().unwrap_or_else(|_| Vec::with_capacity(block.capacity()));
                // If the thread has ended, `finish` reports it.
                let _ = beside.full.send(block);
                next
            }
            // If no thread can be started, the block is hashed here.
            None => {
                self.here.update(&block);
                block.clear();
                block
            }
        }
    }

    /// Returns the number of bytes and their digest in hexadecimal digits.
    ///
    /// # Errors
    /// The thread has panicked.
    pub(crate) fn finish(self) -> io::Result<(u64, String)> {
        let Some(Beside { full, hashed, thread }) = self.beside else { return Ok(self.here.finish()) };
        drop((full, hashed));
        let digester = thread.join().map_err(|_| io::Error::other("the hash of a table was lost"))?;
        Ok(digester.finish())
    }
}

impl Beside {
    /// Starts a thread that continues a digest.
    fn begin(mut digester: Digester) -> Option<Self> {
        let (full, blocks) = sync_channel::<Vec<u8>>(WAITING);
        let (back, hashed) = channel();
        let hash = move || {
            for mut block in blocks {
                digester.update(&block);
                block.clear();
                // The receiver may have been dropped at the end of the table.
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
