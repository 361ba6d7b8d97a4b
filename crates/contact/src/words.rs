//! Serialization of contact memories and hysteresis branches as 64-bit words.
//!
//! Only the state is written. Constant data such as moduli, springs and integrals of the profile come from the model when the state
//! is read. The restored state is identical to the last bit. Readers reject invalid words, so that a restored memory is always valid.

use crate::{Apex, Curve, Engine, Interface, Memory, Row, SpringRow};
use std::sync::Arc;

/// Reader of 64-bit words. Every method returns `None` at the end, and for a word of another kind than requested.
#[derive(Debug, Clone)]
pub struct Words<'a> {
    left: &'a [u64],
}

impl<'a> Words<'a> {
    /// Creates a reader at the first word.
    pub fn new(words: &'a [u64]) -> Self {
        Self { left: words }
    }

    /// Returns the number of words that have not been read.
    pub fn left(&self) -> usize {
        self.left.len()
    }

    /// Returns whether all words have been read.
    pub fn is_empty(&self) -> bool {
        self.left.is_empty()
    }

    /// Reads the next word.
    pub fn word(&mut self) -> Option<u64> {
        let (first, rest) = self.left.split_first()?;
        self.left = rest;
        Some(*first)
    }

    /// Reads any floating-point number, including NaN.
    pub fn real(&mut self) -> Option<f64> {
        self.word().map(f64::from_bits)
    }

    /// Reads a number that is not NaN; it may be infinite.
    pub fn number(&mut self) -> Option<f64> {
        self.real().filter(|real| !real.is_nan())
    }

    /// Reads a finite number.
    pub fn finite(&mut self) -> Option<f64> {
        self.real().filter(|real| real.is_finite())
    }

    /// Reads a flag: the word 0 or 1.
    pub fn flag(&mut self) -> Option<bool> {
        match self.word()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    /// Reads the number of items that follow, each of at least one word. Accepts at most `most` items and at most the number of words left.
    // A caller can therefore never allocate more than the words left.
    pub fn count(&mut self, most: usize) -> Option<usize> {
        let count = usize::try_from(self.word()?).ok()?;
        (count <= most.min(self.left())).then_some(count)
    }

    /// Reads a counter of occurrences of at most `u64::MAX / 2`, so that counting can continue.
    pub fn tally(&mut self) -> Option<u64> {
        self.word().filter(|tally| *tally <= u64::MAX / 2)
    }

    /// Reads a direction: -1, 0 or 1.
    pub(crate) fn sense(&mut self) -> Option<f64> {
        self.finite().filter(|sense| [-1.0, 0.0, 1.0].contains(sense))
    }

    /// Reads an apex.
    pub(crate) fn apex(&mut self) -> Option<Apex> {
        Some(Apex { d: self.finite()?, u: self.finite()? })
    }
}

/// Writes numbers as words.
pub(crate) fn push<const N: usize>(words: &mut Vec<u64>, reals: [f64; N]) {
    words.extend(reals.map(f64::to_bits));
}

impl Memory {
    /// Writes the state of the memory.
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

    /// Reads a state that [`Self::write`] wrote, for a contact with this interface and engine.
    ///
    /// Returns `None` for invalid words. Words after the state are left in the reader.
    pub fn read(law: &Interface, engine: &Engine, words: &mut Words<'_>) -> Option<Self> {
        match (words.word()?, engine) {
            (0, Engine::Curve) => Curve::read(law, words).map(Self::Curve),
            (1, Engine::Row(springs)) => {
                let row = Row::read(law, springs, words)?;
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
