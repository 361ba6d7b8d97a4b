//! Samples of the free coordinates at common times.

use stickslip_drive::{Entry, Record, Wants};
use stickslip_run::Watcher;

/// Number of sample times after the first; the end of the run is an additional one.
const MOMENTS: usize = 1000;

/// Positions of the free coordinates, m or rad, at t = 0, on a regular grid and at the end.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Samples {
    width: usize,
    values: Vec<f64>,
}

impl Samples {
    /// Returns empty samples of `width` coordinates.
    pub(crate) fn new(width: usize) -> Self {
        Self { width, values: Vec::with_capacity((MOMENTS + 2) * width) }
    }

    /// Returns the interval of the grid, s. The last grid point lies half an interval before the end, so that rounding cannot add a point,
    /// and all phases of a drive are sampled.
    pub(crate) fn interval(duration: f64) -> f64 {
        duration / (MOMENTS as f64 + 0.5)
    }

    /// Returns all times of the grid, s.
    pub(crate) fn grid(duration: f64) -> impl Iterator<Item = f64> {
        (0..=MOMENTS).map(move |k| k as f64 * Self::interval(duration))
    }

    /// Returns the next time of the grid, s, or infinity if only the end is missing.
    pub(crate) fn next(&self, duration: f64) -> f64 {
        let len = self.len();
        if len <= MOMENTS { len as f64 * Self::interval(duration) } else { f64::INFINITY }
    }

    /// Returns the number of sample times of a complete run.
    pub(crate) fn complete() -> usize {
        MOMENTS + 2
    }

    pub(crate) fn push(&mut self, value: f64) {
        self.values.push(value);
    }

    /// Returns the number of sample times so far.
    pub(crate) fn len(&self) -> usize {
        self.values.len() / self.width.max(1)
    }

    /// Returns the coordinates at each sample time.
    pub(crate) fn moments(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.width.max(1))
    }

    /// Returns the last sample.
    pub(crate) fn end(&self) -> &[f64] {
        self.moments().last().unwrap_or(&[])
    }

    /// Returns minimum and maximum of a coordinate.
    pub(crate) fn range(&self, coordinate: usize) -> (f64, f64) {
        let values = self.moments().filter_map(|moment| moment.get(coordinate));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
    }
}

/// Recorder of some columns of the rows, and of the maxima of others.
pub(crate) struct Sampler<'a> {
    pub(crate) samples: Samples,
    columns: &'a [usize],
    /// Columns whose maxima are recorded, with the maxima.
    pub(crate) largest: Vec<(usize, f64)>,
    watcher: &'a dyn Watcher,
}

impl<'a> Sampler<'a> {
    pub(crate) fn new(columns: &'a [usize], watcher: &'a dyn Watcher) -> Self {
        Self { samples: Samples::new(columns.len()), columns, largest: Vec::new(), watcher }
    }

    /// Adds columns whose maxima are recorded.
    pub(crate) fn watching(mut self, columns: impl Iterator<Item = usize>) -> Self {
        self.largest = columns.map(|column| (column, f64::NEG_INFINITY)).collect();
        self
    }
}

impl Record for Sampler<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Row(values) = entry {
            for column in self.columns {
                self.samples.push(values[*column]);
            }
            for (column, largest) in &mut self.largest {
                *largest = largest.max(values[*column]);
            }
        }
    }

    fn wants(&self) -> Wants {
        Wants::no_events()
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}
