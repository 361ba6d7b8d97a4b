//! Table in memory with the rows and events of a run.

use crate::columns::Columns;
use crate::seal::Seal;
use crate::table;
use std::collections::HashMap;
use std::io;
use stickslip_drive::{Channel, Entry, Event, Model, Record, Wants, state_name};

/// Rows and events of a run in memory. The table is a [`Record`] (receiver of a run's data), or part of a [`Recorder`](crate::Recorder).
///
/// ```no_run
/// # use std::path::Path;
/// # use stickslip_run::{Job, Table};
/// let job = Job::prepare(Path::new("scenarios/p1.json"), &[], Path::new(""))?;
/// let mut table = Table::new(&job.model);
/// let mut state = job.start.clone();
/// stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut table)?;
/// let x = table.column("slider.x_m").unwrap();
/// assert_eq!(x.len(), table.column("time_s").unwrap().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    channels: Vec<Channel>,
    /// Index of each column among all channels of the model.
    taken: Vec<usize>,
    places: HashMap<String, usize>,
    columns: Vec<Vec<f64>>,
    events: Vec<Event>,
    /// Values of the columns immediately after each event, event by event, if they are stored.
    after: Option<Vec<f64>>,
}

impl Table {
    /// Creates an empty table of all channels of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self::of(&Columns::all(&model.channels()))
    }

    /// Creates an empty table of some columns.
    #[must_use]
    pub fn of(columns: &Columns) -> Self {
        let (taken, channels): (_, Vec<Channel>) = columns.places().iter().cloned().unzip();
        let places =
            channels.iter().enumerate().map(|(place, channel)| (channel.name.clone(), place)).collect();
        let columns = vec![Vec::new(); channels.len()];
        Self { channels, taken, places, columns, events: Vec::new(), after: None }
    }

    /// Returns the table with capacity for `rows` rows.
    #[must_use]
    pub fn with_room(mut self, rows: usize) -> Self {
        self.columns.iter_mut().for_each(|column| column.reserve_exact(rows));
        self
    }

    /// Returns the table with the values of the columns immediately after each event.
    #[must_use]
    pub fn with_event_rows(self) -> Self {
        Self { after: Some(Vec::new()), ..self }
    }

    /// Returns all columns in the order of the channels, with the rows after events between the rows of the trace.
    #[must_use]
    pub fn merged(&self) -> Vec<Vec<f64>> {
        let (width, after) = (self.columns.len().max(1), self.after.as_deref().unwrap_or_default());
        let mut merged = vec![Vec::with_capacity(self.rows() + after.len() / width); self.columns.len()];
        let mut events = after.chunks(width).peekable();
        for k in 0..=self.rows() {
            let t = self.columns.first().and_then(|times| times.get(k)).copied().unwrap_or(f64::INFINITY);
            while let Some(row) = events.next_if(|row| row[0] < t) {
                merged.iter_mut().zip(row).for_each(|(column, value)| column.push(*value));
            }
            let row = self.columns.iter().map(|column| column.get(k));
            merged.iter_mut().zip(row).for_each(|(column, value)| column.extend(value));
        }
        merged
    }

    /// Returns the channels in the order of the columns.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Returns the values of a channel such as `slider.x_m`, in SI units. States are given by their codes.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.places.get(name).map(|place| self.columns[*place].as_slice())
    }

    /// Returns the words of a state channel such as `ball.state`. Returns `None` for other channels.
    pub fn states(&self, name: &str) -> Option<impl Iterator<Item = &'static str>> {
        let place = *self.places.get(name)?;
        self.channels[place].is_state.then(|| self.columns[place].iter().map(|code| state_name(*code)))
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Returns all columns in the order of the channels.
    #[must_use]
    pub fn into_columns(self) -> Vec<Vec<f64>> {
        self.columns
    }

    /// Returns row count and SHA-256 of the rows as the file `trace.csv`; `None` if that cannot be computed.
    #[must_use]
    pub fn seal(&self, has_state_numbers: bool) -> Option<Seal> {
        let columns = Columns::all(&self.channels);
        let mut sheet = table::Table::new(io::sink(), columns, &[], has_state_numbers);
        let mut values = Vec::new();
        for k in 0..self.rows() {
            values.clear();
            values.extend(self.columns.iter().map(|column| column[k]));
            sheet.write(&[], &values);
        }
        sheet.finish().ok().map(|written| written.seal)
    }

    /// Returns all events in order of time.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}

impl Record for Table {
    fn take(&mut self, entry: Entry<'_>) {
        match entry {
            Entry::Row(values) => {
                let taken = self.taken.iter().map(|place| values.get(*place).copied().unwrap_or(f64::NAN));
                self.columns.iter_mut().zip(taken).for_each(|(column, value)| column.push(value));
            }
            Entry::Event(event, values) => {
                self.events.push(*event);
                if let Some(after) = &mut self.after {
                    after.extend(
                        self.taken.iter().map(|place| values.get(*place).copied().unwrap_or(f64::NAN)),
                    );
                }
            }
            _ => {}
        }
    }

    fn wants(&self) -> Wants {
        if self.after.is_some() { Wants::default() } else { Wants::bare_events() }
    }
}
