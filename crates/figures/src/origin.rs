//! Origin of a picture, read from its metadata.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use stickslip_plot::{PlotError, read_text};
use stickslip_run::complaint::words;
use stickslip_run::fingerprint::{Fingerprint, FingerprintError};
use stickslip_run::provenance::{END, FINGERPRINT, HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::{Job, hash};
use stickslip_scenario::{Scenario, ScenarioError};
use thiserror::Error;

/// Maximum size of a picture, bytes. Pictures of 8000 px squared have about 10 MB.
const MOST_BYTES: u64 = 64 << 20;

/// Origin of a picture: its scenario and the fingerprint of the run.
pub struct Origin {
    /// The run of the picture.
    pub job: Job,
    /// Program that drew the picture.
    pub program: String,
    /// Time reached, s.
    pub end: f64,
    /// Fingerprint of the results.
    pub fingerprint: Fingerprint,
}

/// Reason why the origin of a picture cannot be read.
#[derive(Debug, Error)]
pub enum OriginError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file is larger than any plot.
    #[error("{}: is larger than {MOST_BYTES} bytes", .0.display())]
    Size(PathBuf),
    /// The file is not a readable PNG or SVG.
    #[error("{}: is not a readable PNG or SVG file: {source}", .path.display())]
    Picture {
        /// Path of the file.
        path: PathBuf,
        /// Error of the picture.
        source: PlotError,
    },
    /// The picture lacks a metadata text, so it is not a plot of a run.
    #[error("{}: contains no scenario: the text \"{key}\" is missing\n   help: plots of `stickslip run` and `plot` contain their scenario, unless another program has written the file again", .path.display())]
    Missing {
        /// Path of the file.
        path: PathBuf,
        /// Key of the missing text.
        key: &'static str,
    },
    /// A metadata text is invalid.
    #[error("{}: its \"{key}\" is damaged: {reason}", .path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// Key of the text.
        key: &'static str,
        /// Error in the text.
        reason: String,
    },
    /// The scenario is invalid for this version.
    #[error("{error}\n   note: written by {program}")]
    Scenario {
        /// Error of the scenario.
        error: Box<ScenarioError>,
        /// Program that wrote the picture.
        program: String,
    },
}

impl Origin {
    /// Reads a PNG or SVG. A repeated run writes its results to `out`.
    ///
    /// # Errors
    /// If the file is not a plot of a run, or if its scenario is invalid.
    pub fn read(path: &Path, out: Option<&Path>) -> Result<Self, OriginError> {
        let texts = Texts::read(path)?;
        let program = texts.get(PROGRAM)?.to_owned();
        let resolved = texts.get(SCENARIO)?;
        if texts.get(HASH)? != hash(resolved) {
            return Err(texts.damaged(SCENARIO, format!("it does not match the \"{HASH}\" in the file")));
        }
        let fingerprint = Fingerprint::parse(texts.get(FINGERPRINT)?)
            .map_err(|error: FingerprintError| texts.damaged(FINGERPRINT, error.to_string()))?;
        let end = texts.get(END)?;
        let end = end
            .parse()
            .map_err(|_| texts.damaged(END, format!("expected a number, got \"{}\"", end.escape_debug())))?;
        let refused =
            |error: ScenarioError| OriginError::Scenario { error: Box::new(error), program: program.clone() };
        // The file may be untrusted. Resolved scenarios contain their tables, so no other files are read.
        let name = format!("{} (its scenario)", path.display());
        let mut scenario = Scenario::from_str_alone(resolved, &name).map_err(refused)?;
        // A time limit must not change the result on a slower computer.
        scenario.plan.limits.wall = None;
        let folder = out.map(Path::to_owned).unwrap_or_default();
        let job = Job::new(scenario, texts.get(TITLE)?.to_owned(), folder).map_err(refused)?;
        Ok(Self { job, program, end, fingerprint })
    }

    /// Returns whether the run reached its planned end.
    pub fn is_whole(&self) -> bool {
        self.end >= self.job.scenario.plan.duration
    }
}

/// Metadata texts of a picture.
struct Texts<'a> {
    path: &'a Path,
    texts: Vec<(String, String)>,
}

impl<'a> Texts<'a> {
    fn read(path: &'a Path) -> Result<Self, OriginError> {
        let failed = |source| OriginError::Read { path: path.to_owned(), source };
        // Opening a named pipe would block.
        if path.canonicalize().is_ok_and(|named| !named.is_file()) {
            return Err(failed(io::Error::other("not a file")));
        }
        let mut bytes = Vec::new();
        File::open(path).map_err(failed)?.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(OriginError::Size(path.to_owned()));
        }
        let texts =
            read_text(&bytes).map_err(|source| OriginError::Picture { path: path.to_owned(), source })?;
        Ok(Self { path, texts })
    }

    fn get(&self, key: &'static str) -> Result<&str, OriginError> {
        let text = self.texts.iter().find(|(found, _)| found == key).map(|(_, text)| text.as_str());
        text.ok_or_else(|| OriginError::Missing { path: self.path.to_owned(), key })
    }

    fn damaged(&self, key: &'static str, reason: String) -> OriginError {
        OriginError::Damaged { path: self.path.to_owned(), key, reason }
    }
}
