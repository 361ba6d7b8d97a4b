//! What a run leaves behind while it goes on: tables on disk, the rest in memory.

use crate::books::Books;
use crate::files::{EVENTS, TRACE};
use crate::folder::Folder;
use crate::insides::Insides;
use crate::job::Job;
use crate::kept::Kept;
use crate::marks::Marks;
use crate::seal::Seal;
use crate::sheet::{LAST_BLOCK, Written};
use crate::table::Table;
use crate::watcher::Watcher;
use std::fs::File;
use std::io;
use stickslip_contact::{Memory, Segment};
use stickslip_drive::{Event, Record, Source};
use tempfile::NamedTempFile;

/// Most tables of a run that are written as it goes on.
const TABLES: usize = 6;
/// Writes rows, events and looks into the contacts as they come.
pub struct Recorder<'a> {
    job: &'a Job,
    watcher: &'a dyn Watcher,
    tables: Option<Tables<'a>>,
    recorded: Recorded,
    /// Time at which the run is stopped, s.
    until: f64,
    /// Where the figures are taken.
    marks: Marks,
    /// Room on the disk for the last blocks of the tables, each for itself.
    reserve: Vec<File>,
    /// A look that was asked for already, s.
    asked: Option<f64>,
}

/// Tables under construction.
struct Tables<'a> {
    trace: Table,
    events: Table,
    insides: Insides<'a>,
}

/// A written table, still without its name.
#[derive(Debug)]
pub struct Draft {
    /// The name that is meant for it.
    pub name: &'static str,
    /// The file.
    pub file: NamedTempFile,
    /// What a summary says of it.
    pub seal: Seal,
}

/// What was recorded, beside the tables.
pub(crate) struct Recorded {
    pub kept: Kept,
    /// Energies.
    pub books: Books,
    /// Number of rows of the trace.
    pub rows: u64,
    /// The tables, where there are any.
    pub drafts: Vec<Draft>,
    /// Why something could not be written any further.
    pub failure: Option<io::Error>,
}

impl<'a> Recorder<'a> {
    /// Keeps in memory what is wanted.
    pub fn new(job: &'a Job, watcher: &'a dyn Watcher) -> Self {
        let channels = job.model.channels();
        let (kept, books) = (Kept::new(&channels, &job.scenario.plots), Books::new(&channels));
        let recorded = Recorded { kept, books, rows: 0, drafts: Vec::new(), failure: None };
        let marks = Marks::of(job);
        Self {
            job,
            watcher,
            tables: None,
            recorded,
            until: f64::INFINITY,
            marks,
            reserve: Vec::new(),
            asked: None,
        }
    }

    /// The same with tables in a folder.
    ///
    /// # Errors
    /// A table that cannot be begun.
    pub fn with_tables(self, folder: &Folder) -> io::Result<Self> {
        let columns = &self.job.columns;
        let trace = Table::new(folder.draft(TRACE)?, columns.clone(), &[]);
        let events = Table::new(folder.draft(EVENTS)?, columns.clone(), &["source", "kind"]);
        let insides = Insides::new(self.job, folder)?;
        let reserve = (0..TABLES).map(|_| folder.spare(LAST_BLOCK)).collect::<io::Result<_>>()?;
        Ok(Self { tables: Some(Tables { trace, events, insides }), reserve, ..self })
    }

    /// The same with a fingerprint of the tables, written or not.
    pub fn fingerprinted(mut self) -> Self {
        self.recorded.kept = self.recorded.kept.fingerprinted(self.job.columns.clone());
        self
    }

    /// The same for a run that is to stop at a time, s, at which an earlier one was stopped.
    pub fn until(self, until: f64) -> Self {
        Self { until, ..self }
    }

    /// Takes back the look that was asked for last, s; it is the next again.
    pub(crate) fn hand_back(&mut self, next: f64) {
        self.asked = Some(next).filter(|next| next.is_finite());
    }

    /// Takes an event whose kind is given by its word.
    pub(crate) fn event_named(&mut self, source: Source, kind: &str, values: &[f64]) {
        self.recorded.books.read_event(values);
        // Names are for those who want them: of a hundred thousand runs in memory nobody reads one.
        if self.tables.is_none() && !self.recorded.kept.wants_words() {
            self.recorded.kept.event(["", ""], values);
            return;
        }
        let waveform = |w: usize| self.job.scenario.scene.waveforms.get(w).map(|w| w.name.clone());
        let source = self.job.model.source_name(source, |w| waveform(w).unwrap_or_default());
        if let Some(tables) = &mut self.tables {
            tables.events.write(&[&source, kind], values);
        }
        self.recorded.kept.event([&source, kind], values);
    }

    /// Ends the run, for something beside its tables cannot be written.
    pub(crate) fn fail(&mut self, failure: io::Error) {
        self.recorded.failure.get_or_insert(failure);
    }

    /// Closes the tables. One that could not be written any further ends with its last whole block, and the failure is
    /// told with what was recorded.
    ///
    /// # Errors
    /// A table of which nothing could be written.
    pub(crate) fn finish(mut self) -> io::Result<Recorded> {
        // Their last blocks have room, whatever else is full.
        self.reserve.clear();
        if let Some(Tables { trace, events, insides }) = self.tables {
            let written = [(TRACE, trace.finish()?), (EVENTS, events.finish()?)];
            for (name, Written { file, seal, failure }) in written.into_iter().chain(insides.finish()?) {
                self.recorded.drafts.push(Draft { name, file, seal });
                self.recorded.failure = self.recorded.failure.or(failure);
            }
        }
        Ok(self.recorded)
    }

    /// What was recorded by a recorder without tables, which has nothing to fail at.
    pub(crate) fn into_recorded(self) -> Recorded {
        self.recorded
    }

    /// Whether something cannot be written any further.
    fn has_failed(&self) -> bool {
        self.recorded.failure.is_some() || self.tables.as_ref().is_some_and(Tables::has_failed)
    }
}

impl Tables<'_> {
    fn has_failed(&self) -> bool {
        self.trace.has_failed() || self.events.has_failed() || self.insides.has_failed()
    }
}

impl Record for Recorder<'_> {
    fn row(&mut self, values: &[f64]) {
        if let Some(tables) = &mut self.tables {
            tables.trace.write(&[], values);
        }
        self.recorded.rows += 1;
        self.recorded.kept.row(values);
        self.recorded.books.read(values);
        self.watcher.reached(values.first().copied().unwrap_or(0.0));
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        self.event_named(event.source, event.kind.name(), values);
    }

    fn next_look(&mut self) -> Option<f64> {
        self.asked.take().or_else(|| self.tables.as_mut()?.insides.next_look())
    }

    fn look(&mut self, _: f64, memories: &[Memory]) {
        if let Some(tables) = &mut self.tables {
            tables.insides.look(memories);
        }
    }

    fn follows(&self) -> bool {
        self.tables.as_ref().is_some_and(|tables| tables.insides.follows())
    }

    fn path(&mut self, c: usize, segment: Segment) {
        if let Some(tables) = &mut self.tables {
            tables.insides.path(c, segment);
        }
    }

    fn next_mark(&mut self) -> Option<f64> {
        self.marks.next()
    }

    fn mark(&mut self, values: &[f64]) {
        self.recorded.kept.mark(values);
        match self.marks.period_ended(values.first().copied().unwrap_or(0.0)) {
            Some(0) => self.recorded.kept.begin_range(),
            Some(_) => self.recorded.kept.end_range(),
            None => {}
        }
    }

    fn watched(&self) -> Option<usize> {
        self.marks.body
    }

    fn range(&mut self, range: [f64; 2]) {
        self.recorded.kept.range(range);
    }

    fn goes_on(&mut self, t: f64) -> bool {
        self.watcher.reached(t);
        !self.has_failed() && t < self.until && self.watcher.goes_on()
    }
}
