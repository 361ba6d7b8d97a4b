//! What the summary and the pictures are made from: kept while a run goes on, or read back from its tables.

use crate::limits::MOST_VALUES;
use crate::series::Series;
use stickslip_drive::Channel;

/// What stays in memory of a run.
pub(crate) struct Kept {
    /// Rows and moments after events.
    pub(crate) series: Series,
    /// Events left out of the series for want of room.
    pub(crate) left_out: u64,
}

impl Kept {
    /// Nothing yet, of these channels.
    pub(crate) fn new(channels: &[Channel]) -> Self {
        Self { series: Series::new(channels), left_out: 0 }
    }

    /// Takes the next row of the trace.
    pub(crate) fn row(&mut self, values: &[f64]) {
        self.series.push(values);
    }

    /// Takes the values after the next event.
    pub(crate) fn event(&mut self, values: &[f64]) {
        // Rows are bounded before the run starts; events are not.
        if self.series.size() < 2 * MOST_VALUES {
            self.series.push(values);
        } else {
            self.left_out += 1;
        }
    }

    /// Time reached, s.
    pub(crate) fn end(&self) -> f64 {
        self.series.time().last().copied().unwrap_or(0.0)
    }
}
