//! Tables of a run on disk.

use crate::cycles_table::CyclesTable;
use crate::files::{CYCLES, EVENTS, PULSES, STEPS, TRACE};
use crate::folder::Folder;
use crate::insides::Insides;
use crate::job::Job;
use crate::pulses_table::PulsesTable;
use crate::seal::Seal;
use crate::sheet::{LAST_BLOCK, Written};
use crate::steps_table::StepsTable;
use crate::table::Table;
use std::fs::File;
use std::io;
use stickslip_measure::pulses::Pulses;
use tempfile::NamedTempFile;

/// Maximum number of tables.
const MOST: usize = 9;

/// Tables under construction.
pub(super) struct Tables<'a> {
    pub(super) trace: Table,
    pub(super) events: Table,
    pub(super) cycles: CyclesTable,
    /// Table of steps. `None` if no steps are written.
    pub(super) steps: Option<StepsTable>,
    /// Table of pulses. `None` if no steps are written, or without a burst or a sequence.
    pub(super) pulses: Option<PulsesTable>,
    pub(super) insides: Insides<'a>,
    /// Reserved disk space for the last block of each table.
    reserve: Vec<File>,
}

/// A complete table in a temporary file.
#[derive(Debug)]
pub struct Draft {
    /// Final file name.
    pub name: &'static str,
    /// Temporary file with the table.
    pub file: NamedTempFile,
    /// Row count and SHA-256 of the table for the summary.
    pub seal: Seal,
}

/// Closed tables.
#[derive(Default)]
pub(super) struct Closed {
    pub(super) drafts: Vec<Draft>,
    /// Names of tables that could not be written at all.
    pub(super) absent: Vec<&'static str>,
    /// First write error.
    pub(super) failure: Option<io::Error>,
}

impl<'a> Tables<'a> {
    /// Creates the tables in a folder.
    ///
    /// # Errors
    /// A table cannot be created.
    pub(super) fn begin(job: &'a Job, folder: &Folder, has_state_numbers: bool) -> io::Result<Self> {
        let table = |name, words: &[&'static str]| -> io::Result<Table> {
            Ok(Table::new(folder.draft(name)?, job.columns.clone(), words, has_state_numbers))
        };
        Ok(Self {
            trace: table(TRACE, &[])?,
            events: table(EVENTS, &["source", "kind"])?,
            cycles: CyclesTable::new(folder.draft(CYCLES)?),
            steps: if job.scenario.written.steps {
                Some(StepsTable::new(folder.draft(STEPS)?))
            } else {
                None
            },
            pulses: if job.scenario.written.steps && Pulses::of(job).is_some() {
                Some(PulsesTable::new(folder.draft(PULSES)?))
            } else {
                None
            },
            insides: Insides::new(job, folder)?,
            reserve: (0..MOST).map(|_| folder.spare(LAST_BLOCK)).collect::<io::Result<_>>()?,
        })
    }

    pub(super) fn has_failed(&self) -> bool {
        self.trace.has_failed()
            || self.events.has_failed()
            || self.cycles.has_failed()
            || self.steps.as_ref().is_some_and(StepsTable::has_failed)
            || self.pulses.as_ref().is_some_and(PulsesTable::has_failed)
            || self.insides.has_failed()
    }

    /// Releases the reserved disk space for the last blocks of the tables.
    pub(super) fn release(&mut self) {
        self.reserve.clear();
    }

    /// Closes the tables. After a write error a table ends with its last complete block, and the result contains the error.
    ///
    /// # Errors
    /// A table cannot be written at all.
    pub(super) fn finish(self) -> io::Result<Closed> {
        let mut closed = Closed::default();
        let mut all = vec![(TRACE, self.trace.finish()?), (EVENTS, self.events.finish()?)];
        let mut optional = Vec::new();
        for (name, finished) in [
            (CYCLES, self.cycles.finish()),
            (STEPS, self.steps.map_or(Ok(None), StepsTable::finish)),
            (PULSES, self.pulses.map_or(Ok(None), PulsesTable::finish)),
        ] {
            match finished {
                Ok(written) => optional.extend(written.map(|written| (name, written))),
                // The other tables are useful without this table.
                Err(failure) => {
                    closed.failure.get_or_insert(failure);
                    closed.absent.push(name);
                }
            }
        }
        all.extend(self.insides.finish()?);
        all.extend(optional);
        for (name, Written { file, seal, failure }) in all {
            closed.drafts.push(Draft { name, file, seal });
            closed.failure = closed.failure.or(failure);
        }
        Ok(closed)
    }
}
