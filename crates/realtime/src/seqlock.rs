//! A record of words that some write and another reads, none of whom ever waits.
//!
//! The first word is a counter: odd while the rest is being written, even when it is whole. A reader takes the counter, the
//! rest, and the counter again: where both are the same and even, nobody wrote in between. A writer claims the record by making
//! the counter odd, in one step with seeing that it is even: of two at once one is refused, and no record is a mixture. What one
//! has claimed who was killed in between, the reader frees.

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
    /// Somebody was writing all the time; the counter at last.
    Torn(u64),
}

/// Writes a record; `words` has one word more. `false` where somebody else is writing, or took this long for a killed writer.
pub(crate) fn write(words: &[AtomicU64], record: impl Iterator<Item = u64>) -> bool {
    let Some((counter, rest)) = words.split_first() else { return false };
    let free = counter.load(Ordering::Relaxed) & !1;
    let busy = free + 1;
    if counter.compare_exchange(free, busy, Ordering::Acquire, Ordering::Relaxed).is_err() {
        return false;
    }
    // No word below comes before the counter is odd, and none after it is even.
    fence(Ordering::Release);
    for (word, value) in rest.iter().zip(record) {
        word.store(value, Ordering::Relaxed);
    }
    counter.compare_exchange(busy, busy.wrapping_add(1), Ordering::Release, Ordering::Relaxed).is_ok()
}

/// Frees a record whose counter is this odd one: whoever claimed it was killed while it wrote. What lies in it is not to be read
/// (as the record of the counter behind it); `false` where somebody was writing after all.
pub(crate) fn free(words: &[AtomicU64], busy: u64) -> bool {
    words.first().is_some_and(|counter| {
        let whole = busy.wrapping_add(1);
        counter.compare_exchange(busy, whole, Ordering::Release, Ordering::Relaxed).is_ok()
    })
}

/// Reads a record that is not that of counter `seen`.
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
        // Until it is freed nobody else writes; who had claimed it has lost it.
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

    /// Both write as fast as they can; a record is read whenever one of them is done.
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
        // What was written was claimed, each for itself.
        assert_eq!(words[0].load(Ordering::Relaxed), 2 * written);
    }
}
