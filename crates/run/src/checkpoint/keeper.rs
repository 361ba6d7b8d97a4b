//! Checkpoints of a run under way.

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

/// Keeps checkpoints of one run: its journal, and a state from time to time.
pub struct Keeper {
    place: PathBuf,
    stub: Stub,
    pub(super) journal: Journal,
    /// Where the run begins, or goes on from.
    pub(super) from: State,
    /// Whether its record has been told of what came before.
    pub(super) is_begun: bool,
    /// When this part of the run began, by the clock on the wall, and how long the parts before it took, s.
    begun: Instant,
    before: f64,
    saved: Instant,
}

impl Keeper {
    /// Begins the checkpoints of a job, `every` so many seconds of wall time; the first one, of the start, is taken at once.
    /// What an earlier run has kept is gone.
    ///
    /// # Errors
    /// What the system says of writing them.
    pub fn begin(job: &Job, every: f64) -> io::Result<Self> {
        Self::begin_with(job, &job.start, every)
    }

    /// The same of a run that begins with another state, from which [`Resumption`](super::Resumption) then begins it, such as a
    /// steady motion.
    ///
    /// # Errors
    /// What the system says of writing them.
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

    /// Goes on with the checkpoints of an earlier part of the run.
    pub(super) fn go_on(job: &Job, stub: Stub, journal: Journal, from: (State, bool)) -> io::Result<Self> {
        let place = place(&job.folder);
        sweep(&place, &[STATE, SCENARIO]);
        // Either end is one of this run: whichever of the two files is there after a crash, it can go on.
        folder::write(&place.join(SCENARIO), job.resolved.as_bytes())?;
        Ok(Self::new(place, stub, journal, from))
    }

    fn new(place: PathBuf, stub: Stub, journal: Journal, (from, is_begun): (State, bool)) -> Self {
        let (begun, before) = (Instant::now(), stub.wall);
        Self { place, stub, journal, from, is_begun, begun, before, saved: begun }
    }

    /// Whether it is time for the next one.
    pub(super) fn is_due(&self) -> bool {
        self.saved.elapsed() >= Duration::try_from_secs_f64(self.stub.every).unwrap_or(Duration::MAX)
    }

    /// Wall time of the run with all its parts, s.
    pub(super) fn wall(&self) -> f64 {
        self.before + self.begun.elapsed().as_secs_f64()
    }

    /// Takes a checkpoint: the run stands between two steps.
    pub(super) fn save(&mut self, job: &Job, state: &State) -> io::Result<()> {
        // The journal first: a state never counts what is not there.
        self.stub.mark = self.journal.mark()?;
        self.stub.wall = self.wall();
        self.stub.state = state.to_bytes(&job.model, &self.stub.model_key);
        folder::write(&self.place.join(STATE), &self.stub.to_bytes())?;
        System.sync_folder(&self.place)?;
        // From its end: writing may take longer than the interval.
        self.saved = Instant::now();
        Ok(())
    }
}

impl Job {
    /// Whether the stepper of the run can go on from a checkpoint.
    ///
    /// # Errors
    /// A stepper that cannot, with its place in the scenario.
    pub fn check_checkpoints(&self) -> Result<(), ScenarioError> {
        let stepper = self.model.effective(self.scenario.plan.stepper);
        if !matches!(stepper, Stepper::Dopri5 { .. }) {
            return Ok(());
        }
        let message = format!("the stepper \"{}\" keeps no checkpoints", stepper.name());
        let help = "take \"event\", \"verlet\" or \"rk4\", or run without --checkpoint-every".to_owned();
        Err(self.scenario.locate("run.stepper", message, Some(help)))
    }
}
