//! Waveform shapes as points of the unit cube. Every shape is within the limits of driver window, current and bandwidth.

use serde_json::{Value, json};
use std::f64::consts::TAU;
use stickslip_drive::Waveform;
use stickslip_scenario::{Basis, Shaped};

/// Smallest amplitude of harmonics, relative to the largest amplitude within the driver limits.
const LEAST_SHARE: f64 = 0.05;
/// Largest coefficient of harmonic k, relative to that of the first harmonic and multiplied by k.
const WIDEST: f64 = 2.0;
/// Number of grid points, per period of the highest harmonic, from which Newton's method starts to find extremes of a sum of harmonics.
const GRID: usize = 32;
/// Number of steps of Newton's method for an extreme.
const NEWTON: usize = 4;
/// Number of samples for the Fourier coefficients of a given waveform.
const SAMPLES: usize = 1024;

/// One period of the waveform at a point of the search space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Drawing {
    /// Values at equal time intervals, connected by straight lines.
    Corners(Vec<f64>),
    /// Mean value, and coefficients of sin kωt and cos kωt.
    Harmonics(f64, Vec<[f64; 2]>),
}

/// Returns the number of coordinates of a shape in the unit cube.
pub(crate) fn dimensions(shaped: &Shaped) -> usize {
    match shaped.basis {
        Basis::Corners(n) => n,
        // The first harmonic has the phase 0.
        Basis::Harmonics(n) => 1 + 2 * (n - 1),
    }
}

/// Returns the names of the coordinates.
pub(crate) fn names(shaped: &Shaped) -> Vec<String> {
    match shaped.basis {
        Basis::Corners(n) => (1..=n).map(|corner| format!("corner {corner}")).collect(),
        Basis::Harmonics(n) => {
            let pairs = (2..=n).flat_map(|k| [format!("sin {k}\u{3c9}t"), format!("cos {k}\u{3c9}t")]);
            std::iter::once("amplitude".to_owned()).chain(pairs).collect()
        }
    }
}

impl Drawing {
    /// Creates the waveform at a point, with a period in s.
    pub(crate) fn new(shaped: &Shaped, period: f64, point: &[f64]) -> Self {
        let [low, high] = shaped.window;
        match shaped.basis {
            Basis::Corners(n) => {
                let wanted: Vec<f64> = point.iter().map(|share| low + (high - low) * share).collect();
                let step = period / n as f64;
                Self::Corners(shaped.slew.map_or(wanted.clone(), |slew| slowed(&wanted, slew, step)))
            }
            Basis::Harmonics(_) => {
                let pairs = point.get(1..).unwrap_or_default().chunks_exact(2);
                let wide = |share: f64, k: usize| (2.0 * share - 1.0) * WIDEST / k as f64;
                let others = pairs.enumerate().map(|(i, pair)| [wide(pair[0], i + 2), wide(pair[1], i + 2)]);
                let terms: Vec<[f64; 2]> = std::iter::once([1.0, 0.0]).chain(others).collect();
                let share = LEAST_SHARE + (1.0 - LEAST_SHARE) * point.first().copied().unwrap_or(1.0);
                let [least, most] = range(&terms);
                let factor = share * largest(shaped, period, &terms, most - least);
                let offset = (low + high) / 2.0 - factor * (least + most) / 2.0;
                Self::Harmonics(offset, terms.iter().map(|term| term.map(|c| factor * c)).collect())
            }
        }
    }

    /// Returns the value at a fraction of the period, 0 to 1.
    pub(crate) fn value(&self, share: f64) -> f64 {
        match self {
            Self::Corners(values) => {
                let place = share * values.len() as f64;
                let before = (place.floor() as usize).min(values.len() - 1);
                let [from, to] = [values[before], values[(before + 1) % values.len()]];
                from + (to - from) * (place - before as f64)
            }
            Self::Harmonics(offset, terms) => offset + sum(terms, TAU * share),
        }
    }

    /// Returns the smallest and largest value.
    pub(crate) fn range(&self) -> [f64; 2] {
        match self {
            Self::Corners(values) => [
                values.iter().copied().fold(f64::INFINITY, f64::min),
                values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            ],
            Self::Harmonics(offset, terms) => range(terms).map(|value| offset + value),
        }
    }

    /// Returns the largest falling and rising rates, in the unit of the values per second.
    pub(crate) fn rates(&self, period: f64) -> [f64; 2] {
        match self {
            Self::Corners(values) => {
                let pairs = values.iter().zip(values.iter().cycle().skip(1));
                let rates = pairs.map(|(from, to)| (to - from) * values.len() as f64 / period);
                rates.fold([0.0, 0.0], |[down, up], rate| [f64::max(down, -rate), f64::max(up, rate)])
            }
            Self::Harmonics(_, terms) => {
                let [least, most] = range(&derivative(terms));
                [-least * TAU / period, most * TAU / period]
            }
        }
    }

    /// Returns the waveform in the form of a scenario file.
    pub(crate) fn form(&self, period: f64) -> Value {
        match self {
            Self::Corners(values) => {
                let time = |i: usize| period * (i as f64 / values.len() as f64);
                let all = values.iter().chain(values.first()).enumerate();
                let points: Vec<[f64; 2]> = all.map(|(i, value)| [time(i), *value]).collect();
                json!({ "table": { "points": points, "repeat": true } })
            }
            Self::Harmonics(offset, terms) => {
                let term = |(i, [sin, cos]): (usize, &[f64; 2])| {
                    let amplitude = (sin * sin + cos * cos).sqrt();
                    json!({ "amplitude": amplitude, "order": i + 1, "phase": math::atan2(*cos, *sin) })
                };
                let terms: Vec<Value> = terms.iter().enumerate().map(term).collect();
                json!({ "harmonics": { "period": period, "offset": offset, "terms": terms } })
            }
        }
    }
}

/// Returns the largest polygon that does not exceed `wanted` and has falling and rising rates of at most `down` and `up`.
fn slowed(wanted: &[f64], [down, up]: [f64; 2], step: f64) -> Vec<f64> {
    let n = wanted.len();
    let reached = |i: usize| {
        let from = |j: usize| {
            let ahead = (n + i - j) % n;
            let behind = (n - ahead) % n;
            wanted[j] + f64::min(up * step * ahead as f64, down * step * behind as f64)
        };
        (0..n).map(from).fold(f64::INFINITY, f64::min)
    };
    (0..n).map(reached).collect()
}

/// Returns the largest factor with which a sum of harmonics stays within driver window and rate limits.
fn largest(shaped: &Shaped, period: f64, terms: &[[f64; 2]], height: f64) -> f64 {
    let [low, high] = shaped.window;
    let by_window = (high - low) / height;
    let Some([down, up]) = shaped.slew else { return by_window };
    let [least, most] = range(&derivative(terms));
    let omega = TAU / period;
    by_window.min(down / (-least * omega)).min(up / (most * omega))
}

fn sum(terms: &[[f64; 2]], angle: f64) -> f64 {
    let term = |(i, [sin, cos]): (usize, &[f64; 2])| {
        let angle = (i + 1) as f64 * angle;
        sin * math::sin(angle) + cos * math::cos(angle)
    };
    terms.iter().enumerate().map(term).sum()
}

/// Returns the derivative with respect to the angle.
fn derivative(terms: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let term = |(i, [sin, cos]): (usize, &[f64; 2])| [-((i + 1) as f64) * cos, (i + 1) as f64 * sin];
    terms.iter().enumerate().map(term).collect()
}

/// Returns the extremes of a sum of harmonics, from a grid refined by Newton's method.
fn range(terms: &[[f64; 2]]) -> [f64; 2] {
    let (first, points) = (derivative(terms), GRID * terms.len());
    let second = derivative(&first);
    [-1.0, 1.0].map(|sign| {
        let at = |i: usize| TAU * i as f64 / points as f64;
        let better = |a: f64, b: f64| if sign * sum(terms, b) > sign * sum(terms, a) { b } else { a };
        let mut best = (1..points).map(at).fold(0.0, better);
        for _ in 0..NEWTON {
            let curvature = sum(&second, best);
            if curvature != 0.0 {
                best = better(best, best - sum(&first, best) / curvature);
            }
        }
        sum(terms, best)
    })
}

/// Returns the point of the unit cube whose shape is nearest to a given waveform.
pub(crate) fn nearest(shaped: &Shaped, waveform: &Waveform) -> Option<Vec<f64>> {
    let period = waveform.period()?;
    // The waveform is sampled in its second period, after a possible jump at the start.
    let value = |share: f64| {
        let time = period * (1.0 + share);
        waveform.sample(&waveform.piece_at(time), time).value / shaped.gain
    };
    let [low, high] = shaped.window;
    match shaped.basis {
        Basis::Corners(n) => {
            let share = |i: usize| (value(i as f64 / n as f64) - low) / (high - low);
            Some((0..n).map(|i| share(i).clamp(0.0, 1.0)).collect())
        }
        Basis::Harmonics(n) => {
            let of = |k: usize| {
                let angle = |i: usize| TAU * ((k * i) % SAMPLES) as f64 / SAMPLES as f64;
                let values = (0..SAMPLES).map(|i| (value(i as f64 / SAMPLES as f64), angle(i)));
                values.fold([0.0, 0.0], |[s, c], (value, angle)| {
                    [s + value * math::sin(angle), c + value * math::cos(angle)]
                })
            };
            let [s, c] = of(1);
            let length = s * s + c * c;
            // The harmonics are shifted to phase 0 of the first harmonic and divided by its amplitude: z_k e^{ikφ} with e^{iφ} = z̄₁/|z₁|.
            let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
            let turn = [s / length.sqrt(), -c / length.sqrt()];
            let mut turned = turn;
            let mut point = vec![1.0];
            for k in 2..=n {
                turned = times(turned, turn);
                let pair = times(of(k), turned).map(|x| x / length.sqrt() * k as f64 / WIDEST);
                point.extend(pair.map(|x| ((x + 1.0) / 2.0).clamp(0.0, 1.0)));
            }
            point.iter().all(|x| x.is_finite()).then_some(point)
        }
    }
}
