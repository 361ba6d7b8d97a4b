//! Recorder of a run: writes tables to disk and keeps other data in memory.

mod tables;

pub use tables::Draft;

use crate::Watcher;
use crate::excess::Excess;
use crate::folder::Folder;
use crate::job::Job;
use crate::kept::Kept;
use crate::memory::Table;
use crate::selection::{Selection, TakenEvents};
use std::io;
use stickslip_contact::Memory;
use stickslip_drive::{Due, Entry, EventKind, Record, Source, Wants};
use stickslip_measure::books::Books;
use stickslip_measure::contact_cycles::{ContactCycles, CycleFigures};
use stickslip_measure::marks::Marks;
use stickslip_measure::tally::Tally;
use tables::{Closed, Tables};

/// Records rows, events and snapshots of a run.
pub struct Recorder<'a> {
    job: &'a Job,
    watcher: &'a dyn Watcher,
    tables: Option<Tables<'a>>,
    /// Selected and rounded rows and events, if they are stored in memory.
    table: Option<Table>,
    recorded: Recorded,
    /// Selection of the written rows and events.
    selection: Selection,
    /// Time at which the run is stopped, s.
    until: f64,
    /// Memory limit, B.
    limit: Option<f64>,
    /// Whether rows are written only within a time window.
    has_window: bool,
    /// Whether cycles are stored in memory if there is no table.
    keeps_cycles: bool,
    /// Times at which the evaluations of the run need samples.
    marks: Marks,
    /// Time of a snapshot that has been requested but not yet received, s.
    asked: Option<f64>,
    /// Times of snapshots that are stored in memory, s.
    snapshots: std::vec::IntoIter<f64>,
    /// Buffer for the cycles that end at a sample, with the indices of their contacts.
    ended: Vec<(usize, CycleFigures)>,
}

/// Recorded data of a run. Tables are on disk, all other data in memory.
pub(crate) struct Recorded {
    pub kept: Kept,
    /// Energy balance.
    pub books: Books,
    /// Evaluations during the run.
    pub tally: Tally,
    /// Cycles of each contact.
    pub cycles: Vec<ContactCycles>,
    /// Memory at the end of the run of all data that grow with its duration, B.
    pub bytes: usize,
    /// Numbers of all events and of written events.
    pub events: TakenEvents,
    /// Number of rows of the trace.
    pub rows: u64,
    /// Names of tables that could not be written at all.
    pub absent: Vec<&'static str>,
    /// Written tables.
    pub drafts: Vec<Draft>,
    /// Error that the memory limit was exceeded, if this ended the run.
    pub excess: Option<Excess>,
    /// First write error.
    pub failure: Option<io::Error>,
    /// Selected and rounded rows and events, if they were stored in memory.
    pub table: Option<Table>,
    /// Times, s, and slip memories of all contacts, if they were requested.
    pub snapshots: Vec<(f64, Vec<Memory>)>,
}

impl<'a> Recorder<'a> {
    /// Creates a recorder that stores the data for the plots of the job in memory.
    pub fn new(job: &'a Job, watcher: &'a dyn Watcher) -> Self {
        let channels = job.model.channels();
        let (kept, books) = (Kept::new(&channels, &job.scenario.plots), Books::new(&channels));
        let cycles = vec![ContactCycles::default(); job.model.contacts().count()];
        let tally = Tally::new(job);
        let selection = Selection::new(job.scenario.written.clone(), &channels);
        let events = selection.events();
        let recorded = Recorded {
            kept,
            books,
            tally,
            cycles,
            bytes: 0,
            events,
            rows: 0,
            absent: Vec::new(),
            drafts: Vec::new(),
            excess: None,
            failure: None,
            table: None,
            snapshots: Vec::new(),
        };
        let marks = Marks::of(job);
        Self {
            job,
            watcher,
            tables: None,
            table: None,
            recorded,
            selection,
            until: f64::INFINITY,
            limit: job.scenario.memory_limit,
            has_window: job.scenario.written.window != [0.0, f64::INFINITY],
            keeps_cycles: true,
            marks,
            asked: None,
            snapshots: Vec::new().into_iter(),
            ended: Vec::new(),
        }
    }

    /// Returns the recorder with tables in a folder. Only the rows that plots need are stored in memory.
    ///
    /// # Errors
    /// A table cannot be created.
    pub fn with_tables(mut self, folder: &Folder) -> io::Result<Self> {
        let tables = Tables::begin(self.job, folder, self.selection.has_state_numbers())?;
        self.recorded.kept = self.recorded.kept.for_pictures(&self.job.scenario.plots);
        self.recorded.tally.spill(folder.spare(0)?);
        Ok(Self { tables: Some(tables), ..self })
    }

    /// Returns the recorder with all rows and events of the tables stored in memory.
    pub fn with_table(self) -> Self {
        Self { table: Some(Table::of(&self.job.columns)), ..self }
    }

    /// Returns the recorder with the slip memories of all contacts at these ascending times (s) stored in memory, and with the rows after
    /// events in [`Outcome::table`](crate::Outcome::table). Without tables on disk only.
    pub fn with_snapshots(self, times: Vec<f64>) -> Self {
        let table = self.table.map(Table::with_event_rows);
        Self { snapshots: times.into_iter(), table, ..self }
    }

    /// Returns the recorder with an additional fingerprint of the tables, even if the tables are not written.
    pub fn fingerprinted(mut self) -> Self {
        self.recorded.kept = self.recorded.kept.fingerprinted(self.job.columns.clone());
        self
    }

    /// Returns a recorder that computes only the fingerprint of a run.
    ///
    /// Data that grow with the run are not stored, and the memory limit is not applied.
    ///
    /// # Errors
    /// The temporary file for the strides cannot be created.
    pub fn only_fingerprinted(mut self) -> io::Result<Self> {
        self.recorded.kept = self.recorded.kept.for_pictures(&[]);
        self.recorded.tally.spill(tempfile::tempfile()?);
        Ok(Self { limit: None, keeps_cycles: false, ..self }.fingerprinted())
    }

    /// Returns the recorder for a run that stops at the time `until`, s, at which an earlier run was stopped.
    pub fn until(self, until: f64) -> Self {
        Self { until, ..self }
    }

    /// Requests the snapshot at time `next`, s, again. An infinite time means no further snapshot.
    pub(crate) fn hand_back(&mut self, next: f64) {
        self.asked = Some(next).filter(|next| next.is_finite());
    }

    /// Adds an event with the name of its kind. Returns whether the event is written to the tables.
    pub(crate) fn event_named(&mut self, source: Source, kind: &str, values: &[f64]) -> bool {
        if kind == EventKind::Turn.name() {
            // The reversal of a sticking contact only matters to the evaluation of drive periods; no branch of the contact law ends here.
            self.recorded.tally.account(Some((source, kind)), values);
            return false;
        }
        self.recorded.books.read_event(values);
        self.recorded.tally.row(values);
        self.recorded.tally.account(Some((source, kind)), values);
        self.moment(values, Some(source));
        if !self.selection.takes(source, kind, values.first().copied().unwrap_or(0.0)) {
            return false;
        }
        let values = self.selection.rounded(values);
        // Names are looked up only if they are needed.
        if self.tables.is_none() && !self.recorded.kept.wants_words() {
            self.recorded.kept.event(["", ""], values);
            return true;
        }
        let waveform = |w: usize| self.job.scenario.scene.waveforms.get(w).map(|w| w.name.clone());
        let source = self.job.model.source_name(source, |w| waveform(w).unwrap_or_default());
        if let Some(tables) = &mut self.tables {
            tables.events.write(&[&source, kind], values);
        }
        self.recorded.kept.event([&source, kind], values);
        true
    }

    /// Adds a sample for the evaluations and records the contact cycles that end at this sample.
    fn moment(&mut self, values: &[f64], event: Option<Source>) {
        self.recorded.tally.moment(self.job, (values, event.is_some()), &mut self.ended);
        if !self.ended.is_empty() {
            self.tell_cycles();
        }
    }

    /// Records the cycles that have ended.
    fn tell_cycles(&mut self) {
        for (c, figures) in self.ended.drain(..) {
            let contact = self.job.model.contacts().nth(c).zip(self.recorded.cycles.get_mut(c));
            let Some(((name, law), cycles)) = contact else { continue };
            let judged = cycles.take(self.job, (c, law), figures);
            match &mut self.tables {
                Some(tables) => tables.cycles.write((name, cycles.count), &judged),
                None if self.keeps_cycles => cycles.all.push(judged),
                None => {}
            }
        }
    }

    /// Completes the recorded data at the end of the run.
    fn end(&mut self) {
        self.ended = self.recorded.tally.finish(self.job);
        self.tell_cycles();
        self.recorded.bytes = self.bytes();
        self.recorded.table = self.table.take();
        self.recorded.events = self.selection.events();
        self.recorded.kept.whole_until = self.recorded.events.whole_until;
    }

    /// Ends the drive period with this number.
    fn end_period(&mut self, number: u64) {
        let Some(stride) = self.recorded.tally.end_extents() else { return };
        if let Some(failure) = self.recorded.tally.take_failure() {
            self.fail(failure);
        }
        let steps = self.tables.as_mut().and_then(|tables| tables.steps.as_mut());
        if let (Some(steps), Some(periods)) = (steps, self.marks.figures()) {
            let end = |k: u64| periods.end_of(k as usize);
            steps.write([end(number.saturating_sub(1)), end(number)], stride);
        }
    }

    /// Stores a write error, which ends the run.
    pub(crate) fn fail(&mut self, failure: io::Error) {
        self.recorded.failure.get_or_insert(failure);
    }

    /// Closes the tables. After a write error a table ends with its last complete block, and the result contains the error.
    ///
    /// # Errors
    /// A table cannot be written at all.
    pub(crate) fn finish(mut self) -> io::Result<Recorded> {
        if let Some(tables) = &mut self.tables {
            tables.release();
        }
        self.end();
        if let Some(tables) = self.tables {
            let Closed { drafts, absent, failure } = tables.finish()?;
            let failure = self.recorded.failure.or(failure);
            self.recorded = Recorded { drafts, absent, failure, ..self.recorded };
        }
        Ok(self.recorded)
    }

    /// Returns the recorded data of a recorder without tables.
    pub(crate) fn into_recorded(mut self) -> Recorded {
        self.end();
        self.recorded
    }

    /// Returns the memory used by data that grow with the run, B.
    fn bytes(&self) -> usize {
        let cycles = self.recorded.cycles.iter().map(|cycles| size_of_val(cycles.all.as_slice()));
        self.recorded.kept.bytes() + self.recorded.tally.bytes() + cycles.sum::<usize>()
    }

    /// Returns whether the memory used is within the memory limit.
    fn has_room(&mut self, t: f64) -> bool {
        let Some(limit) = self.limit else { return true };
        let kept = self.bytes() as f64;
        if kept > limit {
            self.recorded.excess = Some(Excess { t, kept, limit });
        }
        kept <= limit
    }

    /// Returns whether the recorder itself does not end the run.
    pub(crate) fn may_continue(&self) -> bool {
        self.recorded.excess.is_none() && !self.has_failed()
    }

    /// Returns whether a write has failed.
    fn has_failed(&self) -> bool {
        self.recorded.failure.is_some() || self.tables.as_ref().is_some_and(Tables::has_failed)
    }
}

impl Recorder<'_> {
    fn row(&mut self, values: &[f64]) {
        self.recorded.tally.row(values);
        self.recorded.books.read(values);
        let values = self.selection.rounded(values);
        if let Some(tables) = &mut self.tables {
            tables.trace.write(&[], values);
        }
        if let Some(table) = &mut self.table {
            table.take(Entry::Row(values));
        }
        self.recorded.rows += 1;
        self.recorded.kept.row(values);
        self.watcher.reached(values.first().copied().unwrap_or(0.0));
    }

    /// Evaluates a row at a requested time: period ends, moments of figures, pulses.
    fn mark(&mut self, values: &[f64]) {
        if self.has_window {
            // Rows outside of the time window are not written, so samples replace them.
            self.recorded.tally.row(values);
            self.recorded.books.read(values);
        }
        self.recorded.tally.account(None, values);
        let t = values.first().copied().unwrap_or(0.0);
        if self.marks.is_common(t) {
            self.moment(values, None);
        }
        match self.marks.period_ended(t) {
            Some(0) => self.recorded.tally.begin_extents(),
            Some(number) => self.end_period(number),
            None => {}
        }
        let pulse = self.marks.pulses.as_mut().and_then(|pulses| pulses.sample(values));
        let table = self.tables.as_mut().and_then(|tables| tables.pulses.as_mut());
        if let (Some(pulse), Some(table)) = (pulse, table) {
            table.write(&pulse);
        }
    }
}

impl Record for Recorder<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => self.row(values),
            Entry::Event(event, values) => {
                let is_written = self.event_named(event.source, event.kind.name(), values);
                if let (true, Some(table)) = (is_written, &mut self.table) {
                    table.take(Entry::Event(event, values));
                }
            }
            Entry::Look(t, memories) => match &mut self.tables {
                Some(tables) => tables.insides.look(memories),
                None => self.recorded.snapshots.push((t, memories.to_vec())),
            },
            Entry::Path(c, segment) => {
                if let Some(tables) = &mut self.tables {
                    tables.insides.path(c, segment);
                }
            }
            Entry::Mark(values) => self.mark(values),
            Entry::Extents(extents) => self.recorded.tally.extents(extents),
            _ => {}
        }
    }

    fn wants(&self) -> Wants {
        Wants {
            paths: self.tables.as_ref().is_some_and(|tables| tables.insides.follows()),
            watched: [self.marks.body, self.marks.foot],
            rows_within: self.selection.window(),
            ..Wants::default()
        }
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        match due {
            Due::Look => self.asked.take().or_else(|| match &mut self.tables {
                Some(tables) => tables.insides.next_look(),
                None => self.snapshots.next(),
            }),
            Due::Mark => self.marks.take_next(),
        }
    }

    fn goes_on(&mut self, t: f64) -> bool {
        self.watcher.reached(t);
        !self.has_failed() && self.has_room(t) && t < self.until && self.watcher.goes_on()
    }
}
