//! The Runge–Kutta–Nyström pair RKN8(6)9 for forces that do not depend on velocities: order 8, error estimate of order 6.
//!
//! Accelerations depend on time and positions only, so stages need no velocities. A step costs 8 evaluations instead of the 12 of
//! [`DormandPrince`](crate::DormandPrince).
//!
//! Source: J. R. Dormand, M. E. A. El-Mikkawy, P. J. Prince, *High-order embedded Runge–Kutta–Nyström formulae*, IMA Journal of Numerical
//! Analysis 7 (1987) 423–430. The dense output is a Hermite–Birkhoff interpolant of accelerations at seven nodes. At the inner nodes,
//! accelerations are evaluated again at interpolated positions. [Steps with few stages](crate::Grade::Few) use Nyström's method of order 5.

mod dense;
mod estimate;
mod order5;
mod stages;
mod storage;
mod tableau;
mod track;

pub use storage::{Many, One, Storage, Values};
pub use track::Track;

use crate::{Attempt, Completion, End, Grade, Hand, Method, Span, Step, Target};
use tableau::END;

/// Order of the error estimate: the estimate is proportional to this power of the step length.
pub const ORDER: u32 = 7;

/// A system whose accelerations and quadrature rates depend on time and positions only.
///
/// The state has n positions, n velocities and the quadratures, in this order.
pub trait Conservative {
    /// Writes the n accelerations and then the rates of the quadratures at time `t` (s) and positions `x` into `out`. All of
    /// `out` must be filled.
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]);

    /// Whether accelerations and rates are constant during the next step, so that the step needs no evaluation.
    fn coasts(&self) -> bool {
        false
    }
}

/// Runge–Kutta–Nyström method RKN8(6)9 as a one-step method whose steps the caller accepts.
///
/// ```text
/// x₁ = x + h v + h² Σ b_j k_j     v₁ = v + h Σ b'_j k_j     q₁ = q + h Σ b'_j r_j
/// ```
///
/// k_j are the accelerations and r_j the quadrature rates at stage j, whose position is x + c_j h v + h² Σ a_ji k_i. After construction the
/// method allocates no memory.
#[derive(Debug, Clone)]
pub struct Nystrom<N: Storage = Many> {
    /// Start of the step, s.
    time: f64,
    /// End of the step, s; for a cut step the time of the cut.
    end_time: f64,
    /// Length of the step attempted, s.
    step: f64,
    /// Whether the step has few stages (order 5).
    few: bool,
    /// States at both ends: positions, velocities, quadratures.
    begin: N::State,
    end: N::State,
    /// Positions of the current stage.
    stage: N::Positions,
    /// Accelerations and quadrature rates at the current stage.
    rates: N::Rates,
    /// Stage data for each position and each quadrature.
    tracks: N::Tracks,
    /// Whether the system reported constant accelerations at the start of the step.
    constant: bool,
    known: Known,
    evaluations: u64,
}

/// Which results of the current step are known.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    /// Accelerations at the start.
    first: bool,
    /// Accelerations at the end.
    last: bool,
    /// Dense output.
    dense: bool,
}

impl Nystrom {
    /// Returns a workspace for `positions` positions and `quadratures` quadratures.
    #[must_use]
    pub fn new(positions: usize, quadratures: usize) -> Self {
        Self::with_room(positions, quadratures)
    }
}

impl Nystrom<One> {
    /// Returns a workspace for one position and one quadrature.
    #[must_use]
    pub fn one() -> Self {
        Self::with_room(1, 1)
    }
}

impl<N: Storage> Nystrom<N> {
    fn with_room(positions: usize, quadratures: usize) -> Self {
        let (rates, total) = (positions + quadratures, 2 * positions + quadratures);
        Self {
            time: 0.0,
            end_time: 0.0,
            step: 0.0,
            few: false,
            begin: Values::of(total),
            end: Values::of(total),
            stage: Values::of(positions),
            rates: Values::of(rates),
            tracks: Values::of(rates),
            constant: false,
            known: Known::default(),
            evaluations: 0,
        }
    }

    /// Returns the number of positions, a compile-time constant for storage of fixed size.
    #[inline(always)]
    fn positions(&self) -> usize {
        self.stage.as_ref().len()
    }

    /// Copies positions and velocities at the start of the step into the tracks.
    #[inline]
    fn set_out(&mut self) {
        let (positions, velocities) = self.begin.as_ref().split_at(self.positions());
        for (track, v) in self.tracks.as_mut().iter_mut().zip(velocities) {
            track.v = *v;
        }
        for (track, x) in self.tracks.as_mut().iter_mut().zip(positions) {
            track.x = *x;
        }
    }

    fn forget_step(&mut self) {
        self.known.last = false;
        self.known.dense = false;
    }

    /// Evaluates the accelerations at the start of the step.
    fn restart_slopes<S: Conservative + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        self.set_out();
        let n = self.positions();
        self.stage.as_mut().copy_from_slice(&self.begin.as_ref()[..n]);
        self.evaluate(system, self.time, 0);
        self.constant = system.coasts();
        self.known.first = true;
    }

    /// Evaluates the accelerations at the end of a step that was cut. In other steps the last stage contains them.
    fn end_slopes<S: Conservative + ?Sized>(&mut self, system: &S) {
        if !self.known.last {
            let n = self.positions();
            self.stage.as_mut().copy_from_slice(&self.end.as_ref()[..n]);
            self.evaluate(system, self.end_time, END);
            self.known.last = true;
        }
    }
}

impl<N: Storage> Method for Nystrom<N> {
    /// Returns 3.0. Numerical solutions of oscillations grow from |hλ| = 3.3 on.
    fn stability_limit(&self) -> f64 {
        // The matrix of a step has a spectral radius of 0.9999 between 2.5 and 3.2, and of 1.0002 at 3.4.
        3.0
    }

    /// Returns false. Steps under constant accelerations need no evaluation, but are treated like other steps.
    fn coasts(&self) -> bool {
        false
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl<N: Storage> Step for Nystrom<N> {
    fn span(&self) -> Span<'_> {
        Span { time: self.time, end_time: self.end_time, begin: self.begin.as_ref(), end: self.end.as_ref() }
    }

    fn slope(&self, i: usize, at: End) -> f64 {
        let stage = match at {
            End::Start => 0,
            End::End => END,
        };
        self.tracks.as_ref()[i - self.positions()].k[stage]
    }

    #[inline]
    fn value_at(&self, i: usize, part: f64) -> f64 {
        self.at(i, part)
    }

    #[inline]
    fn part(&self, t: f64) -> f64 {
        (t - self.time) / self.step
    }

    fn moment(&self, part: f64) -> [f64; 2] {
        [self.time + part * self.step, self.step]
    }

    fn cut(&mut self, t: f64) {
        let share = (t - self.time) / self.step;
        for i in 0..self.end.as_ref().len() {
            self.end.as_mut()[i] = self.at(i, share);
        }
        self.end_time = t;
        self.known.last = false;
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.time = self.end_time;
        self.set_out();
        let known = self.known.last;
        // First same as last: a step that was not cut costs 8 evaluations instead of 9.
        if known {
            self.tracks.as_mut().iter_mut().for_each(|track| track.k[0] = track.k[END]);
        }
        self.forget_step();
        self.known.first = known;
    }

    fn first_slopes(&self, slopes: &mut Vec<f64>) {
        slopes.clear();
        if self.known.first {
            slopes.extend(self.tracks.as_ref().iter().map(|track| track.k[0]));
        }
    }
}

impl<S: Conservative + ?Sized, N: Storage> Attempt<S> for Nystrom<N> {
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.time = t;
        let begin = self.begin.as_mut();
        begin.copy_from_slice(&y[..begin.len()]);
        self.restart_slopes(system);
    }

    /// Starts anew if the length of `slopes` differs from the number of positions and quadratures.
    fn take_up(&mut self, system: &S, (t, y): (f64, &[f64]), _: Hand, slopes: &[f64]) {
        if slopes.len() != self.tracks.as_ref().len() {
            return self.start(system, t, y);
        }
        self.time = t;
        let begin = self.begin.as_mut();
        begin.copy_from_slice(&y[..begin.len()]);
        self.forget_step();
        self.set_out();
        for (track, slope) in self.tracks.as_mut().iter_mut().zip(slopes) {
            track.k[0] = *slope;
        }
        (self.known.first, self.constant) = (true, system.coasts());
    }

    fn first_step(&mut self, _: &S, longest: f64, scale: &[f64]) -> f64 {
        self.starting_step(longest, scale)
    }

    /// Uses the method of order 5 for [`Grade::Few`]; all other grades give an even step.
    fn attempt(&mut self, system: &S, Target { end, grade }: Target, scale: &[f64]) -> f64 {
        self.step_to(system, end, grade == Grade::Few);
        if self.few { self.error_of_fifth(scale) } else { self.error(scale) }
    }

    /// The slopes at the end are known unless the step was cut. The dense output evaluates the inner nodes again.
    fn complete(&mut self, system: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.end_slopes(system),
            Completion::Dense => self.interpolate(system),
        }
    }
}
