//! What a run leaves behind while it goes on: tables on disk, the rest in memory.

use crate::books::Books;
use crate::files::{EVENTS, TRACE};
use crate::folder::Folder;
use crate::insides::Insides;
use crate::job::Job;
use crate::kept::Kept;
use crate::table::Table;
use crate::watcher::Watcher;
use std::io;
use stickslip_contact::Memory;
use stickslip_drive::{Event, Record, Source};
use tempfile::NamedTempFile;

/// Writes rows, events and looks into the contacts as they come.
pub struct Recorder<'a> {
    job: &'a Job,
    watcher: &'a dyn Watcher,
    tables: Option<Tables<'a>>,
    recorded: Recorded,
    /// Time at which the run is stopped, s.
    until: f64,
    /// A look that was asked for already, s.
    asked: Option<f64>,
    failure: Option<io::Error>,
}

/// Tables under construction.
struct Tables<'a> {
    trace: Table,
    events: Table,
    insides: Insides<'a>,
}

/// A written table: its name and its draft.
pub type Draft = (&'static str, NamedTempFile);

/// What was recorded, beside the tables.
pub(crate) struct Recorded {
    pub kept: Kept,
    /// Energies.
    pub books: Books,
    /// Number of rows of the trace.
    pub rows: u64,
    /// The tables, where there are any.
    pub drafts: Vec<Draft>,
}

impl<'a> Recorder<'a> {
    /// Keeps in memory what is wanted.
    pub fn new(job: &'a Job, watcher: &'a dyn Watcher) -> Self {
        let channels = job.model.channels();
        let (kept, books) = (Kept::new(&channels, &job.scenario.plots), Books::new(&channels));
        let recorded = Recorded { kept, books, rows: 0, drafts: Vec::new() };
        Self { job, watcher, tables: None, recorded, until: f64::INFINITY, asked: None, failure: None }
    }

    /// The same with tables in a folder.
    ///
    /// # Errors
    /// A table that cannot be begun.
    pub fn with_tables(self, folder: &Folder) -> io::Result<Self> {
        let columns = &self.job.columns;
        let trace = Table::new(folder.draft(TRACE)?, columns.clone(), &[])?;
        let events = Table::new(folder.draft(EVENTS)?, columns.clone(), &["source", "kind"])?;
        let insides = Insides::new(self.job, folder)?;
        Ok(Self { tables: Some(Tables { trace, events, insides }), ..self })
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
            let written = tables.events.write(&[&source, kind], values);
            self.note(written);
        }
        self.recorded.kept.event([&source, kind], values);
    }

    /// Closes the tables.
    pub(crate) fn finish(mut self) -> io::Result<Recorded> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if let Some(Tables { trace, events, insides }) = self.tables {
            self.recorded.drafts = vec![(TRACE, trace.finish()?), (EVENTS, events.finish()?)];
            self.recorded.drafts.extend(insides.finish()?);
        }
        Ok(self.recorded)
    }

    /// What was recorded by a recorder without tables, which has nothing to fail at.
    pub(crate) fn into_recorded(self) -> Recorded {
        self.recorded
    }

    fn note(&mut self, result: io::Result<()>) {
        if let Err(failure) = result {
            self.failure.get_or_insert(failure);
        }
    }
}

impl Record for Recorder<'_> {
    fn row(&mut self, values: &[f64]) {
        if let Some(tables) = &mut self.tables {
            let written = tables.trace.write(&[], values);
            self.note(written);
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
            let written = tables.insides.look(memories);
            self.note(written);
        }
    }

    fn goes_on(&mut self, t: f64) -> bool {
        self.watcher.reached(t);
        self.failure.is_none() && t < self.until && self.watcher.goes_on()
    }
}
