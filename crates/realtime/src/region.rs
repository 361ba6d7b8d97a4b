//! Where inputs and outputs lie in shared memory.
//!
//! | bytes | what |
//! | --- | --- |
//! | 0–7 | `sslpshm1` |
//! | 8–15 | scenario, u64 |
//! | 16–23 | number of inputs n, u64 |
//! | 24–31 | number of outputs m, u64 |
//! | 32–39 | where the record of inputs begins, u64: 64 |
//! | 40–47 | where the record of outputs begins, u64: a multiple of 64 |
//! | 48–55 | period, s, f64 |
//! | 56–63 | 1 while a loop runs, 2 after its end, u64 |
//!
//! A record is a counter (u64), who writes (u64), and a packet (`wire`): the counter is odd while the rest is written and even
//! when it is whole (`seqlock`). All words are in the machine's own order, which is little-endian wherever this was tried.

use crate::memory::{MemoryError, Shared};
use crate::plant::Output;
use crate::seqlock::{self, Found};
use crate::wire::{self, HEAD_WORDS, Stamp};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// How the memory begins.
const MARK: u64 = u64::from_le_bytes(*b"sslpshm1");
/// Words of the head, and of a line of the cache: records begin at one.
const LINE: usize = 8;
/// Words of a record before its values.
const RECORD: usize = 2 + HEAD_WORDS;
/// Places in the head.
const STATUS: usize = 7;

/// The memory of a loop.
pub struct Region {
    shared: Shared,
    scenario: u64,
    inputs: usize,
    outputs: usize,
}

/// Where memory of a name lies: a file of /dev/shm, or the path that it is.
pub fn path(name: &str) -> PathBuf {
    if name.contains('/') { PathBuf::from(name) } else { Path::new("/dev/shm").join(name) }
}

impl Region {
    /// Makes it.
    ///
    /// # Errors
    /// As [`Shared::make`].
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
        // Who finds the mark finds the rest.
        words[0].store(MARK, Ordering::Release);
        Ok(Arc::new(region))
    }

    /// Where it lies.
    pub(crate) fn path(&self) -> &Path {
        self.shared.path()
    }

    /// Whether nobody has made its file shorter.
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

    /// Words of the record of inputs behind its counter.
    pub(crate) fn input_words(&self) -> usize {
        RECORD - 1 + self.inputs
    }

    /// Reads the record of inputs unless it is that of counter `seen`.
    pub(crate) fn read(&self, seen: u64, record: &mut [u64]) -> Found {
        seqlock::read(self.input(), seen, record)
    }

    /// Frees the record of inputs from a writer that was killed; whether it did.
    pub(crate) fn free(&self, counter: u64) -> bool {
        seqlock::free(self.input(), counter)
    }

    /// Writes the record of outputs; `false` where somebody else does, who should not.
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

/// The word at which the record of outputs begins.
fn outputs_at(inputs: usize) -> usize {
    LINE + (RECORD + inputs).next_multiple_of(LINE)
}

/// Words of all.
fn length(inputs: usize, outputs: usize) -> usize {
    outputs_at(inputs) + (RECORD + outputs).next_multiple_of(LINE)
}
