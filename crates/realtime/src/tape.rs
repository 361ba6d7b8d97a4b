//! What is written down while the loop runs, by a thread of its own: memory stays flat, and the loop never writes.

use crate::ring::Ring;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How often the thread looks.
const LOOK: Duration = Duration::from_millis(2);
/// Room between the loop and the thread, words in all: 4 MiB.
const ROOM: usize = 1 << 19;

/// How the words of a record are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As bytes, little-endian.
    Binary,
    /// As whole numbers with commas between them, a line for each record.
    Csv,
}

/// The loop's end of a tape.
pub struct Tape {
    ring: Arc<Ring>,
    /// Records for which there was no room.
    lost: u64,
    /// Whether a record waits for room.
    waits: bool,
}

/// The other end.
pub struct Reel<'a> {
    ring: Arc<Ring>,
    width: usize,
    form: Form,
    to: Box<dyn Write + Send + 'a>,
    failure: Option<io::Error>,
}

/// Makes a tape of records of so many words.
pub fn tape<'a>(width: usize, form: Form, to: impl Write + Send + 'a) -> (Tape, Reel<'a>) {
    let ring = Arc::new(Ring::new(width, ROOM / width.max(1)));
    let reel = Reel { ring: Arc::clone(&ring), width, form, to: Box::new(to), failure: None };
    (Tape { ring, lost: 0, waits: false }, reel)
}

impl Tape {
    /// From now on a record waits until there is room: for a loop that no clock drives, and whose reel is being wound.
    pub(crate) fn wait(&mut self) {
        self.waits = true;
    }

    /// Puts a record on; where there is no room it waits for some, or is counted.
    #[inline]
    pub fn put(&mut self, record: impl Iterator<Item = u64>) {
        while self.waits && self.ring.is_full() {
            std::thread::yield_now();
        }
        if !self.ring.push(record) {
            self.lost += 1;
        }
    }

    /// Records for which there was no room.
    pub fn lost(&self) -> u64 {
        self.lost
    }
}

impl Reel<'_> {
    /// Writes down what there is, but no more than the ring holds: a loop that fills it meanwhile must not keep the others waiting.
    /// Whether there may be more. After a failure what comes is thrown away: the loop goes on.
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

    /// Why not all was written.
    pub fn failure(&self) -> Option<&io::Error> {
        self.failure.as_ref()
    }
}

/// Writes everything down until the loop is over and all of it is written; `look` is called now and then.
pub(crate) fn write_down(reels: &mut [Reel<'_>], over: &AtomicBool, look: &dyn Fn()) {
    let mut record = Vec::new();
    loop {
        // Asked first: what was put on before the end is found below.
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

    /// A loop that puts a record on for each that is written, so many times.
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
        // A hundred and one records, eight a turn.
        assert_eq!((turns, ring.take(&mut record)), (13, false));
    }
}
