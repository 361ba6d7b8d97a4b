//! Journal of a run: all calls to its recorder, in order, in binary form.
//!
//! The calls determine all results: a new recorder that receives the same calls has the same tables, results and fingerprints. Numbers are
//! little-endian.
//!
//! | record | bytes |
//! | --- | --- |
//! | row | tag, one number per channel |
//! | event | tag, kind and index (u32) of its source, length of its name (u8), its name, one number per channel |
//! | snapshot (`look`) | tag, time, number of words (u64), words of the slip memory of each contact |
//! | sample (`mark`) | tag, one number per channel |
//! | path | tag, index of the contact (u32), kind (u8), end (d, u), force and energy at the end |
//! | extents | tag; for each of two bodies: minimum, its time, maximum, its time, largest decrease, largest increase of the position |

use sha2::{Digest, Sha256};
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;
use stickslip_contact::{Memory, Segment};
use stickslip_drive::{Entry, Event, Extent, Source};

/// Tags of the records.
pub(super) mod tag {
    pub(in super::super) const ROW: u8 = 0;
    pub(in super::super) const EVENT: u8 = 1;
    pub(in super::super) const LOOK: u8 = 2;
    pub(in super::super) const MARK: u8 = 3;
    pub(in super::super) const EXTENTS: u8 = 4;
    pub(in super::super) const PATH: u8 = 5;
}

/// Length of a journal and digest of its contents up to this length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mark {
    /// Length, bytes.
    pub(super) length: u64,
    /// SHA-256 of the journal up to this length.
    pub(super) digest: [u8; 32],
}

/// Writer of a journal. [`Self::mark`] returns the first write error.
pub(super) struct Journal {
    writer: BufWriter<Digested>,
    failure: Option<io::Error>,
    /// Buffers.
    bytes: Vec<u8>,
    words: Vec<u64>,
}

/// A file with the digest of its contents.
struct Digested {
    file: File,
    length: u64,
    digest: Sha256,
}

impl Journal {
    /// Creates an empty journal and replaces an existing one.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self::on(File::create(path)?, 0, Sha256::new()))
    }

    /// Opens an existing journal, truncates it to `length` bytes and appends to it. `digest` is that of the remaining contents.
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

    /// Returns whether a write has failed.
    pub(super) fn has_failed(&self) -> bool {
        self.failure.is_some()
    }

    /// Writes all buffered data to disk and returns the length and the digest.
    pub(super) fn mark(&mut self) -> io::Result<Mark> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        self.writer.flush()?;
        let Digested { file, length, digest } = self.writer.get_ref();
        file.sync_data()?;
        Ok(Mark { length: *length, digest: digest.clone().finalize().into() })
    }

    /// Appends an entry.
    pub(super) fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => self.row(values),
            Entry::Event(event, values) => self.event(event, values),
            Entry::Look(t, memories) => self.look(t, memories),
            Entry::Mark(values) => self.mark_row(values),
            Entry::Path(c, segment) => self.path(c, segment),
            Entry::Extents(extents) => self.extents(extents),
            Entry::Leaves(_) | Entry::Enters(_) => {}
        }
    }

    fn row(&mut self, values: &[f64]) {
        self.bytes.push(tag::ROW);
        self.reals(values);
        self.put();
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        let (kind, place) = match event.source {
            Source::Contact(place) => (0, place),
            Source::Waveform(place) => (1, place),
            Source::Block(place) => (2, place),
        };
        // No model has that many parts, and no event name is that long.
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

    fn look(&mut self, t: f64, memories: &[Memory]) {
        self.words.clear();
        memories.iter().for_each(|memory| memory.write(&mut self.words));
        self.bytes.push(tag::LOOK);
        self.reals(&[t]);
        self.bytes.extend((self.words.len() as u64).to_le_bytes());
        self.bytes.extend(self.words.iter().flat_map(|word| word.to_le_bytes()));
        self.put();
    }

    fn mark_row(&mut self, values: &[f64]) {
        self.bytes.push(tag::MARK);
        self.reals(values);
        self.put();
    }

    fn extents(&mut self, extents: [Extent; 2]) {
        self.bytes.push(tag::EXTENTS);
        for Extent { least, most, fall, rise } in extents {
            self.reals(&[least[0], least[1], most[0], most[1], fall, rise]);
        }
        self.put();
    }

    fn path(&mut self, c: usize, segment: Segment) {
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

    /// Writes the assembled record. After a write error, later records are discarded, so that the journal has no gaps.
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
