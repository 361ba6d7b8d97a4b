//! Histogram of durations with preallocated bins.

use crate::room::touched;

/// Upper limit of the fine bins, ns, and width of a fine bin, ns.
const FINE: u64 = 100_000;
const FINE_BIN: u64 = 10;
/// Upper limit of the coarse bins, ns, and width of a coarse bin, ns. Longer durations share one bin.
const COARSE: u64 = 20_000_000;
const COARSE_BIN: u64 = 1_000;

/// Histogram of durations. Counting allocates no memory.
///
/// The bins have a width of 10 ns up to 100 µs and of 1 µs up to 20 ms. Longer durations share one bin.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    fine: Vec<u64>,
    coarse: Vec<u64>,
    beyond: u64,
    count: u64,
    worst: u64,
    sum: u64,
}

impl Histogram {
    /// Creates an empty histogram.
    pub fn new() -> Self {
        let bins = |most: u64, bin: u64| touched(1, 0, (most / bin) as usize);
        Self {
            fine: bins(FINE, FINE_BIN),
            coarse: bins(COARSE, COARSE_BIN),
            beyond: 0,
            count: 0,
            worst: 0,
            sum: 0,
        }
    }

    /// Counts a duration, ns.
    #[inline]
    pub fn count(&mut self, time: u64) {
        if time < FINE {
            self.fine[(time / FINE_BIN) as usize] += 1;
        } else if time < COARSE {
            self.coarse[(time / COARSE_BIN) as usize] += 1;
        } else {
            self.beyond += 1;
        }
        self.count += 1;
        self.worst = self.worst.max(time);
        self.sum = self.sum.saturating_add(time);
    }

    /// Returns the number of counted durations.
    pub fn total(&self) -> u64 {
        self.count
    }

    /// Returns the longest counted duration, ns, or 0 if nothing was counted.
    pub fn worst(&self) -> u64 {
        self.worst
    }

    /// Returns the mean of the counted durations, ns, or 0 if nothing was counted.
    pub fn mean(&self) -> f64 {
        if self.count == 0 { 0.0 } else { self.sum as f64 / self.count as f64 }
    }

    /// Returns a quantile, ns: the upper edge of the bin below which a fraction `share` of the durations lies.
    ///
    /// The result is at most the longest duration. For a `share` of 0.9999 and fewer than 10 000 durations, it is the longest duration.
    pub fn quantile(&self, share: f64) -> u64 {
        let wanted = (share * self.count as f64).ceil() as u64;
        let mut seen = 0;
        let fine = self.fine.iter().enumerate().map(|(i, n)| ((i as u64 + 1) * FINE_BIN, n));
        let coarse = self.coarse.iter().enumerate().map(|(i, n)| ((i as u64 + 1) * COARSE_BIN, n));
        for (edge, count) in fine.chain(coarse) {
            seen += count;
            if *count > 0 && seen >= wanted {
                return edge.min(self.worst);
            }
        }
        self.worst
    }

    /// Returns logarithmic bins as (lower edge, upper edge, count), edges in ns, with `per_decade` bins per decade from 10 ns on.
    ///
    /// The last bin contains all durations above 20 ms. Logarithmic bins that are narrower than the bins of the histogram may be empty.
    pub fn decades(&self, per_decade: u32) -> Vec<(f64, f64, u64)> {
        let edge = |bin: u32| FINE_BIN as f64 * math::powf(10.0, f64::from(bin) / f64::from(per_decade));
        let last = (f64::from(per_decade) * math::log10(COARSE as f64 / FINE_BIN as f64)).ceil() as u32;
        let mut bins: Vec<(f64, f64, u64)> = (0..=last).map(|bin| (edge(bin), edge(bin + 1), 0)).collect();
        let fine = self.fine.iter().enumerate().map(|(i, n)| (i as u64 * FINE_BIN, n));
        let coarse = self.coarse.iter().enumerate().map(|(i, n)| (i as u64 * COARSE_BIN, n));
        for (from, count) in fine.chain(coarse).chain([(COARSE, &self.beyond)]) {
            let place = bins.partition_point(|(_, high, _)| *high <= from as f64 * (1.0 + 1e-12));
            if let Some((.., sum)) = bins.get_mut(place) {
                *sum += count;
            }
        }
        bins
    }

    /// Returns the bins of [`Self::decades`] with ten bins per decade and edges in s.
    pub fn tenths(&self) -> Vec<(f64, f64, u64)> {
        let seconds = |(low, high, count): (f64, f64, u64)| (1e-9 * low, 1e-9 * high, count);
        self.decades(10).into_iter().map(seconds).collect()
    }

    /// Returns the non-empty bins of 1 µs as (lower edge in µs, count), and the number of durations of 20 ms or more.
    pub fn microseconds(&self) -> (impl Iterator<Item = (u64, u64)> + '_, u64) {
        let each = (COARSE_BIN / FINE_BIN) as usize;
        let fine = self.fine.chunks(each).map(|bins| bins.iter().sum::<u64>());
        let coarse = self.coarse.iter().copied().skip((FINE / COARSE_BIN) as usize);
        let all = fine.chain(coarse).enumerate().map(|(i, count)| (i as u64, count));
        (all.filter(|(_, count)| *count > 0), self.beyond)
    }
}

impl Default for Histogram {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_upper_edges_of_bins() {
        let mut histogram = Histogram::new();
        assert_eq!((histogram.quantile(0.5), histogram.worst(), histogram.total()), (0, 0, 0));
        // 9 900 times of 1.234 µs, 99 times of 250.5 µs, one of a minute.
        (0..9_900).for_each(|_| histogram.count(1_234));
        (0..99).for_each(|_| histogram.count(250_500));
        histogram.count(60_000_000_000);
        assert_eq!(histogram.quantile(0.5), 1_240);
        assert_eq!(histogram.quantile(0.99), 1_240);
        assert_eq!(histogram.quantile(0.991), 251_000);
        assert_eq!(histogram.quantile(0.9999), 251_000);
        assert_eq!(histogram.quantile(0.999_95), 60_000_000_000);
        assert_eq!((histogram.worst(), histogram.total()), (60_000_000_000, 10_000));
        let (bins, beyond) = histogram.microseconds();
        assert_eq!((bins.collect::<Vec<_>>(), beyond), (vec![(1, 9_900), (250, 99)], 1));
    }

    #[test]
    fn a_quantile_is_never_longer_than_the_worst() {
        let mut histogram = Histogram::new();
        histogram.count(1_001);
        assert_eq!((histogram.quantile(0.5), histogram.quantile(1.0)), (1_001, 1_001));
    }

    #[test]
    fn decades_have_all_times() {
        let mut histogram = Histogram::new();
        let times = [0, 9, 10, 99, 100, 1_000, 123_456, 19_999_999, 20_000_000, u64::MAX];
        times.into_iter().for_each(|time| histogram.count(time));
        let bins = histogram.decades(10);
        assert_eq!(bins.iter().map(|(.., count)| count).sum::<u64>(), 10);
        let of = |time: f64| bins.iter().find(|(low, high, _)| *low <= time && time < *high).unwrap().2;
        assert_eq!((of(10.5), of(101.0), of(1001.0), of(123_456.0), of(20_000_001.0)), (3, 1, 1, 1, 3));
    }

    #[test]
    fn every_time_has_one_bin() {
        let mut histogram = Histogram::new();
        let edges = [0, 9, 10, 999, 1_000, 99_999, 100_000, 19_999_999, 20_000_000, u64::MAX];
        edges.into_iter().for_each(|time| histogram.count(time));
        let (bins, beyond) = histogram.microseconds();
        let counted: u64 = bins.map(|(_, count)| count).sum();
        assert_eq!((counted, beyond), (8, 2));
    }
}
