//! Lines of text, one value for each input, read by a thread of their own.

use crate::intake::{Client, Intake};
use crate::seqlock::{self, Found};
use crate::wire::{self, Stamp};
use std::io::BufRead;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// Longest line, bytes: 150 numbers of 25.
const LONGEST: u64 = 4096;

/// The newest of the lines that have come.
pub struct Lines {
    mailbox: Arc<Mailbox>,
    seen: u64,
    record: Vec<u64>,
    odd: u64,
}

struct Mailbox {
    words: Vec<AtomicU64>,
    /// Lines that are no values.
    odd: AtomicU64,
}

impl Lines {
    /// Reads lines until there are no more. The thread is left alone at the end of the loop: it waits for a line.
    pub fn read(mut from: impl BufRead + Send + 'static, scenario: u64, values: usize) -> Self {
        let length = wire::length(values) / size_of::<u64>();
        let words = (0..=length).map(|_| AtomicU64::new(0)).collect();
        let mailbox = Arc::new(Mailbox { words, odd: AtomicU64::new(0) });
        let filled = Arc::clone(&mailbox);
        thread::spawn(move || {
            let (mut line, mut sequence) = (String::new(), 0);
            loop {
                line.clear();
                match std::io::Read::take(&mut from, LONGEST).read_line(&mut line) {
                    Ok(0) | Err(_) => return,
                    Ok(_) => {}
                }
                let Some(found) = numbers(&line, values) else {
                    filled.odd.fetch_add(1, Ordering::Relaxed);
                    continue;
                };
                sequence += 1;
                let stamp = Stamp { sequence, time: 0.0 };
                seqlock::write(&filled.words, wire::words(scenario, stamp, &found));
            }
        });
        Self { mailbox, seen: 0, record: vec![0; length], odd: 0 }
    }

    pub(super) fn poll(&mut self, intake: &mut Intake) {
        let odd = self.mailbox.odd.load(Ordering::Relaxed);
        (self.odd..odd).for_each(|_| intake.note_foreign(true));
        self.odd = odd;
        match seqlock::read(&self.mailbox.words, self.seen, &mut self.record) {
            Found::Same => {}
            Found::Torn => intake.note_torn(),
            Found::New(counter) => {
                self.seen = counter;
                intake.offer_words(Client::Only, self.record.iter().copied());
            }
        }
    }
}

/// The numbers of a line, with blanks or commas between them, if they are as many as these.
fn numbers(line: &str, values: usize) -> Option<Vec<f64>> {
    let parts = line.split([' ', '\t', ',', '\r', '\n']).filter(|part| !part.is_empty());
    let numbers = parts.map(|part| part.parse().ok()).collect::<Option<Vec<f64>>>()?;
    (numbers.len() == values).then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_one_number_for_each_input() {
        assert_eq!(numbers("1e-7, -2\n", 2), Some(vec![1e-7, -2.0]));
        assert_eq!(numbers("\t3 \r\n", 1), Some(vec![3.0]));
        for wrong in ["", "1", "1 2 3", "1 x", "1 2nm"] {
            assert_eq!(numbers(wrong, 2), None, "{wrong}");
        }
    }
}
