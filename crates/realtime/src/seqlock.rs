//! A record of words that one side writes and another reads, neither of which ever waits.
//!
//! The first word is a counter: odd while the rest is being written, even when it is whole. A reader takes the counter, the
//! rest, and the counter again: where both are the same and even, nobody wrote in between.

use std::sync::atomic::{AtomicU64, Ordering, fence};

/// How often a reader tries again before it leaves the record for the next frame: a writer takes nanoseconds, one that was
/// killed in between for ever.
const TRIES: usize = 4;

/// What a reader found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Found {
    /// What it had read before, or nothing yet.
    Same,
    /// A new record; its counter.
    New(u64),
    /// Somebody was writing all the time.
    Torn,
}

/// Writes a record; `words` has one word more.
pub(crate) fn write(words: &[AtomicU64], record: impl Iterator<Item = u64>) {
    let Some((counter, rest)) = words.split_first() else { return };
    // A writer before this one may have been killed while it wrote.
    let busy = counter.load(Ordering::Relaxed) | 1;
    counter.store(busy, Ordering::Relaxed);
    // No word below comes before the counter is odd, and none after it is even.
    fence(Ordering::Release);
    for (word, value) in rest.iter().zip(record) {
        word.store(value, Ordering::Relaxed);
    }
    counter.store(busy.wrapping_add(1), Ordering::Release);
}

/// Reads a record that is not that of counter `seen`.
pub(crate) fn read(words: &[AtomicU64], seen: u64, record: &mut [u64]) -> Found {
    let Some((counter, rest)) = words.split_first() else { return Found::Same };
    for _ in 0..TRIES {
        let before = counter.load(Ordering::Acquire);
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
    Found::Torn
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
        write(&words, 1..5);
        assert_eq!((read(&words, 0, &mut record), record), (Found::New(2), [1, 2, 3, 4]));
        assert_eq!(read(&words, 2, &mut record), Found::Same);
        words[0].store(3, Ordering::Relaxed);
        assert_eq!(read(&words, 2, &mut record), Found::Torn);
        // The next writer makes it whole again.
        write(&words, 5..9);
        assert_eq!((read(&words, 2, &mut record), record), (Found::New(4), [5, 6, 7, 8]));
    }

    #[test]
    fn no_record_is_a_mixture() {
        let (words, done) = (words(), AtomicBool::new(false));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                (1..200_000_u64).for_each(|k| write(&words, std::iter::repeat_n(k, 4)));
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
}
