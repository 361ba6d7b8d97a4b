//! Periodic displacement: mean, drift and harmonics by least squares.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};

/// Numbers of harmonics of the fits. The numbers are tried in this order as long as the fit improves significantly.
const ORDERS: [usize; 9] = [1, 2, 3, 5, 8, 12, 18, 26, 40];
/// Minimum reduction of the sum of squares by an additional harmonic, relative to the reduction expected from noise.
const MORE: f64 = 8.0;
/// Residual of a spike, in robust standard deviations.
const SPIKE: f64 = 6.0;
/// Additional residual of a spike, relative to the largest harmonic. At corners of the motion, residuals up to this value are normal.
const CORNER: f64 = 0.05;
/// Tolerance of the harmonics of a triangle, relative to the first harmonic.
const CORNERS: f64 = 2e-3;
/// Number of iterations of the frequency search.
const ROUNDS: usize = 5;
/// Number of points per period in the search for extremes.
const FINE: usize = 4096;

/// Least-squares fit by harmonics of a phase: value = c₀ + c₁τ + Σ aₕ cos hφ + bₕ sin hφ.
#[derive(Debug, Clone)]
pub(super) struct Harmonics {
    /// Coefficients c₀, c₁, a₁, b₁, a₂, …
    pub(super) coefficients: Vec<f64>,
    /// Inverse of the normal matrix.
    inverse: DMatrix<f64>,
    /// Standard deviation of the residuals.
    pub(super) deviation: f64,
    /// Whether each row is used: `false` for spikes.
    pub(super) is_sound: Vec<bool>,
}

/// Computes a row of the design matrix: 1, time, and the cosines and sines of multiples of the phase.
fn columns(time: f64, phase: f64, order: usize, row: &mut Vec<f64>) {
    row.clear();
    row.extend([1.0, time]);
    let (sin, cos) = math::sin_cos(phase);
    let (mut s, mut c) = (sin, cos);
    for _ in 0..order {
        row.extend([c, s]);
        (s, c) = (s * cos + c * sin, c * cos - s * sin);
    }
}

impl Harmonics {
    /// Fits values at times and phases. Spikes are omitted.
    pub(super) fn fit(time: &[f64], phase: &[f64], values: &[f64], order: usize) -> Option<Self> {
        let mut is_sound = vec![true; values.len()];
        let (mut fit, mut row) = (None, Vec::new());
        for _ in 0..3 {
            let Self { coefficients, inverse, .. } = Self::solve(time, phase, values, order, &is_sound)?;
            let residual: Vec<f64> = (0..values.len())
                .map(|i| {
                    columns(time[i], phase[i], order, &mut row);
                    values[i] - dot(&row, &coefficients)
                })
                .collect();
            let robust = 1.4826 * median(residual.iter().map(|rest| rest.abs()).collect());
            let size = coefficients[2..].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            let limit = SPIKE * robust + CORNER * size;
            let before = is_sound;
            is_sound = residual.iter().map(|rest| rest.abs() <= limit).collect();
            let rows = is_sound.iter().filter(|is| **is).count();
            let squares: f64 =
                residual.iter().zip(&is_sound).filter(|(_, is)| **is).map(|(rest, _)| rest * rest).sum();
            let deviation = (squares / rows.saturating_sub(2 * order + 3).max(1) as f64).sqrt();
            fit = Some(Self { coefficients, inverse, deviation, is_sound: is_sound.clone() });
            if before == is_sound {
                break;
            }
        }
        fit
    }

    fn solve(time: &[f64], phase: &[f64], values: &[f64], order: usize, is_sound: &[bool]) -> Option<Self> {
        let size = 2 * order + 2;
        let (mut matrix, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        let mut row = Vec::with_capacity(size);
        for i in (0..values.len()).filter(|i| is_sound[*i]) {
            columns(time[i], phase[i], order, &mut row);
            for j in 0..size {
                right[j] += row[j] * values[i];
                for k in 0..=j {
                    matrix[(j, k)] += row[j] * row[k];
                }
            }
        }
        matrix.fill_upper_triangle_with_lower_triangle();
        let factors = matrix.cholesky()?;
        let coefficients = factors.solve(&right).iter().copied().collect();
        Some(Self { coefficients, inverse: factors.inverse(), deviation: 0.0, is_sound: Vec::new() })
    }

    /// Returns the sum of the harmonics at a phase.
    pub(super) fn at(&self, phase: f64) -> f64 {
        let mut row = Vec::new();
        columns(0.0, phase, (self.coefficients.len() - 2) / 2, &mut row);
        dot(&row[2..], &self.coefficients[2..])
    }

    /// Returns the derivative of the harmonics with respect to the phase.
    fn slope(&self, phase: f64) -> f64 {
        let pairs = self.coefficients[2..].chunks(2).zip(1..);
        pairs
            .map(|(pair, h)| {
                let (sin, cos) = math::sin_cos(f64::from(h) * phase);
                f64::from(h) * (pair[1] * cos - pair[0] * sin)
            })
            .sum()
    }

    /// Returns whether the first harmonics are those of a triangle, which has corners.
    ///
    /// The third and fifth harmonics of a triangle are 1/9 and 1/25 of its first harmonic. Even harmonics of a triangle are 0.
    fn is_triangle(&self, rows: f64) -> bool {
        let pairs: Vec<&[f64]> = self.coefficients[2..].chunks(2).collect();
        let Some(first) = pairs.first().map(|pair| pair[0]).filter(|_| pairs.len() >= 5) else {
            return false;
        };
        let slack = CORNERS * first.abs() + 4.0 * self.deviation * (2.0 / rows).sqrt();
        [(1, 0.0), (2, 1.0 / 9.0), (3, 0.0), (4, 1.0 / 25.0)].into_iter().all(
            |(place, share): (usize, f64)| {
                let [a, b] = [pairs[place][0], pairs[place][1]];
                (a - share * first).abs() < slack && b.abs() < slack
            },
        )
    }

    /// Returns the drift c₁ per unit of time and its standard deviation.
    pub(super) fn drift(&self) -> [f64; 2] {
        [self.coefficients[1], self.deviation * self.inverse[(1, 1)].sqrt()]
    }

    /// Returns the work ∮ F du of one period for the force `self` and the displacement `motion`.
    pub(super) fn work(&self, motion: &Self) -> f64 {
        let both = self.coefficients[2..].chunks(2).zip(motion.coefficients[2..].chunks(2)).zip(1..);
        0.5 * TAU * both.map(|((f, u), h)| f64::from(h) * (f[0] * u[1] - f[1] * u[0])).sum::<f64>()
    }
}

/// Periodic displacement with phase 0 at its maximum.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// Time at the middle of the record, s.
    pub(super) middle: f64,
    /// Angular frequency, rad/s.
    pub(super) frequency: f64,
    /// Phase of each row, rad.
    pub(super) phase: Vec<f64>,
    /// Harmonics of the displacement.
    pub(super) harmonics: Harmonics,
    /// Phase of the minimum of the displacement, rad.
    pub(super) turn: f64,
    /// Amplitude δ* and its standard deviation, m.
    pub(super) amplitude: [f64; 2],
    /// Minimum of the displacement, m.
    pub(super) low: f64,
    is_triangle: bool,
}

impl Motion {
    /// Fits displacements with an approximate period. Harmonics are added as long as the fit improves significantly.
    pub(super) fn fit(t: &[f64], u: &[f64], period: f64) -> Option<Self> {
        let middle = 0.5 * (t.first()? + t.last()?);
        let time: Vec<f64> = t.iter().map(|t| (t - middle) / period).collect();
        let cycles = (t.last()? - t.first()?) / period;
        let most = (u.len() as f64 / cycles / 5.0) as usize;
        let mut turns = frequency(&time, u)?;
        let mut best: Option<Harmonics> = None;
        for order in ORDERS.into_iter().filter(|order| *order <= most.max(1)) {
            let phase: Vec<f64> = time.iter().map(|time| TAU * turns * time).collect();
            let fit = Harmonics::fit(&time, &phase, u, order)?;
            let is_better = best.as_ref().is_none_or(|best| {
                let (before, after) = (best.deviation.powi(2), fit.deviation.powi(2));
                let added = (fit.coefficients.len() - best.coefficients.len()) as f64;
                (before - after) * u.len() as f64 > MORE * added * after
            });
            let size = fit.coefficients[2].abs().max(fit.coefficients[3].abs());
            let is_exact = fit.deviation < 1e-7 * size;
            // A triangle has only odd harmonics, so two orders without an improvement may precede a better one.
            if is_better {
                best = Some(fit);
            } else if order >= 5 {
                break;
            }
            if is_exact {
                break;
            }
        }
        let order = best?.coefficients.len() / 2 - 1;
        for _ in 0..2 {
            turns = refine(&time, u, turns, order)?;
        }
        Self::about_the_maximum((&time, u), (middle, period), turns, order)
    }

    fn about_the_maximum(
        (time, u): (&[f64], &[f64]),
        (middle, period): (f64, f64),
        turns: f64,
        order: usize,
    ) -> Option<Self> {
        let phase: Vec<f64> = time.iter().map(|time| TAU * turns * time).collect();
        let first = Harmonics::fit(time, &phase, u, order)?;
        let (top, _) = extremes(&first);
        let phase: Vec<f64> = phase.into_iter().map(|phase| phase - top).collect();
        let mut harmonics = Harmonics::fit(time, &phase, u, order)?;
        let (top, turn) = extremes(&harmonics);
        let (high, low) = (harmonics.at(top), harmonics.at(turn));
        let mut gradient = DVector::zeros(harmonics.coefficients.len());
        let [mut at_top, mut at_turn] = [Vec::new(), Vec::new()];
        columns(0.0, top, order, &mut at_top);
        columns(0.0, turn, order, &mut at_turn);
        for place in 2..gradient.len() {
            gradient[place] = 0.5 * (at_top[place] - at_turn[place]);
        }
        let spread = (gradient.transpose() * &harmonics.inverse * &gradient)[0].max(0.0).sqrt();
        let is_triangle = harmonics.is_triangle(u.len() as f64);
        let (mut amplitude, mut low, mut turn) =
            ([0.5 * (high - low), harmonics.deviation * spread], low, turn);
        if is_triangle {
            let first = harmonics.coefficients[2] * PI * PI / 8.0;
            let deviation = harmonics.deviation * harmonics.inverse[(2, 2)].sqrt() * PI * PI / 8.0;
            (amplitude, low, turn) = ([first, deviation], -first, PI);
        }
        // The times of this fit are in periods.
        harmonics.coefficients[1] /= period;
        harmonics.inverse[(1, 1)] /= period * period;
        let frequency = TAU * turns / period;
        Some(Self { middle, frequency, phase, harmonics, turn, amplitude, low, is_triangle })
    }

    /// Returns the displacement at a phase, relative to the mean.
    pub(super) fn at(&self, phase: f64) -> f64 {
        if !self.is_triangle {
            return self.harmonics.at(phase);
        }
        let way = phase.rem_euclid(TAU);
        self.amplitude[0] * (1.0 - 2.0 * way.min(TAU - way) / PI)
    }
}

/// Returns the phases of the maximum and the minimum of the harmonics, by bisection near the largest and the smallest of many samples.
fn extremes(harmonics: &Harmonics) -> (f64, f64) {
    let at = |k: usize| TAU * k as f64 / FINE as f64;
    let values: Vec<f64> = (0..FINE).map(|k| harmonics.at(at(k))).collect();
    let best = |sign: f64| {
        let k = (0..FINE).max_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b]))).unwrap_or(0);
        let (mut low, mut high) = (at(k) - at(1), at(k) + at(1));
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if sign * harmonics.slope(middle) > 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    (best(1.0), best(-1.0).rem_euclid(TAU))
}

/// Returns the frequency of the first harmonic relative to the approximate frequency. Returns `None` if the ratio is beyond a factor of 2.
fn frequency(time: &[f64], u: &[f64]) -> Option<f64> {
    let mut turns = 1.0;
    for _ in 0..ROUNDS {
        turns = refine(time, u, turns, 1)?;
    }
    (0.5..2.0).contains(&turns).then_some(turns)
}

/// Improves the frequency by one step of the Gauss–Newton method.
fn refine(time: &[f64], u: &[f64], turns: f64, order: usize) -> Option<f64> {
    let phase: Vec<f64> = time.iter().map(|time| TAU * turns * time).collect();
    let fit = Harmonics::fit(time, &phase, u, order)?;
    // The derivative with respect to the frequency is τ times that with respect to the phase. Its projection on the harmonics is removed.
    let by: Vec<f64> = time.iter().zip(&phase).map(|(time, phase)| TAU * time * fit.slope(*phase)).collect();
    let own = Harmonics::solve(time, &phase, &by, order, &fit.is_sound)?;
    let (mut up, mut down, mut row) = (0.0, 0.0, Vec::new());
    for i in (0..u.len()).filter(|i| fit.is_sound[*i]) {
        columns(time[i], phase[i], order, &mut row);
        let free = by[i] - dot(&row, &own.coefficients);
        up += free * (u[i] - dot(&row, &fit.coefficients));
        down += free * free;
    }
    if down > 0.0 { Some(turns + (up / down).clamp(-0.05, 0.05)) } else { Some(turns) }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the median.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
