//! Inputs from lines of text with one value per input, read by a separate thread.

use crate::intake::{Client, Intake};
use crate::plant::{Input, Takes};
use crate::seqlock::{self, Found};
use crate::wire::{self, Stamp};
use std::io::{self, BufRead, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// Maximum length of a line with its end, bytes: 150 numbers of 25 characters.
const LONGEST: u64 = 4096;

/// Source of inputs that uses the latest line received.
pub struct Lines {
    mailbox: Arc<Mailbox>,
    seen: u64,
    /// Sequence number of the last line that was used.
    last: u64,
    record: Vec<u64>,
    odd: u64,
    refused: u64,
}

struct Mailbox {
    words: Vec<AtomicU64>,
    /// Number of lines that are not valid lists of values.
    odd: AtomicU64,
    /// Number of lines with a value out of range. Such a line does not replace a valid line that has not been used yet.
    refused: AtomicU64,
}

impl Lines {
    /// Starts a thread that reads lines until the end of the input. The thread is not joined, because it may wait for a line.
    pub fn read(mut from: impl BufRead + Send + 'static, scenario: u64, inputs: &[Input]) -> Self {
        let (values, takes): (usize, Vec<Takes>) =
            (inputs.len(), inputs.iter().map(|input| input.takes).collect());
        let length = wire::length(values) / size_of::<u64>();
        let words = (0..=length).map(|_| AtomicU64::new(0)).collect();
        let [odd, refused] = [(); 2].map(|()| AtomicU64::new(0));
        let mailbox = Arc::new(Mailbox { words, odd, refused });
        let filled = Arc::clone(&mailbox);
        thread::spawn(move || {
            let (mut line, mut sequence) = (Vec::new(), 0);
            while let Ok(true) = next(&mut from, &mut line) {
                let Some(found) = std::str::from_utf8(&line).ok().and_then(|line| numbers(line, values))
                else {
                    filled.odd.fetch_add(1, Ordering::Relaxed);
                    continue;
                };
                if !found.iter().zip(&takes).all(|(value, takes)| takes.has(*value)) {
                    filled.refused.fetch_add(1, Ordering::Relaxed);
                    continue;
                }
                sequence += 1;
                let stamp = Stamp { sequence, time: 0.0 };
                // Only this thread writes to the record, so that the write succeeds.
                let _ = seqlock::write(&filled.words, wire::words(scenario, stamp, &found));
            }
        });
        Self { mailbox, seen: 0, last: 0, record: vec![0; length], odd: 0, refused: 0 }
    }

    pub(super) fn poll(&mut self, intake: &mut Intake) {
        let odd = self.mailbox.odd.load(Ordering::Relaxed);
        (self.odd..odd).for_each(|_| intake.note_foreign(true));
        self.odd = odd;
        let refused = self.mailbox.refused.load(Ordering::Relaxed);
        intake.note_out_of_range(refused - self.refused);
        self.refused = refused;
        match seqlock::read(&self.mailbox.words, self.seen, &mut self.record) {
            Found::Same => {}
            Found::Torn(_) => intake.note_torn(),
            Found::New(counter) => {
                self.seen = counter;
                let sequence = self.record[wire::SEQUENCE];
                intake.note_superseded(sequence - self.last - 1);
                self.last = sequence;
                intake.offer_words(Client::Only, self.record.iter().copied());
            }
        }
    }
}

/// Reads a line. A line that is too long is returned as an empty line, and its rest is skipped. Returns `false` at the end of the input.
fn next(from: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<bool> {
    line.clear();
    let read = Read::take(&mut *from, LONGEST).read_until(b'\n', line)?;
    if read as u64 == LONGEST && line.last() != Some(&b'\n') {
        line.clear();
        from.skip_until(b'\n')?;
    }
    Ok(read > 0)
}

/// Returns the numbers of a line, separated by blanks or commas. Returns `None` if the line does not contain exactly `values` numbers.
fn numbers(line: &str, values: usize) -> Option<Vec<f64>> {
    let parts = line.split([' ', '\t', ',', '\r', '\n']).filter(|part| !part.is_empty());
    let numbers = parts.map(|part| part.parse().ok()).collect::<Option<Vec<f64>>>()?;
    (numbers.len() == values).then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intake::{Patience, Silence};

    /// The source is polled after all lines have arrived.
    #[test]
    fn a_value_that_is_refused_takes_no_good_one_away() {
        let input = Input { takes: Takes::Range(0.0, 0.1), ..Input::note("a") };
        let mut lines = Lines::read(io::Cursor::new("0.01\n0.2\nnan\n"), 3, std::slice::from_ref(&input));
        while lines.mailbox.refused.load(Ordering::Relaxed) < 2 {
            thread::sleep(std::time::Duration::from_millis(1));
        }
        let patience = Patience { silence: Silence::Hold, silent_after: 10, owner: 10 };
        let mut intake = Intake::new(3, &[input], patience);
        lines.poll(&mut intake);
        assert_eq!(
            (intake.values(), intake.received().good, intake.received().out_of_range),
            (&[0.01][..], 1, 2)
        );
    }

    #[test]
    fn lines_that_nobody_saw_are_counted() {
        let mut lines = Lines::read(io::Cursor::new("1\n2\n3\n4\n"), 3, &[Input::note("a")]);
        let patience = Patience { silence: Silence::Hold, silent_after: 10, owner: 10 };
        let mut intake = Intake::new(3, &[Input::note("a")], patience);
        for _ in 0..5000 {
            lines.poll(&mut intake);
            intake.settle().unwrap();
            if intake.values() == [4.0] {
                break;
            }
            thread::sleep(std::time::Duration::from_millis(1));
        }
        let (received, looks) = (intake.received(), intake.received().good - intake.received().superseded);
        assert_eq!((intake.values(), received.good), (&[4.0][..], 4));
        assert!((1..=4).contains(&looks), "{received:?}");
    }

    #[test]
    fn a_line_that_is_no_text_or_too_long_is_one_odd_line_and_the_next_counts() {
        let long = [vec![b'x'; LONGEST as usize], b" 7".to_vec()].concat();
        let lines: [&[u8]; 5] = [b"1", b"\xff", &long, b"\xc3", b"2"];
        let mut lines = Lines::read(io::Cursor::new(lines.join(&b'\n')), 3, &[Input::note("a")]);
        let patience = Patience { silence: Silence::Hold, silent_after: 10, owner: 10 };
        let mut intake = Intake::new(3, &[Input::note("a")], patience);
        // Wait until the thread has read the lines.
        for _ in 0..5000 {
            lines.poll(&mut intake);
            if intake.values() == [2.0] {
                break;
            }
            thread::sleep(std::time::Duration::from_millis(1));
        }
        lines.poll(&mut intake);
        assert_eq!((intake.values(), intake.received().wrong_length), (&[2.0][..], 3));
    }

    #[test]
    fn a_line_has_one_number_for_each_input() {
        assert_eq!(numbers("1e-7, -2\n", 2), Some(vec![1e-7, -2.0]));
        assert_eq!(numbers("\t3 \r\n", 1), Some(vec![3.0]));
        for wrong in ["", "1", "1 2 3", "1 x", "1 2nm"] {
            assert_eq!(numbers(wrong, 2), None, "{wrong}");
        }
    }
}
