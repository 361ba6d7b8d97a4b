//! Layout of the shared memory with the inputs and outputs of a loop.
//!
//! | bytes | content |
//! | --- | --- |
//! | 0–7 | `sslpshm1` |
//! | 8–15 | scenario number, u64 |
//! | 16–23 | number of inputs n, u64 |
//! | 24–31 | number of outputs m, u64 |
//! | 32–39 | offset of the input record, u64: 64 |
//! | 40–47 | offset of the output record, u64: a multiple of 64 |
//! | 48–55 | period, s, f64 |
//! | 56–63 | 1 while a loop runs, 2 after its end, u64 |
//!
//! A record consists of a counter (u64), the number of the writing client (u64) and a packet (`wire`). The lowest bit of the counter is 1
//! while the record is written and 0 when it is complete (`seqlock`). All words have the byte order of the machine.

use crate::memory::{MemoryError, Shared};
use crate::plant::Output;
use crate::seqlock::{self, Found};
use crate::wire::{self, HEAD_WORDS, Stamp};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Mark at the start of the shared memory.
const MARK: u64 = u64::from_le_bytes(*b"sslpshm1");
/// Number of words of the header, and of a cache line. Records start at a cache line.
const LINE: usize = 8;
/// Number of words of a record before the values of its packet.
const RECORD: usize = 2 + HEAD_WORDS;
/// Index of the status word in the header.
const STATUS: usize = 7;

/// Shared memory of a loop.
pub struct Region {
    shared: Shared,
    scenario: u64,
    inputs: usize,
    outputs: usize,
}

/// Returns the path of the shared memory: a file in /dev/shm, or the name itself if it contains a slash.
pub fn path(name: &str) -> PathBuf {
    if name.contains('/') { PathBuf::from(name) } else { Path::new("/dev/shm").join(name) }
}

impl Region {
    /// Creates the shared memory.
    ///
    /// # Errors
    /// The same errors as for [`Shared::make`].
    pub fn make(
        path: &Path,
        (scenario, period): (u64, f64),
        inputs: usize,
        outputs: &[Output],
    ) -> Result<Arc<Self>, MemoryError> {
        let outputs = outputs.len();
        let region =
            Self { shared: Shared::make(path, MARK, length(inputs, outputs))?, scenario, inputs, outputs };
        let places = [LINE, outputs_at(inputs)].map(|word| 8 * word as u64);
        let head = [scenario, inputs as u64, outputs as u64, places[0], places[1], period.to_bits(), 1];
        let words = region.shared.words();
        words[1..].iter().zip(head).for_each(|(word, value)| word.store(value, Ordering::Relaxed));
        // The mark is written last, so that a client that reads the mark finds a complete header.
        words[0].store(MARK, Ordering::Release);
        Ok(Arc::new(region))
    }

    /// Returns the path of the file.
    pub(crate) fn path(&self) -> &Path {
        self.shared.path()
    }

    /// Returns whether the file has not been truncated.
    pub(crate) fn is_whole(&self) -> bool {
        self.shared.is_whole()
    }

    fn input(&self) -> &[AtomicU64] {
        &self.shared.words()[LINE..LINE + RECORD + self.inputs]
    }

    fn output(&self) -> &[AtomicU64] {
        let from = outputs_at(self.inputs);
        &self.shared.words()[from..from + RECORD + self.outputs]
    }

    /// Returns the number of words of the input record without its counter.
    pub(crate) fn input_words(&self) -> usize {
        RECORD - 1 + self.inputs
    }

    /// Reads the input record unless its counter is still `seen`.
    pub(crate) fn read(&self, seen: u64, record: &mut [u64]) -> Found {
        seqlock::read(self.input(), seen, record)
    }

    /// Releases the input record if a killed client left it incomplete. Returns whether the record was released.
    pub(crate) fn free(&self, counter: u64) -> bool {
        seqlock::free(self.input(), counter)
    }

    /// Writes the output record. Returns `false` if another process is writing the record, although only the loop may do so.
    pub(crate) fn write(&self, stamp: Stamp, values: &[f64]) -> bool {
        let words = wire::words(self.scenario, stamp, values);
        seqlock::write(self.output(), std::iter::once(0).chain(words))
    }
}

impl Drop for Region {
    fn drop(&mut self) {
        self.shared.words()[STATUS].store(2, Ordering::Release);
    }
}

/// Returns the index of the first word of the output record.
fn outputs_at(inputs: usize) -> usize {
    LINE + (RECORD + inputs).next_multiple_of(LINE)
}

/// Returns the total number of words of the shared memory.
fn length(inputs: usize, outputs: usize) -> usize {
    outputs_at(inputs) + (RECORD + outputs).next_multiple_of(LINE)
}
