//! Replay of a journal to a recorder.

use super::error::CheckpointError;
use super::journal::{Mark, tag};
use super::plain;
use crate::job::Job;
use crate::record::Recorder;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;
use stickslip_contact::{Apex, Engine, Interface, Memory, Segment, Words};
use stickslip_drive::{Due, Entry, Extent, Record, Source};

/// Size of the read buffer, in bytes.
const CHUNK: usize = 1 << 16;

/// Checks that a journal begins with the contents that `mark` describes, and returns their digest.
///
/// # Errors
/// The journal is too short, was changed, or cannot be read.
pub(super) fn check(path: &Path, mark: &Mark) -> Result<Sha256, CheckpointError> {
    let unreadable = |source| CheckpointError::Read { path: path.to_owned(), source };
    plain(path).map_err(unreadable)?;
    let mut file = File::open(path).map_err(unreadable)?;
    let found = file.metadata().map_err(unreadable)?.len();
    if found < mark.length {
        return Err(CheckpointError::Short { path: path.to_owned(), expected: mark.length, found });
    }
    let (mut digest, mut chunk) = (Sha256::new(), vec![0; CHUNK]);
    let mut left = mark.length;
    while left > 0 {
        let next = &mut chunk[..left.min(CHUNK as u64) as usize];
        file.read_exact(next).map_err(unreadable)?;
        digest.update(&*next);
        left -= next.len() as u64;
    }
    let same = digest.clone().finalize()[..] == mark.digest;
    if same { Ok(digest) } else { Err(CheckpointError::Journal(path.to_owned())) }
}

/// Part of a journal that is replayed, with data for checking its snapshots.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    pub(super) mark: Mark,
    /// Time that the run has reached, s.
    pub(super) reached: f64,
    /// Whether the planned end of the run is unchanged. In this case, missing snapshots are no error.
    pub(super) same_end: bool,
}

/// Replays a checked journal to a new recorder of the job.
///
/// Snapshots at times that were requested only for the previous end of the run are skipped.
///
/// # Errors
/// The journal belongs to another job, lacks a snapshot that the new end of the run requires, or cannot be read.
pub(super) fn tell(
    path: &Path,
    told: Told,
    job: &Job,
    recorder: &mut Recorder<'_>,
) -> Result<(), CheckpointError> {
    let unreadable = |source| CheckpointError::Read { path: path.to_owned(), source };
    let file = File::open(path).map_err(unreadable)?;
    let mut playback = Playback {
        bytes: BufReader::with_capacity(CHUNK, file),
        left: told.mark.length,
        contacts: contacts(job),
        values: vec![0.0; job.model.channels().len()],
        scratch: Vec::new(),
        looks: Looks { due: f64::NEG_INFINITY, missed: None },
        recorder,
    };
    playback.looks.ask(playback.recorder);
    while playback.left > 0 {
        match playback.record() {
            Ok(Some(())) => {}
            Ok(None) => return Err(CheckpointError::Journal(path.to_owned())),
            Err(source) => return Err(unreadable(source)),
        }
    }
    let Playback { mut looks, recorder, .. } = playback;
    looks.pass(told.reached.next_up(), recorder);
    recorder.hand_back(looks.due);
    match looks.missed.filter(|_| !told.same_end) {
        None => Ok(()),
        Some(t) => Err(CheckpointError::Unseen { folder: job.folder.clone(), t }),
    }
}

/// Times of the snapshots that a recorder requests during a replay.
struct Looks {
    /// Time of the next snapshot, s; infinite after the last one.
    due: f64,
    /// Time of the first snapshot that the journal lacks, s.
    missed: Option<f64>,
}

impl Looks {
    fn ask(&mut self, recorder: &mut Recorder<'_>) {
        self.due = recorder.next(Due::Look).unwrap_or(f64::INFINITY);
    }

    /// Skips the snapshots before time t.
    fn pass(&mut self, t: f64, recorder: &mut Recorder<'_>) {
        while self.due < t {
            self.missed.get_or_insert(self.due);
            self.ask(recorder);
        }
    }
}

/// Returns the contact law and the [`Engine`] (representation of the slip memory) of each contact.
fn contacts(job: &Job) -> Vec<(&Interface, Engine)> {
    let engine = |memory: &Memory| match memory {
        Memory::Curve(_) => Engine::Curve,
        Memory::Row(row) => Engine::Row(row.springs.clone()),
    };
    job.model.contacts().zip(job.start.memories()).map(|((_, law), memory)| (law, engine(memory))).collect()
}

/// A journal that is being replayed.
struct Playback<'a, 'r> {
    bytes: BufReader<File>,
    /// Number of remaining bytes.
    left: u64,
    contacts: Vec<(&'a Interface, Engine)>,
    /// Buffer for the channel values.
    values: Vec<f64>,
    scratch: Vec<u8>,
    looks: Looks,
    recorder: &'a mut Recorder<'r>,
}

impl Playback<'_, '_> {
    fn extent(&mut self) -> io::Result<Extent> {
        let mut numbers = [0.0; 6];
        for number in &mut numbers {
            *number = f64::from_le_bytes(self.array()?);
        }
        let [least, at, most, then, fall, rise] = numbers;
        Ok(Extent { least: [least, at], most: [most, then], fall, rise })
    }

    /// Replays the next record. Returns `None` for an invalid record.
    fn record(&mut self) -> io::Result<Option<()>> {
        match self.array()? {
            [tag::ROW] => {
                self.read_values()?;
                self.recorder.take(Entry::Row(&self.values));
                Ok(Some(()))
            }
            [tag::MARK] => {
                self.read_values()?;
                self.recorder.take(Entry::Mark(&self.values));
                Ok(Some(()))
            }
            [tag::EXTENTS] => {
                let extents = [self.extent()?, self.extent()?];
                self.recorder.take(Entry::Extents(extents));
                Ok(Some(()))
            }
            [tag::PATH] => self.path(),
            [tag::EVENT] => self.event(),
            [tag::LOOK] => self.look(),
            _ => Ok(None),
        }
    }

    fn event(&mut self) -> io::Result<Option<()>> {
        let [kind] = self.array()?;
        let place = u32::from_le_bytes(self.array()?) as usize;
        let [length] = self.array()?;
        self.read_bytes(u64::from(length))?;
        let word = String::from_utf8_lossy(&self.scratch).into_owned();
        let source = match kind {
            0 if place < self.contacts.len() => Source::Contact(place),
            1 => Source::Waveform(place),
            2 => Source::Block(place),
            _ => return Ok(None),
        };
        self.read_values()?;
        self.recorder.event_named(source, &word, &self.values);
        Ok(Some(()))
    }

    fn path(&mut self) -> io::Result<Option<()>> {
        let c = u32::from_le_bytes(self.array()?) as usize;
        let [kind] = self.array()?;
        let mut reals = [0.0; 4];
        for real in &mut reals {
            *real = f64::from_le_bytes(self.array()?);
        }
        let [d, u, force, energy] = reals;
        let to = Apex { d, u };
        let segment = match kind {
            0 => Segment::Straight(to),
            1 => Segment::Jump(to),
            2 | 3 => Segment::Grown { to, force, energy, joins: kind == 3 },
            _ => return Ok(None),
        };
        self.recorder.take(Entry::Path(c, segment));
        Ok(Some(()))
    }

    fn look(&mut self) -> io::Result<Option<()>> {
        let t = f64::from_le_bytes(self.array()?);
        let count = u64::from_le_bytes(self.array()?);
        // The length is checked before memory is allocated.
        let Some(length) = count.checked_mul(8).filter(|length| *length <= self.left) else {
            return Ok(None);
        };
        self.read_bytes(length)?;
        let words: Vec<u64> =
            self.scratch.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect();
        let mut words = Words::new(&words);
        let memories: Option<Vec<Memory>> =
            self.contacts.iter().map(|(law, engine)| Memory::read(law, engine, &mut words)).collect();
        let Some(memories) = memories.filter(|_| words.is_empty()) else { return Ok(None) };
        self.looks.pass(t, self.recorder);
        if self.looks.due == t {
            self.recorder.take(Entry::Look(t, &memories));
            self.looks.ask(self.recorder);
        }
        Ok(Some(()))
    }

    fn read_values(&mut self) -> io::Result<()> {
        self.read_bytes(8 * self.values.len() as u64)?;
        let chunks = self.scratch.as_chunks().0;
        for (value, bytes) in self.values.iter_mut().zip(chunks) {
            *value = f64::from_le_bytes(*bytes);
        }
        Ok(())
    }

    /// Reads bytes into the scratch buffer.
    fn read_bytes(&mut self, length: u64) -> io::Result<()> {
        self.left = self.left.checked_sub(length).ok_or(io::ErrorKind::UnexpectedEof)?;
        self.scratch.resize(usize::try_from(length).map_err(io::Error::other)?, 0);
        self.bytes.read_exact(&mut self.scratch)
    }

    fn array<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        self.left = self.left.checked_sub(N as u64).ok_or(io::ErrorKind::UnexpectedEof)?;
        let mut bytes = [0; N];
        self.bytes.read_exact(&mut bytes)?;
        Ok(bytes)
    }
}
