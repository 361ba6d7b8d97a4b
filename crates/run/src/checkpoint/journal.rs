//! The journal of a run: all that its record was told, in order, as plain bytes.
//!
//! Whatever results are made of comes from these calls alone: told again to a fresh recorder, they leave it as the run had left
//! it, tables and figures and fingerprints alike. Numbers are their bits, little-endian:
//!
//! | record | bytes |
//! | --- | --- |
//! | row | tag, a number for each channel |
//! | event | tag, kind of its source and its place (u32), length of its word (u8) and the word, a number for each channel |
//! | look | tag, time, number of words (u64), the words of each contact's memory |
//! | mark | tag, a number for each channel |
//! | path | tag, place of the contact (u32), kind (u8), end (d, u), force and energy at it |
//! | extents | tag, and of each of two bodies: least position and its time, largest position and its time, largest fall and rise |

use sha2::{Digest, Sha256};
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;
use stickslip_contact::{Memory, Segment};
use stickslip_drive::{Event, Extent, Source};

/// What a record begins with.
pub(super) mod tag {
    pub(in super::super) const ROW: u8 = 0;
    pub(in super::super) const EVENT: u8 = 1;
    pub(in super::super) const LOOK: u8 = 2;
    pub(in super::super) const MARK: u8 = 3;
    pub(in super::super) const EXTENTS: u8 = 4;
    pub(in super::super) const PATH: u8 = 5;
}

/// How far a journal counts, and what it holds up to there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mark {
    /// Bytes.
    pub(super) length: u64,
    /// SHA-256 of them.
    pub(super) digest: [u8; 32],
}

/// A journal being written. What fails is told at the next [`Self::mark`].
pub(super) struct Journal {
    writer: BufWriter<Digested>,
    failure: Option<io::Error>,
    /// Scratch.
    bytes: Vec<u8>,
    words: Vec<u64>,
}

/// A file with the digest of what goes into it.
struct Digested {
    file: File,
    length: u64,
    digest: Sha256,
}

impl Journal {
    /// An empty journal in the place of whatever is there.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self::on(File::create(path)?, 0, Sha256::new()))
    }

    /// Goes on with a journal where it counts, whose digest is that far; what comes after is cut off.
    pub(super) fn go_on(path: &Path, length: u64, digest: Sha256) -> io::Result<Self> {
        let mut file = OpenOptions::new().write(true).open(path)?;
        file.set_len(length)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Self::on(file, length, digest))
    }

    fn on(file: File, length: u64, digest: Sha256) -> Self {
        let writer = BufWriter::with_capacity(1 << 16, Digested { file, length, digest });
        Self { writer, failure: None, bytes: Vec::new(), words: Vec::new() }
    }

    /// Whether something could not be written.
    pub(super) fn has_failed(&self) -> bool {
        self.failure.is_some()
    }

    /// Writes all of it through and tells how far that is.
    pub(super) fn mark(&mut self) -> io::Result<Mark> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        self.writer.flush()?;
        let Digested { file, length, digest } = self.writer.get_ref();
        file.sync_data()?;
        Ok(Mark { length: *length, digest: digest.clone().finalize().into() })
    }

    pub(super) fn row(&mut self, values: &[f64]) {
        self.bytes.push(tag::ROW);
        self.reals(values);
        self.put();
    }

    pub(super) fn event(&mut self, event: &Event, values: &[f64]) {
        let (kind, place) = match event.source {
            Source::Contact(place) => (0, place),
            Source::Waveform(place) => (1, place),
            Source::Block(place) => (2, place),
        };
        // No scene has that many parts, no kind so long a word.
        let place = u32::try_from(place).unwrap_or(u32::MAX);
        let word = event.kind.name().as_bytes();
        let word = &word[..word.len().min(usize::from(u8::MAX))];
        self.bytes.extend([tag::EVENT, kind]);
        self.bytes.extend(place.to_le_bytes());
        self.bytes.push(word.len() as u8);
        self.bytes.extend(word);
        self.reals(values);
        self.put();
    }

    pub(super) fn look(&mut self, t: f64, memories: &[Memory]) {
        self.words.clear();
        memories.iter().for_each(|memory| memory.write(&mut self.words));
        self.bytes.push(tag::LOOK);
        self.reals(&[t]);
        self.bytes.extend((self.words.len() as u64).to_le_bytes());
        self.bytes.extend(self.words.iter().flat_map(|word| word.to_le_bytes()));
        self.put();
    }

    pub(super) fn mark_row(&mut self, values: &[f64]) {
        self.bytes.push(tag::MARK);
        self.reals(values);
        self.put();
    }

    pub(super) fn extents(&mut self, extents: [Extent; 2]) {
        self.bytes.push(tag::EXTENTS);
        for Extent { least, most, fall, rise } in extents {
            self.reals(&[least[0], least[1], most[0], most[1], fall, rise]);
        }
        self.put();
    }

    pub(super) fn path(&mut self, c: usize, segment: Segment) {
        let (kind, [force, energy]) = match segment {
            Segment::Straight(_) => (0, [0.0; 2]),
            Segment::Jump(_) => (1, [0.0; 2]),
            Segment::Grown { force, energy, joins, .. } => (2 + u8::from(joins), [force, energy]),
        };
        let to = segment.end();
        self.bytes.push(tag::PATH);
        self.bytes.extend(u32::try_from(c).unwrap_or(u32::MAX).to_le_bytes());
        self.bytes.push(kind);
        self.reals(&[to.d, to.u, force, energy]);
        self.put();
    }

    fn reals(&mut self, values: &[f64]) {
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }

    /// Writes the record that was put together. After a failure nothing more: a journal has no gaps.
    fn put(&mut self) {
        if self.failure.is_none() {
            self.failure = self.writer.write_all(&self.bytes).err();
        }
        self.bytes.clear();
    }
}

impl Write for Digested {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.digest.update(&bytes[..written]);
        self.length += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
