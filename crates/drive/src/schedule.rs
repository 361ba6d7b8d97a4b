//! Times of output.

/// Output times of a run, s.
#[derive(Debug, Clone, PartialEq)]
pub enum Moments {
    /// Multiples of this interval (s, above 0), including 0. Each is computed as a product, because a sum would accumulate rounding.
    Every(f64),
    /// Given times, ascending.
    At(Vec<f64>),
}

/// Iterator over the output times of a run, including its start and end.
///
/// Output times are computed one by one, so the use of memory does not depend on their number.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    moments: Moments,
    end: f64,
    /// Distance from the end of the run below which an output time counts as the end, s.
    near: f64,
    /// Index of the next time, an integer.
    next: f64,
    due: f64,
}

/// Distance from the start or end of a run below which an output time is set to that start or end, in intervals.
const SAME: f64 = 1e-9;

/// Limit of the index of an output time, 2⁵³: a larger `f64` cannot be incremented by 1.
const COUNTED: f64 = 9_007_199_254_740_992.0;

impl Moments {
    /// Returns the number of times in a run of `duration` (s) from t = 0, as an `f64` to avoid overflow.
    pub fn count(&self, duration: f64) -> f64 {
        match self {
            Self::Every(interval) => (duration / interval + SAME).floor() + 1.0,
            Self::At(times) => times.len() as f64,
        }
    }
}

impl Schedule {
    /// Returns the output times from `from` to `end`, s, both included.
    pub fn new(moments: Moments, from: f64, end: f64) -> Self {
        let (next, near) = match &moments {
            Moments::Every(interval) => ((from / interval - SAME).ceil().max(0.0), SAME * interval),
            Moments::At(times) => (times.partition_point(|&t| t < from) as f64, 0.0),
        };
        let mut schedule = Self { moments, end, near, next, due: f64::INFINITY };
        let first = schedule.time();
        schedule.due = if (first - from).abs() <= near { from } else { first };
        schedule
    }

    /// Returns the output times after `from` up to and including `end`, s. Used when a run is resumed.
    pub(crate) fn after(moments: Moments, from: f64, end: f64) -> Self {
        let mut schedule = Self::new(moments, from, end);
        if let Moments::Every(interval) = schedule.moments {
            // Exact comparison: a time within rounding after `from` has not been reached.
            schedule.next = (from / interval).floor().max(0.0);
            while interval * schedule.next <= from && schedule.next < COUNTED {
                schedule.next += 1.0;
            }
            schedule.due = schedule.time();
        }
        while schedule.due <= from {
            schedule.advance();
        }
        schedule
    }

    /// Returns the time from which an output time counts as the end of the run, s.
    pub(crate) fn nearly(&self) -> f64 {
        self.end - self.near
    }

    /// Returns the next output time, s; infinite after the last one.
    #[inline]
    pub fn due(&self) -> f64 {
        self.due
    }

    /// Changes the end of the run, s. The new end is not before the time reached.
    pub(crate) fn end_at(&mut self, end: f64) {
        self.end = end;
        self.due = self.time();
    }

    /// Advances to the next output time.
    #[inline]
    pub fn advance(&mut self) {
        self.next += 1.0;
        self.due = self.time();
    }

    /// Computes the next output time, s; infinite after the end of the run.
    #[inline]
    fn time(&self) -> f64 {
        let t = match &self.moments {
            // A product, because a sum of intervals would drift.
            Moments::Every(interval) if self.next < COUNTED => interval * self.next,
            Moments::Every(_) => f64::INFINITY,
            Moments::At(times) => times.get(self.next as usize).copied().unwrap_or(f64::INFINITY),
        };
        // A multiple that misses the end by rounding is the end.
        if t < self.end - self.near {
            t
        } else if t <= self.end + self.near {
            self.end
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(moments: Moments, from: f64, end: f64) -> Vec<f64> {
        let mut schedule = Schedule::new(moments, from, end);
        let mut times = Vec::new();
        while schedule.due() < f64::INFINITY {
            times.push(schedule.due());
            schedule.advance();
        }
        times
    }

    #[test]
    fn multiples_are_products_and_the_ends_are_the_ends() {
        // 3 × 0.1 is above 0.3 by one unit in the last place.
        assert_eq!(all(Moments::Every(0.1), 0.0, 0.3), [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(all(Moments::Every(0.1), 0.1 * 3.0, 0.5), [0.1 * 3.0, 0.4, 0.5]);
        assert_eq!(all(Moments::Every(0.2), 0.3, 0.9), [0.4, 0.2 * 3.0, 0.8]);
        assert_eq!(all(Moments::Every(2.0), 0.0, 1.0), [0.0]);
    }

    #[test]
    fn a_walk_goes_on_where_one_has_been() {
        let on = |from: f64| Schedule::after(Moments::Every(0.1), from, f64::INFINITY).due();
        assert_eq!([on(0.0), on(0.15), on(0.2), on(0.1 * 3.0)], [0.1, 0.2, 0.1 * 3.0, 0.4]);
        // A multiple within rounding after the start is not skipped.
        assert_eq!(on(0.2_f64.next_down()), 0.2);
        let list = Moments::At(vec![0.0, 0.25, 0.5]);
        assert_eq!(Schedule::after(list, 0.25, 1.0).due(), 0.5);
    }

    #[test]
    fn a_list_is_cut_to_the_run() {
        let list = || Moments::At(vec![0.0, 0.25, 0.5, 0.75]);
        assert_eq!(all(list(), 0.0, 0.5), [0.0, 0.25, 0.5]);
        assert_eq!(all(list(), 0.25, 0.7), [0.25, 0.5]);
        assert!(all(Moments::At(Vec::new()), 0.0, 1.0).is_empty());
    }

    #[test]
    fn moments_are_counted_as_they_come() {
        for (moments, end) in [(0.1, 0.3), (0.3, 1.0), (2.0, 1.0), (1e-3, 0.1)]
            .map(|(every, end)| (Moments::Every(every), end))
            .into_iter()
            .chain([(Moments::At(vec![0.1, 0.2]), 1.0)])
        {
            assert_eq!(moments.count(end), all(moments, 0.0, end).len() as f64);
        }
    }
}
