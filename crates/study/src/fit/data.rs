//! Measured data of a fit: a loop, or rows of a trajectory.

use stickslip_measure::series::extent;
use stickslip_measure::{mean_loop, noise};
use stickslip_run::measured::{Evaluated, Measured};

/// Noise of the displacement relative to its range below which it is neglected.
const STILL: f64 = 2e-3;
/// Largest distance between first and last row of a closed loop, as a multiple of the largest step between successive rows.
const NEAR: f64 = 1.5;
/// Number of rows whose fourth differences give one degree of freedom of the noise variance.
const ROWS: f64 = 6.0;

/// Measured rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Data {
    /// Times, s.
    pub t: Vec<f64>,
    /// Displacements, m.
    pub u: Vec<f64>,
    /// Forces, N; for a trajectory, followed by the displacements scaled to forces.
    pub force: Vec<f64>,
    /// Number of measured rows whose average is one row of these data.
    pub counts: Vec<f64>,
    /// Whether the rows are one closed loop; otherwise the rows are a trajectory.
    pub is_loop: bool,
    /// Period of the loop, s.
    pub period: f64,
    /// Standard deviation of the noise of a force, N, if the rows determine it; and degrees of freedom of this noise estimate.
    pub noise: Option<f64>,
    pub(super) freedom: f64,
    /// Standard deviation of the noise of a displacement, m.
    pub(super) noise_of_u: f64,
    /// Scale from displacements to forces, N/m: ratio of force noise to displacement noise.
    pub(super) scale: f64,
}

impl Data {
    /// Returns the mean loop of the evaluated cycles, the single cycle, or the whole record if it is one closed loop. A
    /// single cycle is not averaged if its displacement has no noise.
    pub(super) fn of_loop(measured: &Measured, evaluated: Option<&Evaluated>) -> Option<Self> {
        let Some(evaluated) = evaluated else {
            return Self::whole(measured);
        };
        let rows = evaluated.rows.as_ref();
        let [u, force] = rows.map_or([&measured.u, &measured.force], |[u, force]| [u, force]);
        let stage = evaluated.longest()?;
        let cycles = &evaluated.cycles[stage.cycles.clone()];
        let (first, last) = (cycles.first()?, cycles.last()?);
        let all = first.span.start..last.span.end;
        let period = (stage.time[1] - stage.time[0]) / cycles.len() as f64;
        let found = mean_loop(&measured.t[all.clone()], &u[all.clone()], &force[all], period);
        if let Some(found) = found.filter(|_| cycles.len() > 1 || is_noisy(u)) {
            let has_noise = found.freedom > 0.0;
            return Some(Self {
                t: found.phase.iter().map(|phase| phase * found.period).collect(),
                u: found.u,
                force: found.force,
                counts: found.counts,
                is_loop: true,
                period: found.period,
                noise: has_noise.then_some(found.noise),
                freedom: found.freedom,
                noise_of_u: 0.0,
                scale: 0.0,
            });
        }
        // The end of a cycle is the start of the next.
        let span = last.span.start..last.span.end - 1;
        let t = &measured.t[span.clone()];
        Some(Self::of_rows(t, &u[span.clone()], &force[span], last.time[1] - last.time[0]))
    }

    /// Returns the whole record as a loop if it is closed.
    fn whole(measured: &Measured) -> Option<Self> {
        let Measured { t, u, force, .. } = measured;
        let step = u.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f64::max);
        let (first, last) = (u.first()?, u.last()?);
        let (start, end) = (t.first()?, t.last()?);
        if u.len() < 8 || (last - first).abs() > NEAR * step + 3.0 * noise(u) {
            return None;
        }
        // The last row may repeat the first.
        let is_closed = (last - first).abs() < 1e-6 * step;
        let count = u.len() - usize::from(is_closed);
        let period = (end - start) * if is_closed { 1.0 } else { u.len() as f64 / (u.len() - 1) as f64 };
        Some(Self::of_rows(&t[..count], &u[..count], &force[..count], period))
    }

    fn of_rows(t: &[f64], u: &[f64], force: &[f64], period: f64) -> Self {
        let start = t.first().copied().unwrap_or(0.0);
        let own = noise(force);
        Self {
            t: t.iter().map(|t| t - start).collect(),
            u: u.to_vec(),
            force: force.to_vec(),
            counts: vec![1.0; u.len()],
            is_loop: true,
            period,
            noise: (own > 0.0).then_some(own),
            freedom: force.len() as f64 / ROWS,
            noise_of_u: if is_noisy(u) { noise(u) } else { 0.0 },
            scale: 0.0,
        }
    }

    /// Returns the rows of a trajectory.
    pub(super) fn trajectory(measured: &Measured) -> Self {
        let Measured { t, u, force, .. } = measured;
        let range = |values: &[f64]| {
            let (low, high) = extent(values);
            noise(values).max(1e-6 * (high - low)).max(f64::MIN_POSITIVE)
        };
        let scale = range(force) / range(u);
        let all = force.iter().copied().chain(u.iter().map(|u| scale * u)).collect();
        Self {
            t: t.clone(),
            force: all,
            counts: vec![1.0; 2 * u.len()],
            is_loop: false,
            noise_of_u: 0.0,
            scale,
            ..Self::of_rows(t, u, force, 0.0)
        }
    }

    /// Returns the standard deviation of the noise of a force: the given or the estimated one, but at least 1e-6 of the force range.
    pub(super) fn sigma(&self, known: Option<f64>) -> f64 {
        let (low, high) = extent(&self.force);
        known.or(self.noise).unwrap_or(0.0).max(1e-6 * (high - low))
    }

    /// Returns the weights of the rows. Noise of the displacement counts as noise of the force times the slope of the
    /// loop, if `force` is given.
    pub(super) fn weights(&self, force: Option<&[f64]>) -> Vec<f64> {
        let Some(force) = force.filter(|_| self.noise_of_u > 0.0) else { return self.counts.clone() };
        let own = self.sigma(None);
        let count = force.len();
        let weight = |i: usize| {
            let (before, after) = ((i + count - 1) % count, (i + 1) % count);
            let way = self.u[after] - self.u[before];
            let slope = if way == 0.0 { 0.0 } else { (force[after] - force[before]) / way };
            self.counts[i] * own.powi(2) / (own.powi(2) + (slope * self.noise_of_u).powi(2))
        };
        (0..count).map(weight).collect()
    }
}

fn is_noisy(u: &[f64]) -> bool {
    let (low, high) = extent(u);
    noise(u) > STILL * (high - low)
}
