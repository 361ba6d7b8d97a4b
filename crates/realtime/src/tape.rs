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
    (Tape { ring, lost: 0 }, reel)
}

impl Tape {
    /// Puts a record on; counts it where there is no room.
    #[inline]
    pub fn put(&mut self, record: impl Iterator<Item = u64>) {
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
    /// Writes down what there is. After a failure what comes is thrown away: the loop goes on.
    fn wind(&mut self, record: &mut Vec<u64>) {
        record.resize(self.width, 0);
        while self.ring.take(record) {
            if self.failure.is_none() {
                self.failure = self.write(record).err();
            }
        }
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
        reels.iter_mut().for_each(|reel| reel.wind(&mut record));
        look();
        if is_over {
            break;
        }
        std::thread::sleep(LOOK);
    }
    for reel in reels {
        let flushed = reel.to.flush();
        reel.failure = reel.failure.take().or(flushed.err());
    }
}
