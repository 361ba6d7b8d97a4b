//! Execution of a run that writes checkpoints.

use super::keeper::Keeper;
use crate::job::Job;
use crate::outcome::{Ended, Outcome};
use crate::record::{Draft, Recorder};
use std::io;
use stickslip_drive::{Due, Entry, Record, Run, RunError, Wants};

impl Job {
    /// Runs the job and writes checkpoints. The recorder is new, or has received the journal of the interrupted run.
    ///
    /// The last checkpoint of a complete run precedes the time steps that are shortened to reach the end. From there, the run can be
    /// resumed to a later end. A run that is halted by an interrupt or a limit stores its current state. An error keeps the previous
    /// checkpoint. If a checkpoint cannot be written, the run ends, and its results so far are written.
    ///
    /// # Errors
    /// A table cannot be written.
    pub fn run_kept(&self, recorder: Recorder<'_>, keeper: Keeper) -> io::Result<(Outcome, Vec<Draft>)> {
        let (plan, from) = (&self.scenario.plan, keeper.from.clone());
        let begun = if keeper.is_begun {
            Run::resume(&self.model, plan, from)
        } else {
            Run::new(&self.model, plan, from)
        };
        let mut record = Journalled { recorder, keeper, pauses: false };
        let ended = match begun {
            Err(error) => {
                Ended { error: Some(error), state: record.keeper.from.clone(), wall: record.keeper.wall() }
            }
            Ok(run) => record.follow(self, run),
        };
        Ok(ended.outcome(record.recorder.finish()?))
    }
}

/// Recorder that writes a journal and pauses the run when a checkpoint is due.
struct Journalled<'r> {
    recorder: Recorder<'r>,
    keeper: Keeper,
    pauses: bool,
}

impl Journalled<'_> {
    /// Runs until the end, with pauses for checkpoints.
    fn follow(&mut self, job: &Job, mut run: Run<'_>) -> Ended {
        let ended = loop {
            let ended = run.approach(self);
            if ended.as_ref().err().is_none_or(RunError::is_halt)
                && let Err(failure) = self.keeper.save(job, run.state())
            {
                self.recorder.fail(failure);
                break ended;
            }
            // After a pause for a checkpoint the run continues.
            if ended.is_ok() || !std::mem::take(&mut self.pauses) {
                break ended;
            }
        };
        // The following records belong to this end only and not to a continued run. Therefore they are not added to the journal.
        let error = match ended {
            Ok(()) => run.finish(&mut self.recorder).err(),
            Err(error) => {
                run.stop(&mut self.recorder);
                Some(error)
            }
        };
        Ended { error, state: run.into_state(), wall: self.keeper.wall() }
    }
}

impl Record for Journalled<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        self.keeper.journal.take(entry);
        self.recorder.take(entry);
    }

    fn wants(&self) -> Wants {
        self.recorder.wants()
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        self.recorder.next(due)
    }

    fn goes_on(&mut self, t: f64) -> bool {
        let goes_on = self.recorder.goes_on(t);
        // If the journal cannot be written, the run pauses and ends.
        self.pauses = goes_on && (self.keeper.is_due() || self.keeper.journal.has_failed());
        goes_on && !self.pauses
    }
}
