//! Memories and branches as plain words, for those who keep them: a number is its bits.
//!
//! Only state is written. What the model holds (moduli, slopes, a row's springs, M and N of a profile) is attached again in
//! reading, so that what is read is what was written to the last bit, and cannot contradict its model. A reader refuses words
//! on which a later use would stumble: a memory that was read behaves, whatever the words were.

use crate::{Apex, Curve, Engine, Interface, Memory, Row, SpringRow};
use std::sync::Arc;

/// Reads words one after the other. Each question takes what it asked for, or gives none: at the end of the words, and for
/// a word that is not what was asked for.
#[derive(Debug, Clone)]
pub struct Words<'a> {
    left: &'a [u64],
}

impl<'a> Words<'a> {
    /// From the first word on.
    pub fn new(words: &'a [u64]) -> Self {
        Self { left: words }
    }

    /// Words not yet read.
    pub fn left(&self) -> usize {
        self.left.len()
    }

    /// Whether all words are read.
    pub fn is_empty(&self) -> bool {
        self.left.is_empty()
    }

    /// The next word.
    pub fn word(&mut self) -> Option<u64> {
        let (first, rest) = self.left.split_first()?;
        self.left = rest;
        Some(*first)
    }

    /// A number, to the bit: whatever number it is.
    pub fn real(&mut self) -> Option<f64> {
        self.word().map(f64::from_bits)
    }

    /// A number that is one; it may be infinite.
    pub fn number(&mut self) -> Option<f64> {
        self.real().filter(|real| !real.is_nan())
    }

    /// A finite number.
    pub fn finite(&mut self) -> Option<f64> {
        self.real().filter(|real| real.is_finite())
    }

    /// A flag: 0 or 1 and nothing else.
    pub fn flag(&mut self) -> Option<bool> {
        match self.word()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    /// How many things follow, of a word or more each: no more than `most`, and no more than there are words left.
    // What is then made room for is never more than what was read.
    pub fn count(&mut self, most: usize) -> Option<usize> {
        let count = usize::try_from(self.word()?).ok()?;
        (count <= most.min(self.left())).then_some(count)
    }

    /// How many times something has happened: so few that they can go on being counted.
    pub fn tally(&mut self) -> Option<u64> {
        self.word().filter(|tally| *tally <= u64::MAX / 2)
    }

    /// Where a contact stands.
    pub(crate) fn apex(&mut self) -> Option<Apex> {
        Some(Apex { d: self.finite()?, u: self.finite()? })
    }
}

/// Writes numbers as words.
pub(crate) fn push<const N: usize>(words: &mut Vec<u64>, reals: [f64; N]) {
    words.extend(reals.map(f64::to_bits));
}

impl Memory {
    /// Writes the state: what [`Self::read`] needs beside the interface and the engine.
    pub fn write(&self, words: &mut Vec<u64>) {
        match self {
            Self::Curve(curve) => {
                words.push(0);
                curve.write(words);
            }
            Self::Row(SpringRow { row, .. }) => {
                words.push(1);
                row.write(words);
            }
        }
    }

    /// Reads what [`Self::write`] wrote of a contact with this interface and this engine; none for words that it did not
    /// write. The words after it are left.
    pub fn read(law: &Interface, engine: &Engine, words: &mut Words<'_>) -> Option<Self> {
        match (words.word()?, engine) {
            (0, Engine::Curve) => Curve::read(law, words).map(Self::Curve),
            (1, Engine::Row(springs)) => {
                let row = Row::read(springs, words)?;
                Some(Self::Row(SpringRow { row, springs: Arc::clone(springs) }))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_is_no_larger_than_what_it_counts() {
        let count = |words: &[u64], most| Words::new(words).count(most);
        assert_eq!(count(&[2, 7, 7], 5), Some(2));
        assert_eq!(count(&[2, 7, 7], 1), None);
        assert_eq!(count(&[3, 7, 7], 5), None);
        assert_eq!(count(&[u64::MAX, 7, 7], usize::MAX), None);
        assert_eq!(count(&[0], 0), Some(0));
        assert_eq!(count(&[], 0), None);
    }

    #[test]
    fn a_tally_can_be_counted_on() {
        assert_eq!(Words::new(&[1 << 53]).tally(), Some(1 << 53));
        assert_eq!(Words::new(&[u64::MAX]).tally(), None);
    }

    #[test]
    fn words_are_what_is_asked_for_or_none() {
        let words = [1, 2, f64::NAN.to_bits(), f64::INFINITY.to_bits(), (-0.0_f64).to_bits()];
        let mut reader = Words::new(&words);
        assert_eq!((reader.flag(), reader.flag()), (Some(true), None));
        assert_eq!((reader.number(), reader.finite(), reader.left()), (None, None, 1));
        assert_eq!(reader.real().map(f64::to_bits), Some(words[4]));
        assert!(reader.is_empty() && reader.word().is_none());
    }
}
