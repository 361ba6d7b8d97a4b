//! What a picture comes from, read back from the picture.

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

/// Largest picture that is read, bytes: at 8000 pixels each way they have some 10 MB.
const MOST_BYTES: u64 = 64 << 20;

/// Where a picture comes from.
pub struct Origin {
    /// What was run.
    pub job: Job,
    /// By what.
    pub program: String,
    /// Time reached, s.
    pub end: f64,
    /// What came out.
    pub fingerprint: Fingerprint,
}

/// Why a file does not tell where it comes from.
#[derive(Debug, Error)]
pub enum OriginError {
    /// The file.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Larger than any picture of ours.
    #[error("{}: has more than {MOST_BYTES} bytes", .0.display())]
    Size(PathBuf),
    /// No picture, or a damaged one.
    #[error("{}: cannot be read as a picture: {source}", .path.display())]
    Picture {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        source: PlotError,
    },
    /// A picture of something else.
    #[error("{}: carries no scenario: there is no text \"{key}\" in it\n   help: pictures of `stickslip run` and `plot` carry theirs, unless another program has written them since", .path.display())]
    Missing {
        /// Which file.
        path: PathBuf,
        /// The text that it lacks.
        key: &'static str,
    },
    /// A text that is not what it should be.
    #[error("{}: its \"{key}\" is damaged: {reason}", .path.display())]
    Damaged {
        /// Which file.
        path: PathBuf,
        /// Which text.
        key: &'static str,
        /// What is wrong with it.
        reason: String,
    },
    /// The scenario is refused.
    #[error("{error}\n   note: written by {program}")]
    Scenario {
        /// What is wrong with it.
        error: Box<ScenarioError>,
        /// The program that wrote it.
        program: String,
    },
}

impl Origin {
    /// Reads a PNG or SVG; results of its job go to `out`.
    ///
    /// # Errors
    /// A file that is no such picture, or one whose scenario this program refuses.
    pub fn read(path: &Path, out: Option<&Path>) -> Result<Self, OriginError> {
        let texts = Texts::read(path)?;
        let program = texts.get(PROGRAM)?.to_owned();
        let resolved = texts.get(SCENARIO)?;
        if texts.get(HASH)? != hash(resolved) {
            return Err(texts.damaged(SCENARIO, format!("it is not the one of its \"{HASH}\"")));
        }
        let fingerprint = Fingerprint::parse(texts.get(FINGERPRINT)?)
            .map_err(|error: FingerprintError| texts.damaged(FINGERPRINT, error.to_string()))?;
        let end = texts.get(END)?;
        let end = end
            .parse()
            .map_err(|_| texts.damaged(END, format!("expected a number, got \"{}\"", end.escape_debug())))?;
        let refused =
            |error: ScenarioError| OriginError::Scenario { error: Box::new(error), program: program.clone() };
        // It may come from anybody, and it names no files: resolved scenarios carry their tables.
        let name = format!("{} (its scenario)", path.display());
        let mut scenario = Scenario::from_str_alone(resolved, &name).map_err(refused)?;
        // A slower machine is no difference.
        scenario.plan.limits.wall = None;
        let folder = out.map(Path::to_owned).unwrap_or_default();
        let job = Job::new(scenario, texts.get(TITLE)?.to_owned(), folder).map_err(refused)?;
        Ok(Self { job, program, end, fingerprint })
    }

    /// Whether the run came to its end.
    pub fn is_whole(&self) -> bool {
        self.end >= self.job.scenario.plan.duration
    }
}

/// The texts of a picture.
struct Texts<'a> {
    path: &'a Path,
    texts: Vec<(String, String)>,
}

impl<'a> Texts<'a> {
    fn read(path: &'a Path) -> Result<Self, OriginError> {
        let failed = |source| OriginError::Read { path: path.to_owned(), source };
        // To open a pipe with a name would wait for whoever writes into it.
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
