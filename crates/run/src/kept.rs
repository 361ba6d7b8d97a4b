//! What the summary and the pictures are made from: kept while a run goes on, or read back from its tables.

use crate::columns::Columns;
use crate::fingerprint::{Fingerprint, Sketch};
use crate::limits::MOST_VALUES;
use stickslip_drive::Channel;
use stickslip_measure::Series;
use stickslip_measure::Tracks;
use stickslip_scenario::PlotName;

/// Pictures that are drawn from rows and moments after events; the others have tables of their own, or nothing over time.
pub(crate) const FROM_SERIES: [PlotName; 6] =
    [PlotName::Loop, PlotName::Trajectory, PlotName::Energy, PlotName::Phase, PlotName::Xy, PlotName::Drive];

/// Whether a picture is drawn from what grows with the run.
pub(crate) fn grows(plot: PlotName) -> bool {
    FROM_SERIES.contains(&plot) || plot == PlotName::Events
}

/// Whether one of these pictures is drawn from a series.
pub(crate) fn draws_from_series(plots: &[PlotName]) -> bool {
    plots.iter().any(|plot| FROM_SERIES.contains(plot))
}

/// What stays in memory of a run.
pub struct Kept {
    /// Rows and moments after events.
    pub series: Series,
    /// Time reached, s.
    end: f64,
    /// Moments of the events, where a picture shows them.
    pub tracks: Option<Tracks>,
    /// Time until which the events that were asked for are there without a gap, s, where they were thinned.
    pub whole_until: Option<f64>,
    /// Events left out for want of room.
    pub left_out: u64,
    /// Most numbers that events may add to.
    most: u64,
    /// For a fingerprint, where one is wanted.
    sketch: Option<Sketch>,
}

impl Kept {
    /// Nothing yet, of these channels; what only pictures need is kept for those in `plots`.
    pub fn new(channels: &[Channel], plots: &[PlotName]) -> Self {
        let tracks = plots.contains(&PlotName::Events).then(Tracks::default);
        Self {
            series: Series::new(channels, plots),
            end: 0.0,
            tracks,
            whole_until: None,
            left_out: 0,
            most: 2 * MOST_VALUES,
            sketch: None,
        }
    }

    /// The same with a series and tracks only where one of these pictures is drawn from them.
    pub(crate) fn for_pictures(self, plots: &[PlotName]) -> Self {
        let tracks = self.tracks.filter(|_| plots.contains(&PlotName::Events));
        let series = if draws_from_series(plots) { self.series } else { Series::none() };
        Self { series, tracks, ..self }
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
        self.reach(values);
        self.series.push(values);
        if let Some(sketch) = &mut self.sketch {
            sketch.row(values);
        }
    }

    /// Rows are bounded before the run starts; events are not.
    fn has_room(&self) -> bool {
        self.size() < self.most
    }

    /// Takes the next event, its source and kind, and the values after it.
    pub fn event(&mut self, words: [&str; 2], values: &[f64]) {
        if let Some(sketch) = &mut self.sketch {
            sketch.event(words, values);
        }
        self.reach(values);
        if self.has_room() {
            self.series.push(values);
            if let (Some(tracks), Some(time)) = (&mut self.tracks, values.first()) {
                tracks.push(words, *time);
            }
        } else {
            self.left_out += 1;
        }
    }

    /// What it takes, B.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<f64>() * self.size() as usize
    }

    /// Numbers kept: of the series and of the tracks.
    fn size(&self) -> u64 {
        self.series.size() + self.tracks.as_ref().map_or(0, Tracks::size)
    }

    /// Time reached, s.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Until when its series has all events that were asked for, s.
    pub fn whole_until(&self) -> f64 {
        self.whole_until.map_or(self.end, |whole| whole.min(self.end))
    }

    fn reach(&mut self, values: &[f64]) {
        self.end = values.first().copied().unwrap_or(self.end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_events_are_bounded_without_a_series_as_well() {
        let plots = [PlotName::Events];
        let mut kept = Kept { most: 10, ..Kept::new(&[], &plots).for_pictures(&plots) };
        (0..25).for_each(|k| kept.event(["ball", "touch"], &[f64::from(k)]));
        assert_eq!((kept.size(), kept.bytes(), kept.left_out, kept.end()), (10, 80, 15, 24.0));
        assert_eq!(kept.for_pictures(&[]).size(), 0);
    }
}
