//! What an error costs: the lower left edge of a cloud of runs.

use crate::family::Family;
use crate::norm::Errors;

/// Runs that no other run beats in both error and time, from coarse to fine.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Front {
    /// Errors and seconds.
    points: Vec<(f64, f64)>,
}

/// Time for an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cost {
    /// Between measured runs, s.
    Measured(f64),
    /// Beyond the finest run, along the order of the last runs, s.
    Extrapolated(f64),
    /// Beyond the finest run, where finer runs do not have smaller errors.
    NotReached,
}

/// Decades of error over which the order at the fine end is fitted, and over which it is trusted beyond.
const LAST: f64 = 2.0;
const BEYOND: f64 = 3.0;
/// Points of a fit, at least.
const LEAST_POINTS: usize = 3;
/// Below this order in time a method has come to its end: finer runs cost more and gain next to nothing.
const LEAST_ORDER: f64 = 0.3;

impl Front {
    /// The front of some runs.
    pub(crate) fn new(mut runs: Vec<(f64, f64)>) -> Self {
        runs.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
        let mut points: Vec<(f64, f64)> = Vec::new();
        for (error, wall) in runs {
            if points.last().is_none_or(|(best, _)| error < *best) {
                points.push((error, wall));
            }
        }
        Self { points }
    }

    /// The front of families together.
    pub(crate) fn of<'f, 'p: 'f>(
        families: impl Iterator<Item = &'f Family<'p>>,
        error: impl Fn(&Errors) -> f64,
    ) -> Self {
        let runs = families.flat_map(Family::measured);
        Self::new(runs.map(|(_, result)| (error(&result.errors), result.cost.processor)).collect())
    }

    /// Points in order of time.
    #[cfg(test)]
    pub(crate) fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Time for an error, s: straight between neighbours in the logarithms. None without runs.
    pub(crate) fn cost(&self, error: f64) -> Option<Cost> {
        let (_, coarsest) = *self.points.first()?;
        let Some(place) = self.points.iter().position(|(reached, _)| *reached <= error) else {
            return Some(self.beyond(error));
        };
        if place == 0 {
            return Some(Cost::Measured(coarsest));
        }
        let ((e0, t0), (e1, t1)) = (self.points[place - 1], self.points[place]);
        if e1 == 0.0 {
            return Some(Cost::Measured(t1));
        }
        let part = (error / e0).ln() / (e1 / e0).ln();
        Some(Cost::Measured(t0 * (t1 / t0).powf(part)))
    }

    /// Along the order fitted to the last decades of errors, by least squares in the logarithms.
    fn beyond(&self, error: f64) -> Cost {
        let (finest, longest) = self.points[self.points.len() - 1];
        let first = self.points.iter().position(|(reached, _)| *reached <= finest * 10_f64.powf(LAST));
        let first = first.unwrap_or(0).min(self.points.len().saturating_sub(LEAST_POINTS));
        let last = &self.points[first..];
        let order = order(last);
        let is_trusted = last.len() >= LEAST_POINTS && order >= LEAST_ORDER;
        if !is_trusted || error < finest * 10_f64.powf(-BEYOND) {
            return Cost::NotReached;
        }
        Cost::Extrapolated(longest * (finest / error).powf(1.0 / order))
    }
}

/// Order of the error in the time.
fn order(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|(error, time)| (time.ln(), -error.ln()));
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let covariance: f64 = logs().map(|point| (point.0 - x) * (point.1 - y)).sum();
    covariance / logs().map(|point| (point.0 - x).powi(2)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_is_monotone_and_its_order_leads_beyond_it() {
        // error = 1/t², with runs that are worse in both.
        let runs = [(1.0, 1.0), (0.25, 2.0), (0.3, 3.0), (1.0 / 16.0, 4.0), (0.07, 5.0), (1.0 / 64.0, 8.0)];
        let front = Front::new(runs.to_vec());
        assert_eq!(front.points(), [(1.0, 1.0), (0.25, 2.0), (1.0 / 16.0, 4.0), (1.0 / 64.0, 8.0)]);
        let close = |cost: Option<Cost>, expected: Cost| match (cost, expected) {
            (Some(Cost::Measured(a)), Cost::Measured(b))
            | (Some(Cost::Extrapolated(a)), Cost::Extrapolated(b)) => (a / b - 1.0).abs() < 1e-12,
            (cost, expected) => cost == Some(expected),
        };
        assert!(close(front.cost(0.1), Cost::Measured(10_f64.sqrt())));
        assert!(close(front.cost(2.0), Cost::Measured(1.0)));
        assert_eq!(front.cost(1e-6), Some(Cost::NotReached));
        assert!(close(front.cost(1e-4), Cost::Extrapolated(1e2)));
    }

    #[test]
    fn a_method_at_its_end_is_not_led_on() {
        // A row of springs: below its own error no step helps.
        let front = Front::new(vec![(1.5e-3, 1.0), (1.1e-3, 2.0), (1.01e-3, 4.0), (1e-3, 64.0)]);
        assert_eq!(front.cost(1e-5), Some(Cost::NotReached));
        assert_eq!(Front::default().cost(1.0), None);
        assert_eq!(Front::new(vec![(1.0, 1.0)]).cost(0.5), Some(Cost::NotReached));
    }
}
