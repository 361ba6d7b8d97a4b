//! Serialization of a row of springs.

use super::{Row, Springs};
use crate::Interface;
use crate::breaking::Rest;
use crate::words::{Words, push};

impl Row {
    /// Writes the state, with the rest positions of springs in contact only.
    pub(crate) fn write(&self, words: &mut Vec<u64>) {
        words.reserve(7 + self.touching);
        push(words, [self.apex.d, self.apex.u, self.slides]);
        self.rest.write(words);
        words.push(u64::from(self.backward));
        words.push(self.touching as u64);
        words.extend(self.anchors[..self.touching].iter().map(|anchor| anchor.to_bits()));
    }

    /// Reads a state that [`Self::write`] wrote, for a row of these springs.
    pub(crate) fn read(law: &Interface, springs: &Springs, words: &mut Words<'_>) -> Option<Self> {
        let (apex, slides, rest) = (words.apex()?, words.sense()?, Rest::read(law, words)?);
        let backward = words.flag()?;
        let touching = words.count(springs.heights().len())?;
        if touching != springs.below(apex.d) {
            return None;
        }
        let mut anchors = vec![0.0; springs.heights().len()];
        for anchor in &mut anchors[..touching] {
            *anchor = words.finite()?;
        }
        Some(Self { apex, anchors, touching, slides, rest, backward })
    }
}
