//! Pareto front of error and run time.

use crate::family::Family;
use crate::norm::Errors;

/// Runs that no other run surpasses in both error and time, from coarse to fine.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Front {
    /// Errors and times, s.
    points: Vec<(f64, f64)>,
}

/// Time for an error, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cost {
    /// Interpolated between measured runs.
    Measured(f64),
    /// More than this time: no run reaches the error.
    Above(f64),
}

impl Front {
    /// Returns the front of runs (error, time).
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

    /// Returns the common front of several methods.
    pub(crate) fn of<'f, 'p: 'f>(
        families: impl Iterator<Item = &'f Family<'p>>,
        error: impl Fn(&Errors) -> f64,
    ) -> Self {
        let runs = families.flat_map(Family::measured);
        Self::new(runs.map(|(_, result)| (error(&result.errors), result.cost.processor)).collect())
    }

    /// Returns the points in order of time.
    #[cfg(test)]
    pub(crate) fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Returns the time for an error, s, by linear interpolation in the logarithms. Returns `None` without runs.
    pub(crate) fn cost(&self, error: f64) -> Option<Cost> {
        let (_, coarsest) = *self.points.first()?;
        let Some(place) = self.points.iter().position(|(reached, _)| *reached <= error) else {
            return self.points.last().map(|(_, longest)| Cost::Above(*longest));
        };
        if place == 0 {
            return Some(Cost::Measured(coarsest));
        }
        let ((e0, t0), (e1, t1)) = (self.points[place - 1], self.points[place]);
        if e1 == 0.0 {
            return Some(Cost::Measured(t1));
        }
        let part = math::ln(error / e0) / math::ln(e1 / e0);
        Some(Cost::Measured(t0 * math::powf(t1 / t0, part)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_is_monotone_and_nothing_is_told_beyond_it() {
        // error = 1/t², with runs that are worse in both.
        let runs = [(1.0, 1.0), (0.25, 2.0), (0.3, 3.0), (1.0 / 16.0, 4.0), (0.07, 5.0), (1.0 / 64.0, 8.0)];
        let front = Front::new(runs.to_vec());
        assert_eq!(front.points(), [(1.0, 1.0), (0.25, 2.0), (1.0 / 16.0, 4.0), (1.0 / 64.0, 8.0)]);
        let Some(Cost::Measured(between)) = front.cost(0.1) else { panic!("{front:?}") };
        assert!((between / 10_f64.sqrt() - 1.0).abs() < 1e-12, "{between}");
        assert_eq!(front.cost(2.0), Some(Cost::Measured(1.0)));
        assert_eq!(front.cost(1e-2), Some(Cost::Above(8.0)));
        assert_eq!(Front::default().cost(1.0), None);
    }
}
