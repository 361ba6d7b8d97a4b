//! Storage of the strides (motions of a body in one period) of a run: recent strides in memory, older ones in an unnamed temporary file.

use crate::{Stride, Strides};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Maximum number of strides in memory if older strides are stored in a file.
const MOST: usize = 1 << 13;
/// Size of a stride in the file, in bytes: six numbers.
const BYTES: usize = 48;
/// Stride of NaN values that replaces a stride that could not be read.
const UNREADABLE: Stride = Stride {
    start: f64::NAN,
    end: f64::NAN,
    least: f64::NAN,
    most: f64::NAN,
    fall: f64::NAN,
    rise: f64::NAN,
};

/// The strides of a run so far.
#[derive(Debug, Default)]
pub struct StrideList {
    /// Strides in memory.
    recent: Vec<Stride>,
    /// Number of strides in the file.
    spilled: usize,
    file: Option<Mutex<File>>,
    failure: Option<io::Error>,
    /// Largest magnitude of the step length, m.
    longest: f64,
}

impl StrideList {
    /// Sets the file that stores older strides. Without this file, all strides stay in memory.
    pub fn spill(&mut self, file: File) {
        self.file = Some(Mutex::new(file));
    }

    /// Appends a stride.
    pub fn push(&mut self, stride: Stride) {
        self.longest = self.longest.max(stride.length().abs());
        self.recent.push(stride);
        if self.recent.len() >= MOST
            && self.failure.is_none()
            && let Some(file) = &self.file
        {
            let numbers = self.recent.iter().flat_map(|s| [s.start, s.end, s.least, s.most, s.fall, s.rise]);
            let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            // The incomplete data of a failed write are overwritten.
            let end = SeekFrom::Start((BYTES * self.spilled) as u64);
            match file.seek(end).and_then(|_| file.write_all(&bytes)) {
                Ok(()) => {
                    self.spilled += self.recent.len();
                    self.recent.clear();
                }
                Err(failure) => self.failure = Some(failure),
            }
        }
    }

    /// Returns the error of the last failed write and clears it.
    pub fn take_failure(&mut self) -> Option<io::Error> {
        self.failure.take()
    }

    /// Returns the memory used, in bytes.
    pub fn bytes(&self) -> usize {
        self.recent.capacity() * size_of::<Stride>()
    }

    /// Returns the largest magnitude of the step length, m.
    pub fn longest(&self) -> f64 {
        self.longest
    }

    /// Returns the last stride.
    pub fn last(&self) -> Option<Stride> {
        let count = self.count();
        self.part(count.checked_sub(1)?..count).next()
    }

    /// Reads strides from the file.
    fn read(&self, range: Range<usize>) -> Vec<Stride> {
        let mut bytes = vec![0; BYTES * range.len()];
        let read = |file: &Mutex<File>| {
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            file.seek(SeekFrom::Start((BYTES * range.start) as u64))?;
            file.read_exact(&mut bytes)
        };
        match self.file.as_ref().map(read) {
            Some(Ok(())) => bytes.as_chunks::<BYTES>().0.iter().map(stride).collect(),
            _ => vec![UNREADABLE; range.len()],
        }
    }
}

fn stride(bytes: &[u8; BYTES]) -> Stride {
    let mut numbers = [0.0; 6];
    for (number, bytes) in numbers.iter_mut().zip(bytes.as_chunks::<8>().0) {
        *number = f64::from_le_bytes(*bytes);
    }
    let [start, end, least, most, fall, rise] = numbers;
    Stride { start, end, least, most, fall, rise }
}

impl Strides for StrideList {
    fn count(&self) -> usize {
        self.spilled + self.recent.len()
    }

    fn part(&self, range: Range<usize>) -> impl Iterator<Item = Stride> {
        let spilled = range.start.min(self.spilled)..range.end.min(self.spilled);
        let recent = range.start.max(self.spilled) - self.spilled..range.end.max(self.spilled) - self.spilled;
        let end = spilled.end;
        let blocks = spilled.step_by(MOST).map(move |start| start..(start + MOST).min(end));
        blocks
            .flat_map(|block| self.read(block))
            .chain(self.recent.get(recent).unwrap_or_default().iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_in_a_file_are_those_in_memory() {
        let stride = |k: usize| {
            let start = k as f64;
            Stride { start, end: start + 1.5, least: start - 0.1, most: start + 2.0, fall: 0.5, rise: 2.1 }
        };
        let (mut all, mut spilled) = (StrideList::default(), StrideList::default());
        spilled.spill(tempfile::tempfile().unwrap());
        let count = 3 * MOST + 100;
        for k in 0..count {
            all.push(stride(k));
            spilled.push(stride(k));
            assert!(spilled.recent.len() < MOST);
        }
        assert_eq!((all.count(), spilled.count(), spilled.last()), (count, count, Some(stride(count - 1))));
        let parts =
            [0..count, 0..0, 5..MOST + 7, MOST..2 * MOST, count - 3..count, 3 * MOST - 1..3 * MOST + 1];
        for part in parts {
            let want: Vec<Stride> = part.clone().map(stride).collect();
            assert_eq!(all.part(part.clone()).collect::<Vec<_>>(), want);
            assert_eq!(spilled.part(part).collect::<Vec<_>>(), want);
        }
        // Reading during the writing continues at the end of the file.
        spilled.push(stride(count));
        assert_eq!(spilled.last(), Some(stride(count)));
    }

    #[test]
    fn what_a_failed_write_has_left_is_written_over() {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(b"torn").unwrap();
        let mut strides = StrideList::default();
        strides.spill(file);
        let stride = Stride { start: 0.5, end: 1.0, least: 0.25, most: 2.0, fall: 1.0, rise: 1.75 };
        (0..MOST).for_each(|_| strides.push(stride));
        assert!(strides.recent.is_empty() && strides.part(0..MOST).all(|read| read == stride));
    }

    #[test]
    fn what_cannot_be_written_stays_in_memory_and_is_told() {
        let mut strides = StrideList::default();
        let unwritable = tempfile::NamedTempFile::new().unwrap();
        strides.spill(File::open(unwritable.path()).unwrap());
        let stride = Stride { start: 0.0, end: 1.0, least: 0.0, most: 1.0, fall: 0.0, rise: 1.0 };
        (0..MOST + 5).for_each(|_| strides.push(stride));
        assert_eq!(strides.count(), MOST + 5);
        assert!(strides.take_failure().is_some());
    }
}
