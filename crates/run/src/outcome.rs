//! Results of a run in memory.

use crate::Watcher;
use crate::excess::Excess;
use crate::job::Job;
use crate::kept::Kept;
use crate::memory::Table;
use crate::record::{Draft, Recorded, Recorder};
use crate::selection::TakenEvents;
use std::io;
use stickslip_contact::Memory;
use stickslip_drive::{RunError, State, Wall};
use stickslip_measure::Strides;
use stickslip_measure::books::Books;
use stickslip_measure::contact_cycles::{ContactCycles, JudgedCycle};
use stickslip_measure::tally::Tally;

/// Results of a run in memory.
pub struct Outcome {
    /// Error that ended the run early.
    pub error: Option<RunError>,
    /// State at the end.
    pub state: State,
    /// Time history and events.
    pub kept: Kept,
    /// Energy balance.
    pub(crate) books: Books,
    /// Evaluations during the run.
    pub(crate) tally: Tally,
    /// Cycles of each contact.
    pub(crate) cycles: Vec<ContactCycles>,
    /// Numbers of all events and of written events.
    pub events: TakenEvents,
    /// Memory at the end of the run of all data that grow with its duration, B.
    pub bytes: usize,
    /// Number of rows of the trace.
    pub rows: u64,
    /// Names of tables that could not be written at all.
    pub absent: Vec<&'static str>,
    /// Wall time of the simulation alone, s.
    pub wall: f64,
    /// Error that the memory limit was exceeded, if this ended the run.
    pub excess: Option<Excess>,
    /// First write error, which ended the run. The tables may end before the run.
    pub failure: Option<io::Error>,
    /// Rows and events as written to the tables, if the recorder stored them in memory.
    pub table: Option<Table>,
    /// Times, s, and slip memories of all contacts, if the recorder stored them.
    pub snapshots: Vec<(f64, Vec<Memory>)>,
}

impl Outcome {
    /// Returns the cycles of contact `c` at whose end the displacement u returns to its initial value, in order of time.
    ///
    /// Only a run in memory stores its cycles. A run with tables writes them to `cycles.csv` instead.
    pub fn cycles(&self, c: usize) -> &[JudgedCycle] {
        self.cycles.get(c).map_or(&[], |cycles| &cycles.all)
    }

    /// Returns the step lengths, m.
    pub fn step_lengths(&self) -> Vec<f64> {
        let strides = self.tally.strides();
        strides.map_or_else(Vec::new, |all| all.part(0..all.count()).map(|stride| stride.length()).collect())
    }
}

impl Job {
    /// Runs the job in memory and writes no files. `&()` is a watcher without effect.
    pub fn run(&self, watcher: &dyn Watcher) -> Outcome {
        let (ended, recorder) = Ended::of(self, Recorder::new(self, watcher));
        ended.outcome(recorder.into_recorded()).0
    }

    /// Runs the job in memory and stores its rows, events and fingerprint in [`Outcome::table`] and [`Outcome::kept`].
    pub fn run_with_table(&self, watcher: &dyn Watcher) -> Outcome {
        let (ended, recorder) = Ended::of(self, Recorder::new(self, watcher).with_table().fingerprinted());
        ended.outcome(recorder.into_recorded()).0
    }

    /// Runs the job with a recorder and returns the tables that it has written.
    ///
    /// # Errors
    /// A table cannot be written at all.
    pub fn run_recorded(&self, recorder: Recorder<'_>) -> io::Result<(Outcome, Vec<Draft>)> {
        let (ended, recorder) = Ended::of(self, recorder);
        Ok(ended.outcome(recorder.finish()?))
    }
}

/// Final state, error and wall time of a run, without its recorded data.
pub(crate) struct Ended {
    pub(crate) error: Option<RunError>,
    pub(crate) state: State,
    pub(crate) wall: f64,
}

impl Ended {
    fn of<'a>(job: &Job, mut recorder: Recorder<'a>) -> (Self, Recorder<'a>) {
        let mut state = job.start.clone();
        let begun = Wall::begin(true);
        let result = stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut recorder);
        let wall = begun.elapsed();
        (Self { error: result.err(), state, wall }, recorder)
    }

    /// Combines the final state of a run with its recorded data.
    pub(crate) fn outcome(self, recorded: Recorded) -> (Outcome, Vec<Draft>) {
        let Self { error, state, wall } = self;
        let Recorded {
            kept,
            books,
            tally,
            cycles,
            bytes,
            events,
            rows,
            absent,
            drafts,
            excess,
            failure,
            table,
            snapshots,
        } = recorded;
        let outcome = Outcome {
            error,
            state,
            kept,
            books,
            tally,
            cycles,
            events,
            bytes,
            rows,
            absent,
            wall,
            excess,
            failure,
            table,
            snapshots,
        };
        (outcome, drafts)
    }
}
