//! The inputs of another run, frame by frame.
//!
//! | bytes | what |
//! | --- | --- |
//! | 0–7 | `sslprec1` |
//! | 8–15 | scenario, u64 |
//! | 16–23 | period, s, f64 |
//! | 24–31 | number of inputs n, u64 |
//! | 32–… | n values (f64) of each frame |
//!
//! Everything is little-endian. A last frame that is not whole, of a run that was killed, does not count.

use crate::intake::Intake;
use crate::plant::{Input, Takes};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

const MARK: u64 = u64::from_le_bytes(*b"sslprec1");
const HEAD: usize = 32;
const WORD: usize = 8;

/// What was applied in each frame of another run.
pub struct Recording {
    values: Vec<f64>,
    width: usize,
    frame: usize,
}

/// Why a recording is not played.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// It cannot be read.
    #[error("{}: {source}", path.display())]
    System {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// It is none.
    #[error("{}: not a recording of inputs", .0.display())]
    Foreign(PathBuf),
    /// Of another scenario.
    #[error("{}: the inputs of a run of another scenario", .0.display())]
    OtherScenario(PathBuf),
    /// Of another number of inputs.
    #[error("{}: {got} inputs, the scene has {expected}", path.display())]
    Width {
        /// The file.
        path: PathBuf,
        /// What it has.
        got: u64,
        /// What the scene has.
        expected: usize,
    },
    /// Of frames of another length.
    #[error("{}: recorded in frames of {got:e} s, not of {expected:e} s", path.display())]
    Period {
        /// The file.
        path: PathBuf,
        /// Its frames, s.
        got: f64,
        /// Those asked for, s.
        expected: f64,
    },
    /// A value that an input does not take.
    #[error("{}: frame {frame} has {value:e} for input {input}, which takes {takes}", path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// Which frame.
        frame: usize,
        /// Name of the input.
        input: String,
        /// The value.
        value: f64,
        /// What it takes.
        takes: Takes,
    },
}

/// The words at the head of a recording.
pub fn head(scenario: u64, period: f64, inputs: usize) -> [u64; HEAD / WORD] {
    [MARK, scenario, period.to_bits(), inputs as u64]
}

impl Recording {
    /// Reads all of it into memory.
    ///
    /// # Errors
    /// A file that does not fit.
    pub fn read(path: &Path, scenario: u64, period: f64, inputs: &[Input]) -> Result<Self, RecordingError> {
        let failed = |source| RecordingError::System { path: path.to_owned(), source };
        // Whoever opens a pipe waits for another, whom no signal brings; a device may have no end.
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

    /// Number of frames.
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
