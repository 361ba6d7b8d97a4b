//! A run in memory that its caller computes part by part.

use crate::job::Job;
use crate::outcome::{Ended, Outcome};
use crate::record::Recorder;
use self_cell::self_cell;
use std::cell::Cell;
use std::sync::Arc;
use stickslip_drive::{Run, RunError, State, Wall, Watcher};

/// The job of a run, and the number of looks until its next pause.
struct Owner {
    job: Arc<Job>,
    left: Cell<u64>,
    begun: Wall,
}

/// A run with its recorder.
struct Course<'o> {
    run: Run<'o>,
    recorder: Recorder<'o>,
    /// Whether the run has ended, and its error.
    ended: Option<Option<RunError>>,
}

self_cell!(
    struct Going {
        owner: Owner,
        #[not_covariant]
        dependent: Course,
    }
);

impl Watcher for Owner {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(1));
        left > 0
    }
}

/// A run in memory that pauses between time steps, with the rows, events and results of [`Job::run_with_table`] to the bit.
pub struct PartedRun(Going);

impl PartedRun {
    /// Prepares a run that stores the slip memories of all contacts at `snapshots`, ascending times, s, and with them the rows after events.
    ///
    /// # Errors
    /// The errors of [`Run::new`]; in particular, the stepper `dopri5` cannot pause.
    pub fn new(job: Arc<Job>, snapshots: Vec<f64>) -> Result<Self, RunError> {
        let owner = Owner { job, left: Cell::new(0), begun: Wall::begin(true) };
        let going = Going::try_new(owner, |owner| {
            let Owner { job, .. } = owner;
            let run = Run::new(&job.model, &job.scenario.plan, job.start.clone())?;
            let recorder = Recorder::new(job, owner).with_table();
            let recorder = if snapshots.is_empty() { recorder } else { recorder.with_snapshots(snapshots) };
            Ok(Course { run, recorder, ended: None })
        });
        going.map(Self)
    }

    /// Continues the run for at least one time step, until it has been looked at `looks` times, which happens every few steps. Returns
    /// whether the run has ended.
    pub fn go(&mut self, looks: u64) -> bool {
        self.0.with_dependent_mut(|owner, Course { run, recorder, ended }| {
            if ended.is_some() {
                return true;
            }
            owner.left.set(looks.max(1));
            *ended = match run.approach(recorder) {
                Err(RunError::Interrupted { .. }) if recorder.may_continue() => return false,
                Ok(()) => {
                    owner.left.set(u64::MAX);
                    Some(run.finish(recorder).err())
                }
                Err(error) => {
                    run.stop(recorder);
                    Some(Some(error))
                }
            };
            true
        })
    }

    /// Returns the time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.0.with_dependent(|_, course| course.run.state().time())
    }

    /// Ends the run where it stands and returns its results.
    #[must_use]
    pub fn into_outcome(mut self) -> Outcome {
        let wall = self.0.borrow_owner().begun.elapsed();
        self.0.with_dependent_mut(|owner, Course { run, recorder, ended }| {
            let state: State = run.state().clone();
            let error = ended.take().unwrap_or(Some(RunError::Interrupted { t: state.time() }));
            let recorded = std::mem::replace(recorder, Recorder::new(&owner.job, &())).into_recorded();
            Ended { error, state, wall }.outcome(recorded).0
        })
    }
}
