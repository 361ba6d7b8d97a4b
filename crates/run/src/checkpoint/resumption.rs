//! Resumption of a run from its checkpoint.

use super::error::CheckpointError;
use super::journal::Journal;
use super::keeper::Keeper;
use super::key::{end_of, is_end, is_limit, model_key, run_key};
use super::playback::Told;
use super::stub::Stub;
use super::{JOURNAL, STATE, place, plain, playback};
use crate::files::SCENARIO;
use crate::job::Job;
use crate::record::Recorder;
use sha2::Sha256;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_drive::State;
use stickslip_scenario::Scenario;

/// An interrupted run whose checkpoint has been checked, so that the run can be resumed.
pub struct Resumption {
    place: PathBuf,
    stub: Stub,
    state: State,
    /// Digest of the journal up to the length that is stored in the state file.
    digest: Sha256,
}

impl Resumption {
    /// Reads the checkpoint in a results folder. The pairs in `set` change the end or the limits of the run. Nothing is written.
    ///
    /// # Errors
    /// The checkpoint is invalid or belongs to another run, `set` changes another key, or the run has passed the new end.
    pub fn read(results: &Path, set: &[(String, String)]) -> Result<(Job, Self), CheckpointError> {
        let place = place(results);
        let stub = stub(&place.join(STATE), results)?;
        let job = job(&place.join(SCENARIO), set, &stub, results)?;
        let state = State::from_bytes(&job.model, &stub.model_key, &stub.state)
            .map_err(|source| CheckpointError::State { path: place.join(STATE), source })?;
        let (reached, end) = (state.time(), job.scenario.plan.duration);
        if reached >= end {
            return Err(CheckpointError::Passed { folder: results.to_owned(), reached, end });
        }
        let kept = Scenario::load(place.join(SCENARIO))?;
        let opens = [kept.written.window[0], job.scenario.written.window[0]];
        if job.scenario.written.goes_by_end && opens[0] != opens[1] && reached > opens[0].min(opens[1]) {
            return Err(CheckpointError::LastPeriods(results.to_owned()));
        }
        let digest = playback::check(&place.join(JOURNAL), &stub.mark)?;
        Ok((job, Self { place, stub, state, digest }))
    }

    /// Returns the time that the run has reached, s.
    pub fn reached(&self) -> f64 {
        self.state.time()
    }

    /// Replays the run so far to a new recorder of the job and continues the checkpoints.
    ///
    /// `every` is the new interval of the checkpoints, s of wall time. `None` keeps the previous interval.
    ///
    /// # Errors
    /// The journal was changed after [`Self::read`], or a file cannot be written.
    pub fn tell(
        mut self,
        job: &Job,
        every: Option<f64>,
        recorder: &mut Recorder<'_>,
    ) -> Result<Keeper, CheckpointError> {
        let path = self.place.join(JOURNAL);
        let (mark, end) = (self.stub.mark, job.scenario.plan.duration);
        // A run with an empty journal starts from its first row and snapshot.
        let is_begun = mark.length > 0;
        if is_begun {
            let told = Told { mark, reached: self.state.time(), same_end: self.stub.end == end };
            playback::tell(&path, told, job, recorder)?;
        }
        let unwritable = |source| CheckpointError::Write { path: self.place.clone(), source };
        let journal = Journal::go_on(&path, mark.length, self.digest).map_err(unwritable)?;
        self.stub.every = every.unwrap_or(self.stub.every);
        self.stub.end = end;
        Keeper::go_on(job, self.stub, journal, (self.state, is_begun)).map_err(unwritable)
    }
}

/// Reads the state file.
fn stub(path: &Path, results: &Path) -> Result<Stub, CheckpointError> {
    match plain(path).and_then(|()| fs::read(path)) {
        Ok(bytes) => Stub::from_bytes(&bytes, path),
        Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
            Err(CheckpointError::None(results.to_owned()))
        }
        Err(source) => Err(CheckpointError::Read { path: path.to_owned(), source }),
    }
}

/// Returns the job of the resumed run, with the changes in `set`.
fn job(path: &Path, set: &[(String, String)], stub: &Stub, results: &Path) -> Result<Job, CheckpointError> {
    let kept = Scenario::load(path)?;
    if run_key(&kept) != stub.run_key || model_key(&kept) != stub.model_key {
        return Err(CheckpointError::OtherScenario(path.to_owned()));
    }
    let end = end_of(&kept);
    if let Some((path, value)) = set.iter().find(|(path, _)| path != end && !is_limit(path)) {
        let given = format!("{path}={value}");
        return Err(match is_end(path) {
            true => CheckpointError::OtherEnd(given, end),
            false => CheckpointError::NotTheEnd(given, end),
        });
    }
    let overrides: Vec<(&str, &str)> = set.iter().map(|(p, v)| (p.as_str(), v.as_str())).collect();
    let scenario = Scenario::load_with(path, &overrides)?;
    Ok(Job::new(scenario, stub.name.clone(), results.to_owned())?)
}
