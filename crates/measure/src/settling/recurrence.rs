//! The linear recurrence that the last half of a sequence obeys, fitted to its differences.

use crate::sequence::Sequence;
use crate::series::sum;
use nalgebra::{Complex, ComplexField, DMatrix, DVector, Schur};

/// Orders of recurrences that are tried.
// Three lines of a spectrum are told apart; what needs more is called irregular. With order 2 alone the growth of a beat whose
// first overtone is a tenth of it comes out with the wrong sign.
const ORDERS: [usize; 5] = [1, 2, 3, 4, 6];
/// What a recurrence may leave of the differences to count as exact, and where growth is to be read off it.
const EXACT: f64 = 1e-5;
pub(super) const CLEAN: f64 = 0.03;
/// Most iterations of a decomposition: a shift of exactly four values never comes to an end.
const MOST_TURNS: usize = 1000;
/// Most values that are fitted.
const MOST: usize = 4096;
/// Swings of which the growth is told.
const MANY: f64 = 3.0;
/// No drive grows by that much in a period: a recurrence with such a root fits rounding.
const WILD: f64 = 1.25;
/// Least number of values to read a recurrence off.
pub(super) const FEWEST: usize = 6;

/// A recurrence fitted to the end of a sequence.
pub(super) struct Recurrence {
    /// What it leaves of the differences: root mean squares over each other, that of what is left by its degrees of freedom.
    pub(super) rest: f64,
    /// The largest root: its magnitude and its angle.
    pub(super) root: (f64, f64),
    /// Where the sequence goes.
    pub(super) limit: f64,
    /// How far that is from the limit by another order.
    pub(super) apart: f64,
}

impl Recurrence {
    /// The lowest order that leaves nothing, or else the one that leaves least.
    pub(super) fn best<S: Sequence + ?Sized>(values: &S) -> Option<Self> {
        let count = values.count();
        if count < FEWEST {
            return None;
        }
        // The way in is left out: the half of a long sequence, the first two values of a short one.
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
                // One order more tells how sure the limit is, and nothing else: it fits rounding.
                best = best.map(|best| Self { apart: best.apart.min(apart), ..best });
                break;
            }
            if fit.rest < 0.7 * before {
                best = Some(Self { apart, ..fit });
            }
        }
        best
    }

    /// Of one order; none where there are too few values, all are equal, or a root says that it fits rounding. The roots are the
    /// eigenvalues of the companion matrix, whose first row is a.
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
        // What is fitted leaves less than it should by its own freedom: six coefficients make a pattern of thirteen numbers of chaos.
        let freedom = rows as f64 / (rows - order) as f64;
        let rest = (&matrix * &a - &after).norm() / after.norm() * freedom.sqrt();
        let companion = DMatrix::from_fn(order, order, |i, j| match i {
            0 => a[j],
            _ => f64::from(u8::from(i == j + 1)),
        });
        let roots = Schur::try_new(companion, f64::EPSILON, MOST_TURNS)?.complex_eigenvalues();
        let largest_root = roots.iter().max_by(|p, q| p.modulus().total_cmp(&q.modulus()))?;
        // A swing and its overtones grow alike: it is the slowest of them.
        let alike =
            |root: &&Complex<f64>| root.modulus() >= 0.995 * largest_root.modulus() && root.argument() != 0.0;
        let slowest =
            roots.iter().filter(alike).min_by(|p, q| p.argument().abs().total_cmp(&q.argument().abs()));
        let root = slowest.filter(|_| largest_root.argument() != 0.0).unwrap_or(largest_root);
        // S = Σ of all later differences: S = Σ aⱼ (S + the last j of them).
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

    /// By which factor a swing grows from one value to the next: that of the root where nothing else is left, or else that of the
    /// deviations, root mean squares over as many whole swings at the start and at the end of the last half. None where these are
    /// less than one swing each, or contradict the root.
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

    /// How often the last half passes the limit.
    pub(super) fn crossings<S: Sequence + ?Sized>(&self, values: &S) -> usize {
        let mut above = values.part(values.count() / 2..values.count()).map(|value| value > self.limit);
        let mut before = above.next().unwrap_or_default();
        above.filter(|now| *now != std::mem::replace(&mut before, *now)).count()
    }
}
