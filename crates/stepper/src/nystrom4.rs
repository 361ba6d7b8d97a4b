//! Nyström's method of order 4 with a fixed step, for forces that do not depend on velocities.

use crate::{Conservative, FixedStep, Stepping};

/// Nyström's method of order 4 (Nyström 1925; Hairer, Nørsett, Wanner, *Solving ODEs I*, table II.14.2). The method needs three evaluations
/// per step, where [`Rk4`](crate::Rk4) needs four, and has no error estimate.
///
/// ```text
/// k₁ = a(t, x)   k₂ = a(t + h/2, x + h/2 v + h²/8 k₁)   k₃ = a(t + h, x + h v + h²/2 k₂)
/// x₁ = x + h v + h²/6 (k₁ + 2k₂)   v₁ = v + h/6 (k₁ + 4k₂ + k₃)   q₁ = q + h/6 (r₁ + 4r₂ + r₃)
/// ```
///
/// Here r are the rates of the quadratures q.
#[derive(Debug, Clone)]
pub struct Nystrom4 {
    positions: usize,
    /// Positions of the current stage.
    stage: Vec<f64>,
    /// Accelerations and quadrature rates of the three stages.
    rates: [Vec<f64>; 3],
    evaluations: u64,
}

impl Nystrom4 {
    /// Returns a workspace for `positions` positions and `quadratures` quadratures.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize) -> Self {
        let rates = || vec![0.0; positions + quadratures];
        Self { positions, stage: vec![0.0; positions], rates: [rates(), rates(), rates()], evaluations: 0 }
    }

    /// Integrates one step of a system with one position and one quadrature, without loops.
    #[inline(always)]
    fn step_one<S: Conservative + ?Sized>(&self, system: &S, t: f64, y: &mut [f64; 3], h: f64) {
        let [x, v, q] = *y;
        let ask = |t: f64, x: f64| {
            let mut rates = [0.0; 2];
            system.accelerations(t, &[x], &mut rates);
            rates
        };
        let half = 0.5 * h;
        let [k1, r1] = ask(t, x);
        let [k2, r2] = ask(t + half, x + half * (v + 0.25 * h * k1));
        let [k3, r3] = ask(t + h, x + h * (v + half * k2));
        let sixth = h / 6.0;
        *y = [
            x + h * v + h * sixth * (k1 + 2.0 * k2),
            v + sixth * (k1 + 4.0 * k2 + k3),
            q + sixth * (r1 + 4.0 * r2 + r3),
        ];
    }

    fn step_many<S: Conservative + ?Sized>(&mut self, system: &S, t: f64, y: &mut [f64], h: f64) {
        let n = self.positions;
        let half = 0.5 * h;
        system.accelerations(t, &y[..n], &mut self.rates[0]);
        for i in 0..n {
            self.stage[i] = y[i] + half * (y[n + i] + 0.25 * h * self.rates[0][i]);
        }
        system.accelerations(t + half, &self.stage, &mut self.rates[1]);
        for i in 0..n {
            self.stage[i] = y[i] + h * (y[n + i] + half * self.rates[1][i]);
        }
        system.accelerations(t + h, &self.stage, &mut self.rates[2]);
        let [first, second, third] = &self.rates;
        let sixth = h / 6.0;
        for i in 0..n {
            y[i] += h * y[n + i] + h * sixth * (first[i] + 2.0 * second[i]);
        }
        // Velocities and quadratures have the same weights.
        for (y, ((a, b), c)) in y[n..].iter_mut().zip(first.iter().zip(second).zip(third)) {
            *y += sixth * (a + 4.0 * b + c);
        }
    }
}

impl FixedStep for Nystrom4 {
    /// The components must be positions, velocities and quadratures only.
    fn sized(positions: usize, _: usize, total: usize) -> Self {
        Self::new(positions, total - 2 * positions)
    }

    /// Does nothing, because the method keeps no slopes.
    fn restart(&mut self) {}

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl<S: Conservative + ?Sized> Stepping<S> for Nystrom4 {
    fn step(&mut self, system: &S, t: f64, y: &mut [f64], h: f64) {
        match <&mut [f64; 3]>::try_from(&mut *y) {
            Ok(y) if self.positions == 1 => self.step_one(system, t, y, h),
            _ => self.step_many(system, t, y, h),
        }
        self.evaluations += 3;
    }
}
