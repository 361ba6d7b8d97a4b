//! Linear recurrence of a sequence, fitted to the differences of its last half.

use crate::sequence::Sequence;
use crate::series::sum;
use nalgebra::{Complex, ComplexField, DMatrix, DVector, Schur};

/// Orders of the recurrences that are fitted.
// These orders distinguish up to three oscillations.
const ORDERS: [usize; 5] = [1, 2, 3, 4, 6];
/// Relative residual below which a recurrence counts as exact. Up to the residual `CLEAN`, the growth factor is that of the root.
const EXACT: f64 = 1e-5;
pub(super) const CLEAN: f64 = 0.03;
/// Maximum number of iterations of an eigenvalue computation, which may not converge for a cyclic shift matrix.
const MOST_TURNS: usize = 1000;
/// Maximum number of fitted values.
const MOST: usize = 4096;
/// Minimum number of oscillation periods for determining the growth factor.
const MANY: f64 = 3.0;
/// Magnitude of a root above which a recurrence is rejected, because it fits rounding errors.
const WILD: f64 = 1.25;
/// Minimum number of values for a fit.
pub(super) const FEWEST: usize = 6;

/// A recurrence fitted to the end of a sequence.
pub(super) struct Recurrence {
    /// Relative residual: ratio of root mean squares, corrected for the degrees of freedom.
    pub(super) rest: f64,
    /// Largest root of the characteristic polynomial: magnitude and angle, rad.
    pub(super) root: (f64, f64),
    /// Extrapolated limit of the sequence.
    pub(super) limit: f64,
    /// Difference between the limits of this recurrence and of a recurrence of another order.
    pub(super) apart: f64,
}

impl Recurrence {
    /// Returns the recurrence of the lowest order with an exact fit, or else the recurrence with the smallest residual.
    pub(super) fn best<S: Sequence + ?Sized>(values: &S) -> Option<Self> {
        let count = values.count();
        if count < FEWEST {
            return None;
        }
        // The transient at the start is omitted.
        let from = if count > 32 {
            (count / 2).max(count.saturating_sub(MOST))
        } else {
            (count / 2).min(count - FEWEST).min(count / 8 + 2)
        };
        let end: Vec<f64> = values.part(from..count).collect();
        let mut best: Option<Self> = None;
        for order in ORDERS {
            let Some(fit) = Self::of(&end, order) else { continue };
            let before = best.as_ref().map_or(f64::INFINITY, |best| best.rest);
            let apart = best.as_ref().map_or(f64::INFINITY, |best| (best.limit - fit.limit).abs());
            if before <= EXACT {
                // The next higher order fits rounding errors, so it is used only for the error of the limit.
                best = best.map(|best| Self { apart: best.apart.min(apart), ..best });
                break;
            }
            if fit.rest < 0.7 * before {
                best = Some(Self { apart, ..fit });
            }
        }
        best
    }

    /// Fits a recurrence of one order. The roots are the eigenvalues of the companion matrix, whose first row is a.
    ///
    /// Returns `None` if there are too few values, if all values are equal, or if a root is implausibly large.
    fn of(values: &[f64], order: usize) -> Option<Self> {
        let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let largest = steps.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let rows = steps
            .len()
            .checked_sub(order)
            .filter(|rows| *rows >= 2 * order && largest > 0.0 && largest.is_finite())?;
        let e = |k: usize| steps[k] / largest;
        let matrix = DMatrix::from_fn(rows, order, |i, j| e(i + order - 1 - j));
        let after = DVector::from_fn(rows, |i, _| e(i + order));
        let a = matrix.clone().try_svd(true, true, f64::EPSILON, MOST_TURNS)?.solve(&after, 1e-13).ok()?;
        if a.iter().any(|a| !a.is_finite()) {
            return None;
        }
        // Without this correction, a fit with many coefficients would look too good.
        let freedom = rows as f64 / (rows - order) as f64;
        let rest = (&matrix * &a - &after).norm() / after.norm() * freedom.sqrt();
        let companion = DMatrix::from_fn(order, order, |i, j| match i {
            0 => a[j],
            _ => f64::from(u8::from(i == j + 1)),
        });
        let roots = Schur::try_new(companion, f64::EPSILON, MOST_TURNS)?.complex_eigenvalues();
        let largest_root = roots.iter().max_by(|p, q| p.modulus().total_cmp(&q.modulus()))?;
        // An oscillation and its harmonics have roots of similar magnitude. The root with the lowest frequency is used.
        let alike =
            |root: &&Complex<f64>| root.modulus() >= 0.995 * largest_root.modulus() && root.argument() != 0.0;
        let slowest =
            roots.iter().filter(alike).min_by(|p, q| p.argument().abs().total_cmp(&q.argument().abs()));
        let root = slowest.filter(|_| largest_root.argument() != 0.0).unwrap_or(largest_root);
        // The sum S of all later differences satisfies S = Σ aⱼ (S + sum of the last j differences).
        let known = |j: usize| sum((0..=j).map(|k| e(steps.len() - 1 - k)));
        let left = sum((0..order).map(|j| a[j] * known(j))) / (1.0 - a.sum());
        let limit = values.last()? + left * largest;
        let is_good = rest.is_finite() && limit.is_finite() && root.modulus() < WILD;
        is_good.then(|| Self {
            rest,
            root: (root.modulus(), root.argument().abs()),
            limit,
            apart: f64::INFINITY,
        })
    }

    /// Returns the growth factor of an oscillation per value.
    ///
    /// The growth factor is the magnitude of the root if the residual is small. Otherwise it follows from the root mean square deviations
    /// at the start and at the end of the last half. Returns `None` for too few periods, or if the two methods contradict each other.
    pub(super) fn growth<S: Sequence + ?Sized>(&self, values: &S, period: f64) -> Option<f64> {
        let (count, middle) = (values.count(), values.count() / 2);
        let half = count - middle;
        let swings = (0.5 * half as f64 / period).floor();
        let span = (swings * period).round() as usize;
        if swings < 1.0 || span >= half || (half as f64) < MANY * period {
            return None;
        }
        let square = |part| sum(values.part(part).map(|value: f64| (value - self.limit).powi(2)));
        let ratio = square(count - span..count) / square(middle..middle + span);
        let envelope = math::powf(ratio, 0.5 / (half - span) as f64);
        let agree = (envelope > 1.0) == (self.root.0 > 1.0);
        let growth = if self.rest > CLEAN { envelope } else { self.root.0 };
        (growth.is_finite() && (agree || self.rest > CLEAN)).then_some(growth)
    }

    /// Returns how many times the last half of the values crosses the limit.
    pub(super) fn crossings<S: Sequence + ?Sized>(&self, values: &S) -> usize {
        let mut above = values.part(values.count() / 2..values.count()).map(|value| value > self.limit);
        let mut before = above.next().unwrap_or_default();
        above.filter(|now| *now != std::mem::replace(&mut before, *now)).count()
    }
}
