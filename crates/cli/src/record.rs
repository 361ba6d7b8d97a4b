//! What a run leaves behind while it goes on: tables on disk, the rest in memory.

use crate::books::Books;
use crate::folder::Folder;
use crate::insides::Insides;
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::kept::Kept;
use crate::progress::Bar;
use crate::table::Table;
use std::io;
use stickslip_contact::Memory;
use stickslip_drive::{Event, Record};

/// Names of the tables.
pub(crate) const TRACE: &str = "trace.csv";
/// Names of the tables.
pub(crate) const EVENTS: &str = "events.csv";

/// Writes rows, events and looks into the contacts as they come.
pub(crate) struct Recorder<'a> {
    job: &'a Job,
    interrupt: &'a Interrupt,
    bar: &'a Bar,
    trace: Table,
    events: Table,
    insides: Insides<'a>,
    recorded: Recorded,
    failure: Option<io::Error>,
}

/// What was recorded, beside the tables.
pub(crate) struct Recorded {
    pub(crate) kept: Kept,
    /// Energies.
    pub(crate) books: Books,
    /// Number of rows of the trace.
    pub(crate) rows: u64,
}

impl<'a> Recorder<'a> {
    /// Opens the tables.
    pub(crate) fn new(
        job: &'a Job,
        interrupt: &'a Interrupt,
        bar: &'a Bar,
        folder: &Folder,
    ) -> io::Result<Self> {
        let channels = job.model.channels();
        Ok(Self {
            job,
            interrupt,
            bar,
            trace: Table::new(folder.draft(TRACE)?, job.columns.clone(), &[])?,
            events: Table::new(folder.draft(EVENTS)?, job.columns.clone(), &["source", "kind"])?,
            insides: Insides::new(job, folder)?,
            recorded: Recorded { kept: Kept::new(&channels), books: Books::new(&channels), rows: 0 },
            failure: None,
        })
    }

    /// Closes the tables.
    pub(crate) fn finish(self, folder: &mut Folder) -> io::Result<Recorded> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        folder.stage(TRACE, self.trace.finish()?)?;
        folder.stage(EVENTS, self.events.finish()?)?;
        self.insides.finish(folder)?;
        Ok(self.recorded)
    }

    fn note(&mut self, result: io::Result<()>) {
        if let Err(failure) = result {
            self.failure.get_or_insert(failure);
        }
    }
}

impl Record for Recorder<'_> {
    fn row(&mut self, values: &[f64]) {
        let written = self.trace.write(&[], values);
        self.note(written);
        self.recorded.rows += 1;
        self.recorded.kept.row(values);
        self.recorded.books.read(values);
        self.bar.at(values.first().copied().unwrap_or(0.0));
    }

    fn event(&mut self, event: &Event, values: &[f64]) {
        let waveform = |w: usize| self.job.scenario.scene.waveforms.get(w).map(|w| w.name.clone());
        let source = self.job.model.source_name(event.source, |w| waveform(w).unwrap_or_default());
        let written = self.events.write(&[&source, event.kind.name()], values);
        self.note(written);
        self.recorded.books.read(values);
        self.recorded.kept.event(values);
    }

    fn next_look(&mut self) -> Option<f64> {
        self.insides.next_look()
    }

    fn look(&mut self, _: f64, memories: &[Memory]) {
        let written = self.insides.look(memories);
        self.note(written);
    }

    fn goes_on(&mut self, t: f64) -> bool {
        self.bar.at(t);
        self.failure.is_none() && !self.interrupt.is_raised()
    }
}
