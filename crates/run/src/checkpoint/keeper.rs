//! Writing of checkpoints during a run.

use super::journal::Journal;
use super::key::{model_key, run_key};
use super::stub::Stub;
use super::{JOURNAL, STATE, place, remove};
use crate::disk::{Disk, System};
use crate::files::SCENARIO;
use crate::folder::{self, sweep};
use crate::job::Job;
use std::fs;
use std::io;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use stickslip_drive::{State, Stepper};
use stickslip_scenario::ScenarioError;

/// Writes the checkpoints of one run: the journal continuously and the state at intervals.
pub struct Keeper {
    place: PathBuf,
    stub: Stub,
    pub(super) journal: Journal,
    /// State at the start of this part of the run.
    pub(super) from: State,
    /// Whether the recorder has already received data of the run.
    pub(super) is_begun: bool,
    /// Start of this part of the run, and total wall time of its earlier parts, s.
    begun: Instant,
    before: f64,
    saved: Instant,
}

impl Keeper {
    /// Starts the checkpoints of a run at intervals of `every` seconds of wall time. The first checkpoint is written immediately.
    ///
    /// An existing checkpoint is removed.
    ///
    /// # Errors
    /// The checkpoint cannot be written.
    pub fn begin(job: &Job, every: f64) -> io::Result<Self> {
        Self::begin_with(job, &job.start, every)
    }

    /// Starts the checkpoints of a run with another initial state, such as a periodic orbit.
    ///
    /// A [`Resumption`](super::Resumption) from the first checkpoint starts the run from this state, too.
    ///
    /// # Errors
    /// The checkpoint cannot be written.
    pub fn begin_with(job: &Job, start: &State, every: f64) -> io::Result<Self> {
        let place = place(&job.folder);
        remove(&job.folder)?;
        fs::create_dir_all(&place)?;
        let mut journal = Journal::create(&place.join(JOURNAL))?;
        folder::write(&place.join(SCENARIO), job.resolved.as_bytes())?;
        let stub = Stub {
            name: job.name.clone(),
            model_key: model_key(&job.scenario),
            run_key: run_key(&job.scenario),
            every,
            end: job.scenario.plan.duration,
            wall: 0.0,
            mark: journal.mark()?,
            state: Vec::new(),
        };
        let mut keeper = Self::new(place, stub, journal, (start.clone(), false));
        keeper.save(job, start)?;
        Ok(keeper)
    }

    /// Continues the checkpoints of an earlier part of the run.
    pub(super) fn go_on(job: &Job, stub: Stub, journal: Journal, from: (State, bool)) -> io::Result<Self> {
        let place = place(&job.folder);
        sweep(&place, &[STATE, SCENARIO]);
        // After a crash the scenario file may have the old or the new end of the run. The run can be resumed with both.
        folder::write(&place.join(SCENARIO), job.resolved.as_bytes())?;
        Ok(Self::new(place, stub, journal, from))
    }

    fn new(place: PathBuf, stub: Stub, journal: Journal, (from, is_begun): (State, bool)) -> Self {
        let (begun, before) = (Instant::now(), stub.wall);
        Self { place, stub, journal, from, is_begun, begun, before, saved: begun }
    }

    /// Returns whether the next checkpoint is due.
    pub(super) fn is_due(&self) -> bool {
        self.saved.elapsed() >= Duration::try_from_secs_f64(self.stub.every).unwrap_or(Duration::MAX)
    }

    /// Returns the wall time of all parts of the run, s.
    pub(super) fn wall(&self) -> f64 {
        self.before + self.begun.elapsed().as_secs_f64()
    }

    /// Writes a checkpoint. The run must be between two time steps.
    pub(super) fn save(&mut self, job: &Job, state: &State) -> io::Result<()> {
        // The journal is written first, so that its length in the state file is never too large.
        self.stub.mark = self.journal.mark()?;
        self.stub.wall = self.wall();
        self.stub.state = state.to_bytes(&job.model, &self.stub.model_key);
        folder::write(&self.place.join(STATE), &self.stub.to_bytes())?;
        System.sync_folder(&self.place)?;
        // The interval starts at the end of the writing, which may take longer than the interval.
        self.saved = Instant::now();
        Ok(())
    }
}

impl Job {
    /// Checks that the integrator of the run supports checkpoints.
    ///
    /// # Errors
    /// The integrator has no checkpoints. The error contains the position of `run.stepper` in the scenario file.
    pub fn check_checkpoints(&self) -> Result<(), ScenarioError> {
        let stepper = self.model.effective(self.scenario.plan.stepper);
        if !matches!(stepper, Stepper::Dopri5 { .. }) {
            return Ok(());
        }
        let message = format!("the stepper \"{}\" has no checkpoints", stepper.name());
        let help = "use \"event\", \"verlet\" or \"rk4\", or run without --checkpoint-every".to_owned();
        Err(self.scenario.locate("run.stepper", message, Some(help)))
    }
}
