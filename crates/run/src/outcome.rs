//! What came of a run.

use crate::Watcher;
use crate::excess::Excess;
use crate::job::Job;
use crate::kept::Kept;
use crate::memory::Table;
use crate::record::{Draft, Recorded, Recorder};
use crate::selection::TakenEvents;
use std::io;
use stickslip_drive::{RunError, State, Wall};
use stickslip_measure::Strides;
use stickslip_measure::books::Books;
use stickslip_measure::contact_cycles::{ContactCycles, JudgedCycle};
use stickslip_measure::tally::Tally;

/// What came of a run, all of it in memory.
pub struct Outcome {
    /// Why it ended before its time.
    pub error: Option<RunError>,
    /// The state at the end.
    pub state: State,
    /// Series and events.
    pub kept: Kept,
    /// Energies.
    pub(crate) books: Books,
    /// What figures are taken from.
    pub(crate) tally: Tally,
    /// Cycles of each contact.
    pub(crate) cycles: Vec<ContactCycles>,
    /// What became of its events: which are in the table, and in the series.
    pub events: TakenEvents,
    /// What it kept in memory at its end that grows with the run: rows and events, steps and cycles, B.
    pub bytes: usize,
    /// Number of rows of the trace.
    pub rows: u64,
    /// Tables of which nothing could be written.
    pub absent: Vec<&'static str>,
    /// Wall-clock time of the run alone, s.
    pub wall: f64,
    /// That it was ended because it kept more in memory than it may.
    pub excess: Option<Excess>,
    /// Why something could not be written any further: the run has ended for that, and its tables may have ended before it.
    pub failure: Option<io::Error>,
    /// Rows and events as tables would have them, where its recorder kept them.
    pub table: Option<Table>,
}

impl Outcome {
    /// The cycles of contact `c` that come back along u, in order, of a run in memory: one with tables has written them down and
    /// keeps none.
    pub fn cycles(&self, c: usize) -> &[JudgedCycle] {
        self.cycles.get(c).map_or(&[], |cycles| &cycles.all)
    }

    /// Lengths of the steps, m.
    pub fn step_lengths(&self) -> Vec<f64> {
        let strides = self.tally.strides();
        strides.map_or_else(Vec::new, |all| all.part(0..all.count()).map(|stride| stride.length()).collect())
    }
}

impl Job {
    /// Runs the job in memory: nothing is written, and `&()` watches nothing.
    pub fn run(&self, watcher: &dyn Watcher) -> Outcome {
        let (ended, recorder) = Ended::of(self, Recorder::new(self, watcher));
        ended.outcome(recorder.into_recorded()).0
    }

    /// The same with all rows and events that its tables would have, in [`Outcome::table`], and with their fingerprint.
    pub fn run_with_table(&self, watcher: &dyn Watcher) -> Outcome {
        let (ended, recorder) = Ended::of(self, Recorder::new(self, watcher).with_table().fingerprinted());
        ended.outcome(recorder.into_recorded()).0
    }

    /// Runs the job with a recorder that may write tables; returns those it wrote as well.
    ///
    /// # Errors
    /// A table of which nothing can be written.
    pub fn run_recorded(&self, recorder: Recorder<'_>) -> io::Result<(Outcome, Vec<Draft>)> {
        let (ended, recorder) = Ended::of(self, recorder);
        Ok(ended.outcome(recorder.finish()?))
    }
}

/// A run that has ended, still without what was recorded of it.
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

    /// With what was recorded.
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
        };
        (outcome, drafts)
    }
}
