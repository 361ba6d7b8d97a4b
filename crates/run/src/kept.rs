//! Data of a run that are kept in memory for the summary and the plots.

use crate::columns::Columns;
use crate::fingerprint::{Fingerprint, Sketch};
use crate::limits::MOST_VALUES;
use stickslip_drive::Channel;
use stickslip_measure::Series;
use stickslip_measure::Tracks;
use stickslip_scenario::PlotName;

/// Plots that are drawn from rows and from states after events. Other plots are drawn from tables of their own.
pub(crate) const FROM_SERIES: [PlotName; 6] =
    [PlotName::Loop, PlotName::Trajectory, PlotName::Energy, PlotName::Phase, PlotName::Xy, PlotName::Drive];

/// Returns whether the data that a plot needs grow with the duration of the run.
pub(crate) fn grows(plot: PlotName) -> bool {
    FROM_SERIES.contains(&plot) || plot == PlotName::Events
}

/// Returns whether one of the plots is drawn from a time history.
pub(crate) fn draws_from_series(plots: &[PlotName]) -> bool {
    plots.iter().any(|plot| FROM_SERIES.contains(plot))
}

/// Data of a run in memory.
pub struct Kept {
    /// Rows and states after events.
    pub series: Series,
    /// Time reached, s.
    end: f64,
    /// Event times, if a plot shows event times.
    pub tracks: Option<Tracks>,
    /// If events were thinned: time up to which the events are complete, s.
    pub whole_until: Option<f64>,
    /// Number of events dropped because of the memory limit.
    pub left_out: u64,
    /// Maximum number of values. If it is reached, later events are dropped.
    most: u64,
    /// Fingerprint under construction, if requested.
    sketch: Option<Sketch>,
}

impl Kept {
    /// Creates an empty store. Some channels are kept only if the plots in `plots` need them.
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

    /// Returns the store without the data that the plots in `plots` do not need.
    pub(crate) fn for_pictures(self, plots: &[PlotName]) -> Self {
        let tracks = self.tracks.filter(|_| plots.contains(&PlotName::Events));
        let series = if draws_from_series(plots) { self.series } else { Series::none() };
        Self { series, tracks, ..self }
    }

    /// Returns the store with an additional fingerprint of tables with these columns.
    pub fn fingerprinted(self, columns: Columns) -> Self {
        Self { sketch: Some(Sketch::new(columns)), ..self }
    }

    /// Returns the fingerprint of the tables so far. Returns an empty fingerprint if none was requested.
    pub fn fingerprint(&self) -> Fingerprint {
        let nothing = || Sketch::new(Columns::default()).finish();
        self.sketch.as_ref().map_or_else(nothing, Sketch::finish)
    }

    /// Returns whether the caller must pass the sources and kinds of events.
    pub(crate) fn wants_words(&self) -> bool {
        self.tracks.is_some() || self.sketch.is_some()
    }

    /// Adds a row of the trace.
    pub fn row(&mut self, values: &[f64]) {
        self.reach(values);
        self.series.push(values);
        if let Some(sketch) = &mut self.sketch {
            sketch.row(values);
        }
    }

    /// Returns whether events can be added. The number of rows is checked before the run.
    fn has_room(&self) -> bool {
        self.size() < self.most
    }

    /// Adds an event: its source and kind, and the channel values directly after it.
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

    /// Returns the memory used, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<f64>() * self.size() as usize
    }

    /// Returns the number of stored values.
    fn size(&self) -> u64 {
        self.series.size() + self.tracks.as_ref().map_or(0, Tracks::size)
    }

    /// Returns the time reached, s.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Returns the time up to which the events are complete, s.
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
