//! Files that a separate thread writes during a real-time loop. The loop itself does not access the files, and the memory is limited.

use crate::ring::Ring;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Interval at which the writer thread looks for new records.
const LOOK: Duration = Duration::from_millis(2);
/// Capacity of the buffer between loop and writer thread, in words: 4 MiB.
const ROOM: usize = 1 << 19;

/// File format of the records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Binary words, little-endian.
    Binary,
    /// Comma-separated integers, one line per record.
    Csv,
}

/// Sender of records, used by the loop.
pub struct Tape {
    ring: Arc<Ring>,
    /// Number of lost records.
    lost: u64,
    /// Whether the loop waits if the buffer is full.
    waits: bool,
}

/// Receiver of records, used by the writer thread.
pub struct Reel<'a> {
    ring: Arc<Ring>,
    width: usize,
    form: Form,
    to: Box<dyn Write + Send + 'a>,
    failure: Option<io::Error>,
}

/// Creates a tape for records of `width` words.
pub fn tape<'a>(width: usize, form: Form, to: impl Write + Send + 'a) -> (Tape, Reel<'a>) {
    let ring = Arc::new(Ring::new(width, ROOM / width.max(1)));
    let reel = Reel { ring: Arc::clone(&ring), width, form, to: Box::new(to), failure: None };
    (Tape { ring, lost: 0, waits: false }, reel)
}

impl Tape {
    /// Makes the sender wait if the buffer is full, for loops without pacing. A writer thread must be writing the records.
    pub(crate) fn wait(&mut self) {
        self.waits = true;
    }

    /// Adds a record. If the buffer is full, the call waits or counts the record as lost.
    #[inline]
    pub fn put(&mut self, record: impl Iterator<Item = u64>) {
        while self.waits && self.ring.is_full() {
            std::thread::yield_now();
        }
        if !self.ring.push(record) {
            self.lost += 1;
        }
    }

    /// Returns the number of lost records.
    pub fn lost(&self) -> u64 {
        self.lost
    }
}

impl Reel<'_> {
    /// Writes at most as many buffered records as the buffer can hold, and returns whether there may be more.
    ///
    /// With this limit, a fast loop does not keep the writer thread from writing other files. After a write error, records are discarded.
    fn wind(&mut self, record: &mut Vec<u64>) -> bool {
        record.resize(self.width, 0);
        for _ in 0..self.ring.room() {
            if !self.ring.take(record) {
                return false;
            }
            if self.failure.is_none() {
                self.failure = self.write(record).err();
            }
        }
        true
    }

    fn write(&mut self, record: &[u64]) -> io::Result<()> {
        match self.form {
            Form::Binary => record.iter().try_for_each(|word| self.to.write_all(&word.to_le_bytes())),
            Form::Csv => {
                for (place, word) in record.iter().enumerate() {
                    write!(self.to, "{}{word}", if place == 0 { "" } else { "," })?;
                }
                writeln!(self.to)
            }
        }
    }

    /// Returns the first write error.
    pub fn failure(&self) -> Option<&io::Error> {
        self.failure.as_ref()
    }
}

/// Writes records until the loop has ended and all records are written. Meanwhile, `look` is called at regular intervals.
pub(crate) fn write_down(reels: &mut [Reel<'_>], over: &AtomicBool, look: &dyn Fn()) {
    let mut record = Vec::new();
    loop {
        // The flag is read first, so that records added before the end are written below.
        let is_over = over.load(Ordering::Acquire);
        let mut more = false;
        for reel in &mut *reels {
            more |= reel.wind(&mut record);
        }
        look();
        if is_over {
            break;
        }
        if !more {
            std::thread::sleep(LOOK);
        }
    }
    for reel in reels {
        let flushed = reel.to.flush();
        reel.failure = reel.failure.take().or(flushed.err());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A writer that adds a record to the ring for each record written, a given number of times.
    struct Refilled(Arc<Ring>, u64);

    impl Write for Refilled {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.1 > 0 && self.0.push([0].into_iter()) {
                self.1 -= 1;
            }
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_turn_of_one_reel_ends_although_the_loop_keeps_filling_it() {
        let ring = Arc::new(Ring::new(1, 8));
        let to = Box::new(Refilled(Arc::clone(&ring), 100));
        let mut reel = Reel { ring: Arc::clone(&ring), width: 1, form: Form::Binary, to, failure: None };
        assert!(ring.push([0].into_iter()));
        let (mut record, mut turns) = (Vec::new(), 1);
        while reel.wind(&mut record) {
            turns += 1;
        }
        // A hundred and one records, eight per call.
        assert_eq!((turns, ring.take(&mut record)), (13, false));
    }
}
