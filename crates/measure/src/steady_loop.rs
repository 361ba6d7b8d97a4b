//! Evaluation of a steady measured loop with noise, with 95 % confidence intervals.
//!
//! Displacements are fitted by harmonics and a linear drift. Forces are averaged over phase bins. The branches of the loop belong to a
//! family of curves: elastic-plastic elements, balls and cones at constant load, in partial and gross slip. The family includes an elastic
//! part and a time lag of the force. The parameters of the family are sampled from the posterior distribution by Markov chains ([Goodman
//! and Weare 2010](https://doi.org/10.2140/camcos.2010.5.65)). The intervals are the 2.5 % and 97.5 % quantiles of the samples.

mod branch;
mod motion;
mod posterior;

use motion::{Harmonics, Motion, median};
use posterior::{BINS, Folded, Sample};
use serde::Serialize;
use std::f64::consts::TAU;

/// Maximum number of cycles that are fitted with one period, because the period of a rig may drift.
const CHUNK: usize = 40;
/// Maximum number of parts (groups of cycles fitted with one period). Of a longer record, evenly spaced parts are used.
const PARTS: usize = 25;
/// Minimum number of rows per cycle.
const ROWS: usize = 16;
/// Minimum number of harmonics of the force for the detection of spikes.
const FORCES: usize = 12;
/// Largest residuals of the displacement, relative to its amplitude and relative to the noise. If both are exceeded, the cycles have no
/// common period.
const UNEVEN: [f64; 2] = [0.02, 2.0];
/// Difference of the log likelihoods of both signs above which the sign of the force is certain.
const SURE: f64 = 12.0;
/// Probability below a confidence interval, and above it. An interval that starts at zero has the sum of both above it.
const TAIL: f64 = 0.025;
/// Probability beyond one end of an interval whose other end is extended to a value that the time lag shifts (Imbens and Manski 2004).
const ONE_SIDED: f64 = 0.05;
/// Ratio of the lower to the upper end below which the interval of a non-negative value starts at zero.
const FROM_ZERO: f64 = 0.05;
const NORMAL: f64 = 1.96;

/// A value with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Interval {
    /// Measured value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Results of a steady loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyLoop {
    /// Displacement amplitude δ\*, m.
    pub displacement_amplitude: Interval,
    /// Force amplitude Q\*, N.
    pub force_amplitude: Interval,
    /// Dissipated energy E_d, J.
    pub dissipated: Interval,
    /// Half opening at the middle of the force range, m.
    pub half_opening: Interval,
    /// Half opening at zero force, m. `None` if the force does not change sign.
    pub half_opening_at_zero_force: Option<Interval>,
    /// Energy ratio A = E_d/(4Q\*δ\*).
    pub energy_ratio: Interval,
    /// System-free ratio B = E_d/(4Q\*δ₀). `None` if the opening may be zero.
    pub system_free_ratio: Option<Interval>,
    /// Slip ratio D = δ₀/δ\*.
    pub slip_ratio: Interval,
    /// Friction force E_d/(4δ₀), N. The energy coefficient of friction is this force divided by the mean normal force.
    ///
    /// `None` if the opening may be zero.
    pub friction_force: Option<Interval>,
    /// Tangent stiffness at the reversals, N/m.
    pub stiffness: Interval,
    /// Time lag of the force, in units of time.
    pub lag: Interval,
    /// Drift of the displacement per unit of time.
    pub displacement_drift: Interval,
    /// Drift of the force per unit of time.
    pub force_drift: Interval,
    /// Period, in units of time.
    pub period: f64,
    /// Root mean square deviation of the forces from the family of curves, relative to Q\*. A deviation within the noise is reported as 0.
    pub misfit: f64,
    /// Whether the sign of the force was inverted, because the measured force resists the motion.
    pub is_turned: bool,
    /// Whether the data determine the sign of the force with certainty.
    pub is_sense_sure: bool,
}

impl Interval {
    fn about([value, deviation]: [f64; 2]) -> Self {
        Self { value, low: value - NORMAL * deviation, high: value + NORMAL * deviation }
    }

    /// Returns half the width of the interval.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// Returns the confidence interval of posterior samples, extended to include `value`, which the time lag may shift out of it.
    fn of(mut samples: Vec<f64>, value: f64) -> Self {
        samples.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| samples[((share * samples.len() as f64) as usize).min(samples.len() - 1)];
        let (mut low, mut high) = (at(TAIL), at(1.0 - TAIL));
        let is_from_zero = low >= 0.0 && low < FROM_ZERO * high;
        if is_from_zero {
            (low, high) = (0.0, at(1.0 - 2.0 * TAIL));
        }
        if value < low {
            (low, high) = (value, at(1.0 - ONE_SIDED));
        } else if value > high {
            (low, high) = (if is_from_zero { 0.0 } else { at(ONE_SIDED) }, value);
        }
        Self { value, low: low.min(value), high: high.max(value) }
    }
}

/// Evaluates the rows of consecutive cycles. `period` is their approximate period, in units of t.
///
/// Returns `None` if there is no common period, or if there are too few rows.
#[must_use]
pub fn steady_loop(t: &[f64], u: &[f64], force: &[f64], period: f64) -> Option<SteadyLoop> {
    let parts = parts(t, u, force, period)?;
    let all = Together::of(&parts)?;
    let folded = all.fold(&parts);
    let (is_turned, surety) = folded.sense();
    let sign = if is_turned { -1.0 } else { 1.0 };
    let folded = Folded {
        bins: folded.bins.iter().map(|[phase, force, rows]| [*phase, sign * force, *rows]).collect(),
        ..folded
    };
    let (samples, misfit) = folded.sample(None);
    let (at_zero_lag, _) = folded.sample(Some(0.0));
    Some(all.figures((&samples, &at_zero_lag), (misfit, sign, surety)))
}

/// Mean loop of consecutive cycles, without drift and spikes.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanLoop {
    /// Phases since the maximum of the displacement, in periods, in ascending order.
    pub phase: Vec<f64>,
    /// Displacements at these phases from the fitted harmonics, relative to the middle of their range, m.
    pub u: Vec<f64>,
    /// Mean forces, N.
    pub force: Vec<f64>,
    /// Number of rows that each mean force averages.
    pub counts: Vec<f64>,
    /// Period, in units of time.
    pub period: f64,
    /// Standard deviation of the rows about the means, N.
    pub noise: f64,
    /// Degrees of freedom of the standard deviation.
    pub freedom: f64,
}

/// Computes the mean loop of consecutive cycles.
///
/// Returns `None` if there is no common period, or if there are too few rows.
#[must_use]
pub fn mean_loop(t: &[f64], u: &[f64], force: &[f64], period: f64) -> Option<MeanLoop> {
    let parts = parts(t, u, force, period)?;
    let all = Together::of(&parts)?;
    let folded = all.fold(&parts);
    let [squares, freedom] = folded.within;
    let place = |[phase, ..]: &[f64; 3]| (2.0 * folded.share(*phase) - 1.0) * all.amplitude[0];
    Some(MeanLoop {
        phase: folded.bins.iter().map(|bin| bin[0] / TAU).collect(),
        u: folded.bins.iter().map(place).collect(),
        force: folded.bins.iter().map(|bin| bin[1]).collect(),
        counts: folded.bins.iter().map(|bin| bin[2]).collect(),
        period: all.period,
        noise: (squares / freedom.max(1.0)).sqrt(),
        freedom,
    })
}

/// Splits the rows into groups of cycles and fits each group with one period.
fn parts(t: &[f64], u: &[f64], force: &[f64], period: f64) -> Option<Vec<Part>> {
    let cycles = ((t.last()? - t.first()?) / period).round();
    if cycles.is_nan() || cycles < 1.0 || (u.len() as f64) < ROWS as f64 * cycles {
        return None;
    }
    let pieces = (cycles / CHUNK as f64).ceil();
    let rows = (u.len() as f64 / pieces).ceil() as usize;
    let chosen = pieces.min(PARTS as f64);
    let starts = (0..chosen as usize).map(|part| (part as f64 * pieces / chosen) as usize * rows);
    let spans = starts.map(|start| start..(start + rows).min(u.len()));
    // If the last part contains no whole cycle, it is omitted.
    let whole = spans.filter(|span| span.len() > 1 && t[span.end - 1] - t[span.start] > 0.9 * period);
    whole.map(|span| Part::fit(&t[span.clone()], &u[span.clone()], &force[span], period)).collect()
}

/// Consecutive cycles that are fitted with one period.
struct Part {
    motion: Motion,
    forces: Harmonics,
    /// Phases and forces of the rows, without spikes and drift.
    rows: Vec<[f64; 2]>,
}

impl Part {
    fn fit(t: &[f64], u: &[f64], force: &[f64], period: f64) -> Option<Self> {
        let motion = Motion::fit(t, u, period)?;
        let left = motion.harmonics.deviation;
        if left > UNEVEN[0] * motion.amplitude[0] && left > UNEVEN[1] * crate::noise(u) {
            return None;
        }
        let time: Vec<f64> = t.iter().map(|t| t - motion.middle).collect();
        let per_cycle = u.len() as f64 * TAU / motion.frequency / (t[t.len() - 1] - t[0]);
        let order = (motion.harmonics.coefficients.len() / 2 - 1).max(FORCES).min((per_cycle / 4.0) as usize);
        let forces = Harmonics::fit(&time, &motion.phase, force, order.max(1))?;
        let drift = forces.drift()[0];
        let is_sound = |i: usize| forces.is_sound[i] && motion.harmonics.is_sound[i];
        let rows = (0..u.len()).filter(|i| is_sound(*i));
        let rows = rows.map(|i| [motion.phase[i].rem_euclid(TAU), force[i] - drift * time[i]]).collect();
        Some(Self { motion, forces, rows })
    }
}

/// Results of all parts (groups of cycles) together.
struct Together {
    shares: Vec<f64>,
    turn: f64,
    amplitude: [f64; 2],
    period: f64,
    work: f64,
    drift: [[f64; 2]; 2],
}

impl Together {
    fn of(parts: &[Part]) -> Option<Self> {
        let count = parts.len() as f64;
        let mean = |of: &dyn Fn(&Part) -> f64| parts.iter().map(of).sum::<f64>() / count;
        // The second value is the standard deviation of the mean of all parts.
        let both = |of: &dyn Fn(&Part) -> [f64; 2]| {
            let squares = parts.iter().map(|part| of(part)[1].powi(2)).sum::<f64>();
            [mean(&|part| of(part)[0]), squares.sqrt() / count]
        };
        let amplitude = both(&|part| part.motion.amplitude);
        let first = parts.first()?;
        let [low, high] = [first.motion.low, first.motion.low + 2.0 * first.motion.amplitude[0]];
        let is_sound = amplitude[0] > 0.0 && amplitude[0].is_finite();
        is_sound.then(|| Self {
            shares: Folded::shares(|phase| first.motion.at(phase), [low, high]),
            turn: first.motion.turn,
            amplitude,
            period: mean(&|part| TAU / part.motion.frequency),
            work: mean(&|part| part.forces.work(&part.motion.harmonics)),
            drift: [both(&|part| part.motion.harmonics.drift()), both(&|part| part.forces.drift())],
        })
    }

    /// Computes the results from samples with a free time lag and samples without a lag.
    ///
    /// `misfit` is the deviation from the family of curves. `sign` and `surety` are the sign of the force and the certainty of this sign.
    fn figures(
        &self,
        (samples, at_zero_lag): (&[Sample], &[Sample]),
        (misfit, sign, surety): (f64, f64, f64),
    ) -> SteadyLoop {
        let range = 2.0 * self.amplitude[0];
        let values = |figure: &dyn Fn(&Sample) -> f64| samples.iter().map(figure).collect::<Vec<f64>>();
        let mean = |of: &[Sample], figure: &dyn Fn(&Sample) -> f64| {
            of.iter().map(figure).sum::<f64>() / of.len() as f64
        };
        let interval =
            |figure: &dyn Fn(&Sample) -> f64| Interval::of(values(figure), mean(at_zero_lag, figure));
        let half = |sample: &Sample| sample.branch.half_opening(0.0).unwrap_or(0.0);
        let at_zero = |sample: &Sample| {
            range * sample.branch.half_opening(-sample.middle / sample.height).unwrap_or(0.0)
        };
        let area = |sample: &Sample| sample.branch.area();
        let is_open = samples.iter().chain(at_zero_lag).all(|sample| half(sample) > 0.0);
        let off = median(values(&|sample| (sample.middle / sample.height).abs()));
        let lag = |sample: &Sample| sample.lag * self.period;
        let lost = values(&|sample| sample.height * range * area(sample));
        SteadyLoop {
            displacement_amplitude: Interval::about(self.amplitude),
            force_amplitude: interval(&|sample| 0.5 * sample.height),
            dissipated: Interval::of(lost, sign * self.work),
            half_opening: interval(&|sample| range * half(sample)),
            half_opening_at_zero_force: (off < 0.5).then(|| interval(&at_zero)),
            energy_ratio: interval(&area),
            system_free_ratio: is_open.then(|| interval(&|sample| 0.5 * area(sample) / half(sample))),
            slip_ratio: interval(&|sample| 2.0 * half(sample)),
            friction_force: is_open
                .then(|| interval(&|sample| 0.25 * sample.height * area(sample) / half(sample))),
            stiffness: interval(&|sample| sample.height * sample.branch.slope() / range),
            lag: Interval::of(values(&lag), mean(samples, &lag)),
            displacement_drift: Interval::about(self.drift[0]),
            force_drift: Interval::about([sign * self.drift[1][0], self.drift[1][1]]),
            period: self.period,
            misfit: 2.0 * misfit / median(values(&|sample| sample.height)),
            is_turned: sign < 0.0,
            is_sense_sure: surety > SURE,
        }
    }

    fn fold(&self, parts: &[Part]) -> Folded {
        let mut sums = [[0.0; 4]; BINS];
        for [phase, force] in parts.iter().flat_map(|part| &part.rows) {
            let bin = &mut sums[((phase / TAU * BINS as f64) as usize).min(BINS - 1)];
            bin[0] += phase;
            bin[1] += force;
            bin[2] += 1.0;
            bin[3] += force * force;
        }
        let filled: Vec<[f64; 4]> = sums.into_iter().filter(|bin| bin[2] > 0.0).collect();
        let within =
            filled.iter().map(|[_, force, rows, squares]| (squares - force * force / rows).max(0.0)).sum();
        let freedom = filled.iter().map(|bin| bin[2] - 1.0).sum();
        let bins = filled.iter().map(|[phase, force, rows, _]| [phase / rows, force / rows, *rows]).collect();
        Folded { bins, within: [within, freedom], shares: self.shares.clone(), turn: self.turn }
    }
}
