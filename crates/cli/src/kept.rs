//! What the summary and the pictures are made from: kept while a run goes on, or read back from its tables.

use crate::fingerprint::{Fingerprint, Sketch};
use crate::limits::MOST_VALUES;
use crate::series::Series;
use crate::table::Columns;
use crate::tracks::Tracks;
use stickslip_drive::Channel;
use stickslip_scenario::PlotName;

/// What stays in memory of a run.
pub(crate) struct Kept {
    /// Rows and moments after events.
    pub(crate) series: Series,
    /// Moments of the events, where a picture shows them.
    pub(crate) tracks: Option<Tracks>,
    /// Events left out of the series for want of room.
    pub(crate) left_out: u64,
    /// For a fingerprint, where one is wanted.
    sketch: Option<Sketch>,
}

impl Kept {
    /// Nothing yet, of these channels; what only pictures need is kept for those in `plots`.
    pub(crate) fn new(channels: &[Channel], plots: &[PlotName]) -> Self {
        let tracks = plots.contains(&PlotName::Events).then(Tracks::default);
        Self { series: Series::new(channels, plots), tracks, left_out: 0, sketch: None }
    }

    /// The same with a fingerprint of the tables that have these columns.
    pub(crate) fn fingerprinted(self, columns: Columns) -> Self {
        Self { sketch: Some(Sketch::new(columns)), ..self }
    }

    /// Fingerprint of the tables so far; that of nothing where none is wanted.
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        let nothing = || Sketch::new(Columns::default()).finish();
        self.sketch.as_ref().map_or_else(nothing, Sketch::finish)
    }

    /// Takes the next row of the trace.
    pub(crate) fn row(&mut self, values: &[f64]) {
        self.series.push(values);
        if let Some(sketch) = &mut self.sketch {
            sketch.row(values);
        }
    }

    /// Takes the next event, its source and kind, and the values after it.
    pub(crate) fn event(&mut self, words: [&str; 2], values: &[f64]) {
        if let Some(sketch) = &mut self.sketch {
            sketch.event(words, values);
        }
        // Rows are bounded before the run starts; events are not.
        if self.series.size() < 2 * MOST_VALUES {
            self.series.push(values);
            if let (Some(tracks), Some(time)) = (&mut self.tracks, values.first()) {
                tracks.push(words, *time);
            }
        } else {
            self.left_out += 1;
        }
    }

    /// Time reached, s.
    pub(crate) fn end(&self) -> f64 {
        self.series.time().last().copied().unwrap_or(0.0)
    }
}
