//! Velocity Verlet with a fixed step.

use crate::{FixedStep, Stepping, System};

/// Velocity Verlet (Swope et al., J. Chem. Phys. 76, 637, 1982): order 2, one evaluation per step.
///
/// x are the positions, v the velocities, a(t, x, v) the accelerations, z further coupled components and quadratures:
///
/// ```text
/// x₁ = x₀ + h v₀ + h²/2 a₀
/// a₁ = a(t+h, x₁, v₀ + h a₀)        z at z₀ + h ż₀
/// v₁ = v₀ + h/2 (a₀ + a₁)           z₁ = z₀ + h/2 (ż₀ + ż₁)
/// ```
///
/// The next step reuses the slopes at the end, which are evaluated with the predicted velocity. [`restart`](FixedStep::restart) drops these
/// slopes; required where they jump: at a corner of a waveform, or after a change of the state from outside.
#[derive(Debug, Clone)]
pub struct Verlet {
    /// Number of positions; the next components are the velocities.
    positions: usize,
    /// Coupled components at the end of the step, with predicted velocities.
    stage: Vec<f64>,
    /// Slopes at the start of the step (`first`), if `known`, and at its end (`last`).
    first: Vec<f64>,
    last: Vec<f64>,
    known: bool,
    evaluations: u64,
}

impl Verlet {
    /// Returns a workspace for systems with `positions` positions, `dimension` coupled components and `total` components.
    ///
    /// If there are more positions than half of `dimension`, only that half counts.
    #[must_use]
    pub fn new(positions: usize, dimension: usize, total: usize) -> Self {
        let total = total.max(dimension);
        Self {
            positions: positions.min(dimension / 2),
            stage: vec![0.0; dimension],
            first: vec![0.0; total],
            last: vec![0.0; total],
            known: false,
            evaluations: 0,
        }
    }
}

impl FixedStep for Verlet {
    fn sized(positions: usize, dimension: usize, total: usize) -> Self {
        Self::new(positions, dimension, total)
    }

    /// After a restart, the next step evaluates the slopes at its start.
    fn restart(&mut self) {
        self.known = false;
    }

    fn kept(&self) -> Option<&[f64]> {
        self.known.then_some(self.first.as_slice())
    }

    /// Ignores slopes whose length is not `total`.
    fn keep(&mut self, slopes: &[f64]) {
        self.known = slopes.len() == self.first.len();
        if self.known {
            self.first.copy_from_slice(slopes);
        }
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl<S: System + ?Sized> Stepping<S> for Verlet {
    fn step(&mut self, system: &S, t: f64, y: &mut [f64], h: f64) {
        if !self.known {
            for (to, from) in self.stage.iter_mut().zip(y.iter()) {
                *to = *from;
            }
            system.slopes(t, &self.stage, &mut self.first);
            self.evaluations += 1;
        }
        let (half, n, ahead) = (0.5 * h, self.positions, self.stage.len());
        let total = y.len().min(self.first.len());
        // Slices of equal lengths let the loops run without checks.
        let (x, v) = y[..ahead].split_at(n);
        let first_v = &self.first[n..ahead];
        let (stage_x, stage_v) = self.stage.split_at_mut(n);
        // Velocities are those of the state: with the predicted velocities the energy of an undamped oscillator grows.
        for i in 0..n {
            stage_x[i] = x[i] + h * (v[i] + half * first_v[i]);
        }
        for i in 0..ahead - n {
            stage_v[i] = v[i] + h * first_v[i];
        }
        system.slopes(t + h, &self.stage, &mut self.last);
        self.evaluations += 1;
        y[..n].copy_from_slice(&self.stage[..n]);
        for ((y, a), b) in y[n..total].iter_mut().zip(&self.first[n..total]).zip(&self.last[n..total]) {
            *y += half * (a + b);
        }
        std::mem::swap(&mut self.first, &mut self.last);
        self.known = true;
    }
}
