//! Sequence lock: a record of words with several writers and one reader. Writers and reader never wait.
//!
//! The first word is a counter: its lowest bit is 1 while a record is written and 0 when the record is complete. A reader reads the
//! counter, the record and the counter again. If both counters are equal and even, the record is consistent. A writer claims the record by
//! an atomic compare-exchange of the counter. If two writers try at once, one fails. A reader can release a record whose writer was killed.

use std::sync::atomic::{AtomicU64, Ordering, fence};

/// Maximum number of attempts to read a record in a frame. A write takes nanoseconds, unless the writer was killed.
const TRIES: usize = 4;

/// Result of reading a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Found {
    /// The record has not changed, or no record has been written.
    Same,
    /// A new record was read; the value is its counter.
    New(u64),
    /// A writer was active at every attempt; the value is the last counter.
    Torn(u64),
}

/// Writes a record. `words` has one additional word at its start, the counter.
///
/// Returns `false` if another writer is active, or if the reader released the record during the writing.
pub(crate) fn write(words: &[AtomicU64], record: impl Iterator<Item = u64>) -> bool {
    let Some((counter, rest)) = words.split_first() else { return false };
    let free = counter.load(Ordering::Relaxed) & !1;
    let busy = free + 1;
    if counter.compare_exchange(free, busy, Ordering::Acquire, Ordering::Relaxed).is_err() {
        return false;
    }
    // The fence prevents the writes from moving before the first change of the counter.
    fence(Ordering::Release);
    for (word, value) in rest.iter().zip(record) {
        word.store(value, Ordering::Relaxed);
    }
    counter.compare_exchange(busy, busy.wrapping_add(1), Ordering::Release, Ordering::Relaxed).is_ok()
}

/// Releases a record with the counter `busy`, whose writer was killed.
///
/// The incomplete record is not valid. Returns `false` if the counter has changed, because the writer is still active.
pub(crate) fn free(words: &[AtomicU64], busy: u64) -> bool {
    words.first().is_some_and(|counter| {
        let whole = busy.wrapping_add(1);
        counter.compare_exchange(busy, whole, Ordering::Release, Ordering::Relaxed).is_ok()
    })
}

/// Reads a record unless its counter is still `seen`.
pub(crate) fn read(words: &[AtomicU64], seen: u64, record: &mut [u64]) -> Found {
    let Some((counter, rest)) = words.split_first() else { return Found::Same };
    let mut before = seen;
    for _ in 0..TRIES {
        before = counter.load(Ordering::Acquire);
        if before == seen {
            return Found::Same;
        }
        for (value, word) in record.iter_mut().zip(rest) {
            *value = word.load(Ordering::Relaxed);
        }
        fence(Ordering::Acquire);
        if before & 1 == 0 && counter.load(Ordering::Relaxed) == before {
            return Found::New(before);
        }
        std::hint::spin_loop();
    }
    Found::Torn(before)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    fn words() -> Vec<AtomicU64> {
        (0..5).map(|_| AtomicU64::new(0)).collect()
    }

    #[test]
    fn a_record_is_read_once_and_one_half_written_never() {
        let (words, mut record) = (words(), [0; 4]);
        assert_eq!(read(&words, 0, &mut record), Found::Same);
        assert!(write(&words, 1..5));
        assert_eq!((read(&words, 0, &mut record), record), (Found::New(2), [1, 2, 3, 4]));
        assert_eq!(read(&words, 2, &mut record), Found::Same);
        words[0].store(3, Ordering::Relaxed);
        assert_eq!(read(&words, 2, &mut record), Found::Torn(3));
        // Until it is released, no other writer can write. Its first writer has lost it.
        assert!(!write(&words, 5..9) && !free(&words, 1) && free(&words, 3) && !free(&words, 3));
        assert!(write(&words, 5..9));
        assert_eq!((read(&words, 4, &mut record), record), (Found::New(6), [5, 6, 7, 8]));
    }

    #[test]
    fn no_record_is_a_mixture() {
        let (words, done) = (words(), AtomicBool::new(false));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                (1..200_000_u64).for_each(|k| assert!(write(&words, std::iter::repeat_n(k, 4))));
                done.store(true, Ordering::Release);
            });
            let (mut seen, mut record, mut last) = (0, [0; 4], 0);
            while !done.load(Ordering::Acquire) || last == 0 {
                if let Found::New(counter) = read(&words, seen, &mut record) {
                    assert!(record.iter().all(|value| *value == record[0]) && record[0] > last, "{record:?}");
                    (seen, last) = (counter, record[0]);
                }
            }
        });
    }

    /// Both writers write as fast as possible, and the record is read after each write.
    #[test]
    fn no_record_of_two_writers_is_a_mixture() {
        let words: Vec<AtomicU64> = (0..65).map(|_| AtomicU64::new(0)).collect();
        let written = [1, 2].map(|writer| {
            let words = &words;
            move || {
                let mut written = 0_u64;
                for k in 0..100_000_u64 {
                    written += u64::from(write(words, std::iter::repeat_n(2 * k + writer, 64)));
                    let mut record = [0; 64];
                    if let Found::New(_) = read(words, 0, &mut record) {
                        assert!(record.iter().all(|value| *value == record[0]), "{record:?}");
                    }
                }
                written
            }
        });
        let written: u64 = std::thread::scope(|scope| {
            written.map(|writer| scope.spawn(writer)).into_iter().map(|writer| writer.join().unwrap()).sum()
        });
        // All records were claimed before they were written.
        assert_eq!(words[0].load(Ordering::Relaxed), 2 * written);
    }
}
