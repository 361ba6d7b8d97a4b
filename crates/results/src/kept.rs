//! What the summary and the pictures are made from: kept while a run goes on, or read back from its tables.

use crate::columns::Columns;
use crate::fingerprint::{Fingerprint, Sketch};
use crate::limits::MOST_VALUES;
use crate::series::Series;
use crate::tracks::Tracks;
use stickslip_drive::Channel;
use stickslip_scenario::PlotName;

/// No place yet.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// What stays in memory of a run.
pub struct Kept {
    /// Rows and moments after events.
    pub series: Series,
    /// Moments after events, and the marks: what figures are taken from, whatever rows are asked for.
    pub moments: Series,
    /// Least and largest x of the body of the figures in each of their periods, m.
    pub ranges: Vec<[f64; 2]>,
    /// The same in the period under way.
    range: [f64; 2],
    /// Moments of the events, where a picture shows them.
    pub tracks: Option<Tracks>,
    /// Events and marks left out for want of room.
    pub left_out: u64,
    /// For a fingerprint, where one is wanted.
    sketch: Option<Sketch>,
}

impl Kept {
    /// Nothing yet, of these channels; what only pictures need is kept for those in `plots`.
    pub fn new(channels: &[Channel], plots: &[PlotName]) -> Self {
        let tracks = plots.contains(&PlotName::Events).then(Tracks::default);
        Self {
            series: Series::new(channels, plots),
            moments: Series::of_figures(channels),
            ranges: Vec::new(),
            range: NOWHERE,
            tracks,
            left_out: 0,
            sketch: None,
        }
    }

    /// The same with a fingerprint of the tables that have these columns.
    pub fn fingerprinted(self, columns: Columns) -> Self {
        Self { sketch: Some(Sketch::new(columns)), ..self }
    }

    /// Fingerprint of the tables so far; that of nothing where none is wanted.
    pub fn fingerprint(&self) -> Fingerprint {
        let nothing = || Sketch::new(Columns::default()).finish();
        self.sketch.as_ref().map_or_else(nothing, Sketch::finish)
    }

    /// Whether the words of events are kept, or come into the fingerprint.
    pub(crate) fn wants_words(&self) -> bool {
        self.tracks.is_some() || self.sketch.is_some()
    }

    /// Takes the next row of the trace.
    pub fn row(&mut self, values: &[f64]) {
        self.series.push(values);
        if let Some(sketch) = &mut self.sketch {
            sketch.row(values);
        }
    }

    /// Takes the row of a mark.
    pub fn mark(&mut self, values: &[f64]) {
        if self.has_room() {
            self.moments.push(values);
        } else {
            self.left_out += 1;
        }
    }

    /// Rows are bounded before the run starts; events and marks are not.
    fn has_room(&self) -> bool {
        self.series.size() + self.moments.size() < 2 * MOST_VALUES
    }

    /// Takes where the body of the figures has been, m.
    pub fn range(&mut self, [least, most]: [f64; 2]) {
        self.range = [self.range[0].min(least), self.range[1].max(most)];
    }

    /// Begins the first period of the figures: what was before it is none of theirs.
    pub fn begin_range(&mut self) {
        self.range = NOWHERE;
    }

    /// Ends a period of the figures.
    pub fn end_range(&mut self) {
        self.ranges.push(std::mem::replace(&mut self.range, NOWHERE));
    }

    /// Takes the next event, its source and kind, and the values after it.
    pub fn event(&mut self, words: [&str; 2], values: &[f64]) {
        if let Some(sketch) = &mut self.sketch {
            sketch.event(words, values);
        }
        if self.has_room() {
            self.series.push(values);
            self.moments.push(values);
            if let (Some(tracks), Some(time)) = (&mut self.tracks, values.first()) {
                tracks.push(words, *time);
            }
        } else {
            self.left_out += 1;
        }
    }

    /// Time reached, s.
    pub fn end(&self) -> f64 {
        self.series.time().last().copied().unwrap_or(0.0)
    }
}
