//! Output in memory.

use super::{Entry, Record};
use crate::Model;
use crate::event::Event;

/// A record that keeps all rows and events in memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    width: usize,
    values: Vec<f64>,
    events: Vec<Event>,
    after: Vec<f64>,
}

impl Trace {
    /// Returns an empty trace for a model's channels.
    pub fn new(model: &Model) -> Self {
        Self { width: model.channels().len(), ..Self::default() }
    }

    /// Returns the rows in order of time.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.width.max(1))
    }

    /// Returns the events in order of time, each with the row after it.
    pub fn events(&self) -> impl ExactSizeIterator<Item = (&Event, &[f64])> {
        self.events.iter().zip(self.after.chunks_exact(self.width.max(1)))
    }

    /// Returns the values of one column.
    pub fn column(&self, index: usize) -> impl Iterator<Item = f64> + '_ {
        self.rows().filter_map(move |row| row.get(index).copied())
    }
}

impl Record for Trace {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => self.values.extend_from_slice(values),
            Entry::Event(event, values) => {
                self.events.push(*event);
                self.after.extend_from_slice(values);
            }
            _ => {}
        }
    }
}
