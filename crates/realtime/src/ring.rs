//! Lock-free ring buffer for records that the loop sends to a writer thread. Neither thread waits for the other.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// Ring buffer for one producer thread and one consumer thread.
pub(crate) struct Ring {
    words: Box<[AtomicU64]>,
    /// Number of words per record.
    width: usize,
    /// Capacity, in records.
    room: usize,
    /// Total numbers of records pushed and taken.
    pushed: AtomicUsize,
    taken: AtomicUsize,
}

impl Ring {
    /// Creates a ring buffer for at least one and at most `records` records of `width` words.
    pub(crate) fn new(width: usize, records: usize) -> Self {
        let room = records.max(1);
        let words = (0..width * room).map(|_| AtomicU64::new(0)).collect();
        Self { words, width, room, pushed: AtomicUsize::new(0), taken: AtomicUsize::new(0) }
    }

    /// Returns the capacity, in records.
    pub(crate) fn room(&self) -> usize {
        self.room
    }

    /// Returns whether the buffer is full. Only the producer thread may call this function.
    #[inline]
    pub(crate) fn is_full(&self) -> bool {
        self.pushed.load(Ordering::Relaxed) - self.taken.load(Ordering::Acquire) == self.room
    }

    fn place(&self, record: usize) -> &[AtomicU64] {
        let from = record % self.room * self.width;
        &self.words[from..from + self.width]
    }

    /// Adds a record. Returns `false` if the buffer is full. Only the producer thread may call this function.
    #[inline]
    pub(crate) fn push(&self, record: impl Iterator<Item = u64>) -> bool {
        if self.is_full() {
            return false;
        }
        let pushed = self.pushed.load(Ordering::Relaxed);
        self.place(pushed).iter().zip(record).for_each(|(word, value)| word.store(value, Ordering::Relaxed));
        self.pushed.store(pushed + 1, Ordering::Release);
        true
    }

    /// Removes a record. Returns `false` if the buffer is empty. Only the consumer thread may call this function.
    pub(crate) fn take(&self, record: &mut [u64]) -> bool {
        let taken = self.taken.load(Ordering::Relaxed);
        if taken == self.pushed.load(Ordering::Acquire) {
            return false;
        }
        record
            .iter_mut()
            .zip(self.place(taken))
            .for_each(|(value, word)| *value = word.load(Ordering::Relaxed));
        self.taken.store(taken + 1, Ordering::Release);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_records_come_through_whole_and_in_order() {
        let ring = Ring::new(3, 7);
        let mut lost = 0_u64;
        let taken = std::thread::scope(|scope| {
            let reader = scope.spawn(|| {
                let (mut record, mut taken) = ([0; 3], Vec::new());
                while record[0] != 99_999 {
                    if ring.take(&mut record) {
                        assert!(record.iter().all(|word| *word == record[0]));
                        taken.push(record[0]);
                    }
                }
                taken
            });
            for k in 0..100_000_u64 {
                while !ring.push(std::iter::repeat_n(k, 3)) {
                    lost += 1;
                    std::thread::yield_now();
                }
            }
            reader.join().unwrap()
        });
        assert!(taken.into_iter().eq(0..100_000));
    }

    #[test]
    fn a_full_ring_says_so() {
        let ring = Ring::new(1, 2);
        assert_eq!([1, 2, 3].map(|k| ring.push([k].into_iter())), [true, true, false]);
        let mut record = [0];
        assert!(ring.take(&mut record) && record == [1]);
        assert!(ring.push([4].into_iter()));
        assert!(ring.take(&mut record) && record == [2] && ring.take(&mut record) && record == [4]);
        assert!(!ring.take(&mut record));
    }
}
