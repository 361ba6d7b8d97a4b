//! The Runge–Kutta–Nyström pair RKN8(6)9 for forces without velocities: order 8, error estimate of order 6.
//!
//! Where accelerations hang on time and positions alone, positions need no stages of their own for the velocities: a
//! step costs 8 evaluations instead of the 12 of [`Dop853`](crate::Dop853), and each carries half the components.
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, *High-order embedded Runge–Kutta–Nyström formulae*,
//! IMA Journal of Numerical Analysis 7 (1987) 423–430. The dense output is Hermite–Birkhoff: accelerations at seven
//! nodes of the step, those inside evaluated again on the interpolant of the stages.

mod tableau;

use crate::Attempt;
use tableau::{
    END, MONOMIALS, NODES, POSITION_ERROR, POSITIONS, REFINED, SAMPLED, SAMPLES, STAGES, VELOCITY,
    VELOCITY_ERROR,
};

/// Power of the step with which the error estimate falls.
pub const ORDER: u32 = 7;

/// A system whose accelerations, and the rates of whose quadratures, hang on time and positions alone.
///
/// Its state has n positions, n velocities and then the quadratures.
pub trait Conservative {
    /// Number n of positions.
    fn positions(&self) -> usize;

    /// Accelerations (n) and then the rates of the quadratures at time `t` (s) and positions `x`; all to be filled.
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]);
}

/// One step of RKN8(6)9 at a time, as [`Dop853`](crate::Dop853) does it.
#[derive(Debug, Clone)]
pub struct Nystrom {
    positions: usize,
    time: f64,
    end_time: f64,
    step: f64,
    begin: Vec<f64>,
    end: Vec<f64>,
    stage: Vec<f64>,
    rates: Vec<f64>,
    /// Accelerations and rates of the quadratures at the stages.
    k: Vec<[f64; STAGES]>,
    /// Of the same components: monomials of the fraction of the step.
    polynomials: Vec<[f64; SAMPLES]>,
    first_known: bool,
    last_known: bool,
    dense_known: bool,
    evaluations: u64,
}

impl Nystrom {
    /// Workspace for `positions` positions and `quadratures` quadratures.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize) -> Self {
        let (rates, total) = (positions + quadratures, 2 * positions + quadratures);
        Self {
            positions,
            time: 0.0,
            end_time: 0.0,
            step: 0.0,
            begin: vec![0.0; total],
            end: vec![0.0; total],
            stage: vec![0.0; positions],
            rates: vec![0.0; rates],
            k: vec![[0.0; STAGES]; rates],
            polynomials: vec![[0.0; SAMPLES]; rates],
            first_known: false,
            last_known: false,
            dense_known: false,
            evaluations: 0,
        }
    }

    fn evaluate<S: Conservative + ?Sized>(&mut self, system: &S, t: f64, stage: usize) {
        system.accelerations(t, &self.stage, &mut self.rates);
        self.evaluations += 1;
        for (k, rate) in self.k.iter_mut().zip(&self.rates) {
            k[stage] = *rate;
        }
    }

    /// Positions of stage `J`, and what acts there.
    #[inline(always)]
    fn advance<const J: usize, S: Conservative + ?Sized>(&mut self, system: &S, t: f64) {
        let (h, n) = (self.step, self.positions);
        let (x, v) = self.begin.split_at(n);
        for (((to, x), v), k) in self.stage.iter_mut().zip(x).zip(v).zip(&self.k) {
            *to = x + h * (NODES[J] * v + h * dot::<J>(&POSITIONS[J], k));
        }
        self.evaluate(system, t, J);
    }

    /// The end of the step by the weights of order 8; the last stage has the end's positions.
    fn conclude(&mut self) {
        let (h, n) = (self.step, self.positions);
        self.end[..n].copy_from_slice(&self.stage);
        for ((to, v), k) in self.end[n..].iter_mut().zip(&self.begin[n..]).zip(&self.k) {
            *to = v + h * dot::<8>(&VELOCITY, k);
        }
    }

    /// Largest difference of the two orders in units of `scale`.
    fn error(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions);
        let (mut largest, mut sum) = (0.0_f64, 0.0);
        for (i, k) in self.k.iter().enumerate() {
            if i < n {
                let e = h * h * dot::<7>(&POSITION_ERROR, k) / scale[i];
                largest = largest.max(e.abs());
            }
            if let Some(scale) = scale.get(n + i) {
                let e = h * dot::<STAGES>(&VELOCITY_ERROR, k) / scale;
                largest = largest.max(e.abs());
            }
            // `max` drops NaN, a sum does not.
            sum += k[END];
        }
        sum += self.end.iter().sum::<f64>();
        if sum.is_finite() && largest.is_finite() { largest } else { f64::INFINITY }
    }

    /// The polynomials through the samples that there are.
    fn interpolate(&mut self) {
        for (polynomial, k) in self.polynomials.iter_mut().zip(&self.k) {
            for (coefficient, row) in polynomial.iter_mut().zip(&MONOMIALS) {
                *coefficient = row.iter().zip(SAMPLED).map(|(a, stage)| a * k[stage]).sum();
            }
        }
    }

    /// Component `i` at a fraction of the step.
    fn at(&self, i: usize, share: f64) -> f64 {
        let (h, n) = (self.step, self.positions);
        if i < n {
            let sum = (0..SAMPLES).rev().fold(0.0, |sum, j| {
                let j1 = (j + 1) as f64;
                sum * share + self.polynomials[i][j] / (j1 * (j1 + 1.0))
            });
            return self.begin[i] + share * h * (self.begin[n + i] + h * share * sum);
        }
        let polynomial = &self.polynomials[i - n];
        let sum = (0..SAMPLES).rev().fold(0.0, |sum, j| sum * share + polynomial[j] / (j + 1) as f64);
        self.begin[i] + h * share * sum
    }

    fn forget_step(&mut self) {
        self.last_known = false;
        self.dense_known = false;
    }
}

/// Σ over the first `N` stages; stages of weight zero fall out at compile time.
#[inline(always)]
fn dot<const N: usize>(weights: &[f64], k: &[f64; STAGES]) -> f64 {
    let mut sum = 0.0;
    for j in 0..N {
        if weights[j] != 0.0 {
            sum += weights[j] * k[j];
        }
    }
    sum
}

impl<S: Conservative + ?Sized> Attempt<S> for Nystrom {
    /// Swings grow from 3.3 on; they fade fastest here.
    fn reach(&self) -> f64 {
        3.0
    }

    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.time = t;
        self.begin.copy_from_slice(y);
        self.restart_slopes(system);
    }

    fn restart_slopes(&mut self, system: &S) {
        self.forget_step();
        self.stage.copy_from_slice(&self.begin[..self.positions]);
        self.evaluate(system, self.time, 0);
        self.first_known = true;
    }

    fn first_step(&mut self, _: &S, longest: f64, scale: &[f64]) -> f64 {
        // A step in which what acts at its start moves a body by its natural scale, or a hundredth of the longest.
        let n = self.positions;
        let bend = (0..n).map(|i| self.k[i][0].abs() / scale[n + i]).fold(0.0, f64::max);
        let step = if bend > 0.0 {
            (1.0 / bend).powf(1.0 / f64::from(ORDER)) * longest.powf(1.0 - 1.0 / f64::from(ORDER))
        } else {
            longest
        };
        (0.01 * step).min(longest)
    }

    fn attempt_until(&mut self, system: &S, end: f64, scale: &[f64]) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        let (t, h) = (self.time, end - self.time);
        (self.step, self.end_time) = (h, end);
        self.advance::<1, S>(system, t + NODES[1] * h);
        self.advance::<2, S>(system, t + NODES[2] * h);
        self.advance::<3, S>(system, t + NODES[3] * h);
        self.advance::<4, S>(system, t + NODES[4] * h);
        self.advance::<5, S>(system, t + NODES[5] * h);
        self.advance::<6, S>(system, t + NODES[6] * h);
        self.advance::<7, S>(system, end);
        self.advance::<8, S>(system, end);
        self.conclude();
        self.last_known = true;
        self.error(scale)
    }

    fn end_slopes(&mut self, system: &S) {
        if !self.last_known {
            self.stage.copy_from_slice(&self.end[..self.positions]);
            self.evaluate(system, self.end_time, END);
            self.last_known = true;
        }
    }

    fn dense(&mut self, system: &S) {
        if self.dense_known {
            return;
        }
        self.interpolate();
        for sample in REFINED {
            let stage = SAMPLED[sample];
            for i in 0..self.positions {
                self.stage[i] = self.at(i, NODES[stage]);
            }
            self.evaluate(system, self.time + NODES[stage] * self.step, stage);
        }
        self.interpolate();
        self.dense_known = true;
    }

    fn cut(&mut self, t: f64) {
        let share = (t - self.time) / self.step;
        for i in 0..self.end.len() {
            self.end[i] = self.at(i, share);
        }
        self.end_time = t;
        self.last_known = false;
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.time = self.end_time;
        let known = self.last_known;
        if known {
            self.k.iter_mut().for_each(|k| k[0] = k[END]);
        }
        self.forget_step();
        self.first_known = known;
    }

    fn value(&self, i: usize, t: f64) -> f64 {
        self.at(i, (t - self.time) / self.step)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn end_time(&self) -> f64 {
        self.end_time
    }

    fn begin(&self) -> &[f64] {
        &self.begin
    }

    fn begin_mut(&mut self) -> &mut [f64] {
        &mut self.begin
    }

    fn end(&self) -> &[f64] {
        &self.end
    }

    fn begin_slope(&self, i: usize) -> f64 {
        self.k[i - self.positions][0]
    }

    fn end_slope(&self, i: usize) -> f64 {
        self.k[i - self.positions][END]
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}
