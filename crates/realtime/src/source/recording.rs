//! Recorded inputs of another run, frame by frame.
//!
//! | bytes | content |
//! | --- | --- |
//! | 0–7 | `sslprec1` |
//! | 8–15 | scenario number, u64 |
//! | 16–23 | period, s, f64 |
//! | 24–31 | number of inputs n, u64 |
//! | 32–… | n values (f64) of each frame |
//!
//! All values are little-endian. An incomplete last frame is ignored.

use crate::intake::Intake;
use crate::plant::{Input, Takes};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

const MARK: u64 = u64::from_le_bytes(*b"sslprec1");
const HEAD: usize = 32;
const WORD: usize = 8;

/// Recorded inputs of another run.
pub struct Recording {
    values: Vec<f64>,
    width: usize,
    frame: usize,
}

/// Error for a recording that cannot be used.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// The file cannot be read.
    #[error("{}: {source}", path.display())]
    System {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file is not a recording.
    #[error("{}: not a recording of inputs", .0.display())]
    Foreign(PathBuf),
    /// The recording belongs to another scenario.
    #[error("{}: a recording of another scenario", .0.display())]
    OtherScenario(PathBuf),
    /// The number of inputs differs from that of the scenario.
    #[error("{}: {got} inputs, but the scenario has {expected}", path.display())]
    Width {
        /// Path of the file.
        path: PathBuf,
        /// Number of inputs in the file.
        got: u64,
        /// Number of inputs of the scenario.
        expected: usize,
    },
    /// The frame length of the recording differs from that of the loop.
    #[error("{}: recorded with frames of {got:e} s, expected {expected:e} s", path.display())]
    Period {
        /// Path of the file.
        path: PathBuf,
        /// Frame length of the recording, s.
        got: f64,
        /// Expected frame length, s.
        expected: f64,
    },
    /// A value is not allowed for its input.
    #[error("{}: frame {frame} has {value:e} for input {input}, expected {takes}", path.display())]
    Value {
        /// Path of the file.
        path: PathBuf,
        /// Number of the frame, from 0.
        frame: usize,
        /// Name of the input.
        input: String,
        /// The value.
        value: f64,
        /// Allowed values.
        takes: Takes,
    },
}

/// Returns the header words of a recording.
pub fn head(scenario: u64, period: f64, inputs: usize) -> [u64; HEAD / WORD] {
    [MARK, scenario, period.to_bits(), inputs as u64]
}

impl Recording {
    /// Reads a recording into memory.
    ///
    /// # Errors
    /// The file cannot be read, is not a recording, or does not fit the scenario, the period or the inputs.
    pub fn read(path: &Path, scenario: u64, period: f64, inputs: &[Input]) -> Result<Self, RecordingError> {
        let failed = |source| RecordingError::System { path: path.to_owned(), source };
        // Only regular files are read: opening a pipe would block, and a device may have no end.
        if !fs::metadata(path).map_err(failed)?.is_file() {
            return Err(RecordingError::Foreign(path.to_owned()));
        }
        let bytes = fs::read(path).map_err(failed)?;
        let mut words = bytes.chunks_exact(WORD).map(|chunk| {
            let mut word = [0; WORD];
            word.copy_from_slice(chunk);
            u64::from_le_bytes(word)
        });
        let mut next = || words.next().ok_or_else(|| RecordingError::Foreign(path.to_owned()));
        if next()? != MARK {
            return Err(RecordingError::Foreign(path.to_owned()));
        }
        if next()? != scenario {
            return Err(RecordingError::OtherScenario(path.to_owned()));
        }
        let (got, expected) = (f64::from_bits(next()?), period);
        if got.to_bits() != expected.to_bits() {
            return Err(RecordingError::Period { path: path.to_owned(), got, expected });
        }
        let (got, expected) = (next()?, inputs.len());
        if got != expected as u64 {
            return Err(RecordingError::Width { path: path.to_owned(), got, expected });
        }
        let mut values: Vec<f64> = words.map(f64::from_bits).collect();
        let width = inputs.len();
        values.truncate(values.len().checked_div(width).unwrap_or(0) * width);
        for (place, value) in values.iter().enumerate() {
            let Input { name, takes, .. } = &inputs[place % width];
            if !takes.has(*value) {
                return Err(RecordingError::Value {
                    path: path.to_owned(),
                    frame: place / width,
                    input: name.clone(),
                    value: *value,
                    takes: *takes,
                });
            }
        }
        Ok(Self { values, width, frame: 0 })
    }

    /// Returns the number of frames.
    pub fn frames(&self) -> u64 {
        self.values.len().checked_div(self.width).unwrap_or(0) as u64
    }

    pub(super) fn poll(&mut self, intake: &mut Intake) {
        let from = self.frame * self.width;
        if let Some(values) = self.values.get(from..from + self.width) {
            intake.impose(values);
            self.frame += 1;
        }
    }
}
