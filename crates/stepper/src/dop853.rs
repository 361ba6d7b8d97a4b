//! The explicit Runge–Kutta method DOP853: order 8, error estimate of orders 5 and 3, dense output of order 7.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993,
//! sections II.5, II.6, II.10 and the program DOP853.

mod coast;
mod dense;
mod estimate;
mod grade;
mod tableau;

pub use grade::Grade;

use crate::System;
use tableau::{
    NODES, Row, Slopes, Stage2, Stage3, Stage4, Stage5, Stage6, Stage7, Stage8, Stage9, Stage10, Stage11,
    Stage12, Weights,
};

/// Order of the method.
pub const ORDER: u32 = 8;

/// One step of DOP853 at a time: it attempts, someone else accepts.
///
/// ```text
/// start ──► attempt ──► (dense, value, …) ──► accept ──► attempt …
///             ▲  │ error too large, or an event inside: same start, other step
///             └──┘
/// ```
///
/// A step costs 11 evaluations and one more for the slopes at its end, which are the next step's first; the dense
/// output costs three more, only when asked for. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub struct Dop853 {
    dimension: usize,
    time: f64,
    end_time: f64,
    /// End of the step attempted, s: there the dense output ends, also of a step that is cut.
    reach: f64,
    step: f64,
    begin: Vec<f64>,
    end: Vec<f64>,
    stage: Vec<f64>,
    slope: Vec<f64>,
    /// Slopes at the start of the step and at its end; those in `k` are over σ.
    first: Vec<f64>,
    last: Vec<f64>,
    grade: Grade,
    coasts: bool,
    k: Vec<Slopes>,
    polynomials: Vec<dense::Polynomial>,
    first_known: bool,
    last_known: bool,
    dense_known: bool,
    evaluations: u64,
}

impl Dop853 {
    /// Workspace for systems of `dimension` coupled components among `total`.
    ///
    /// A `total` below `dimension` counts as `dimension`.
    #[must_use]
    pub fn new(dimension: usize, total: usize) -> Self {
        let total = total.max(dimension);
        Self {
            dimension,
            time: 0.0,
            end_time: 0.0,
            reach: 0.0,
            step: 0.0,
            begin: vec![0.0; total],
            end: vec![0.0; total],
            stage: vec![0.0; dimension],
            slope: vec![0.0; total],
            first: vec![0.0; total],
            last: vec![0.0; total],
            grade: Grade::Even,
            coasts: false,
            k: vec![[0.0; 16]; total],
            polynomials: vec![dense::Polynomial::default(); total],
            first_known: false,
            last_known: false,
            dense_known: false,
            evaluations: 0,
        }
    }

    /// Puts the stepper at time `t` and state `y` (`total` components; missing ones are 0) and evaluates the slopes
    /// there.
    pub fn start<S: System + ?Sized>(&mut self, system: &S, t: f64, y: &[f64]) {
        self.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin.iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Evaluates the slopes at the current point again.
    ///
    /// Due after anything that makes them jump: an event, a waveform's corner, a state changed through
    /// [`begin_mut`](Self::begin_mut). What was attempted from here is forgotten.
    pub fn restart_slopes<S: System + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        system.slopes(self.time, &self.begin[..self.dimension], &mut self.first);
        self.evaluations += 1;
        self.coasts = system.coasts();
        self.first_known = true;
    }

    /// Tries a step of length `h` and returns its error: 1 is just at the tolerance.
    ///
    /// `scale` is the absolute tolerance of each coupled component, above 0. The error is
    /// h e₅² / √(e₅² + 0.01 e₃²), where e₅ and e₃ are the largest components of the two embedded estimates in units of
    /// `scale`; it falls with h⁸. [`f64::INFINITY`] if anything is not finite.
    ///
    /// May be called any number of times from the same start; [`accept`](Self::accept) moves on.
    pub fn attempt<S: System + ?Sized>(&mut self, system: &S, h: f64, scale: &[f64]) -> f64 {
        self.attempt_span(system, h, (self.time + h, Grade::Even), scale)
    }

    /// Like [`attempt_until`](Self::attempt_until), with stages that crowd towards a singular end of the step.
    pub fn attempt_graded<S: System + ?Sized>(
        &mut self,
        system: &S,
        end: f64,
        scale: &[f64],
        grade: Grade,
    ) -> f64 {
        self.attempt_span(system, end - self.time, (end, grade), scale)
    }

    /// Like [`attempt`](Self::attempt), but ends at the time `end` to the last bit, as a waveform's corner wants it.
    pub fn attempt_until<S: System + ?Sized>(&mut self, system: &S, end: f64, scale: &[f64]) -> f64 {
        self.attempt_graded(system, end, scale, Grade::Even)
    }

    /// Evaluates the slopes at the end of the step tried, at the first call only; [`end_slope`](Self::end_slope) reads
    /// them.
    pub fn end_slopes<S: System + ?Sized>(&mut self, system: &S) {
        if !self.last_known {
            system.slopes(self.end_time, &self.end[..self.dimension], &mut self.last);
            self.evaluations += 1;
            self.last_known = true;
        }
    }

    /// Ends the step tried at an earlier time `t` of it, in the state that the dense output has there.
    ///
    /// For an event: its state by the dense output is as good as one more attempt up to it, and free. Without dense
    /// output nothing happens.
    pub fn cut(&mut self, t: f64) {
        if !self.dense_known {
            return;
        }
        let mut end = std::mem::take(&mut self.end);
        self.values(t, &mut end);
        self.end = end;
        self.end_time = t;
        self.last_known = false;
    }

    /// Moves to the end of the step tried. Slopes evaluated there become the first ones of the next step.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.time = self.end_time;
        std::mem::swap(&mut self.first, &mut self.last);
        self.first_known = self.last_known;
        self.forget_step();
    }

    /// Time at the start of the step, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time at the end of the step tried, s.
    #[must_use]
    pub fn end_time(&self) -> f64 {
        self.end_time
    }

    /// State at the start of the step, `total` components.
    #[must_use]
    pub fn begin(&self) -> &[f64] {
        &self.begin
    }

    /// State at the start of the step, to be changed by an event. [`restart_slopes`](Self::restart_slopes) is due
    /// afterwards.
    pub fn begin_mut(&mut self) -> &mut [f64] {
        &mut self.begin
    }

    /// State at the end of the step tried, `total` components.
    #[must_use]
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// Slope of component `i` at the start of the step; NaN where it is not known yet.
    #[must_use]
    pub fn begin_slope(&self, i: usize) -> f64 {
        self.first.get(i).filter(|_| self.first_known).map_or(f64::NAN, |slope| *slope)
    }

    /// Slope of component `i` at the end of the step tried; NaN before [`end_slopes`](Self::end_slopes).
    #[must_use]
    pub fn end_slope(&self, i: usize) -> f64 {
        self.last.get(i).filter(|_| self.last_known).map_or(f64::NAN, |slope| *slope)
    }

    /// Evaluations of the slopes since construction.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn attempt_span<S: System + ?Sized>(
        &mut self,
        system: &S,
        h: f64,
        (end, grade): (f64, Grade),
        scale: &[f64],
    ) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        (self.step, self.grade) = (h, if self.coasts { Grade::Even } else { grade });
        (self.end_time, self.reach) = (end, end);
        if self.coasts {
            return self.coast(system);
        }
        self.recall_first();
        self.stage::<Stage2, 1, S>(system);
        self.stage::<Stage3, 2, S>(system);
        self.stage::<Stage4, 3, S>(system);
        self.stage::<Stage5, 4, S>(system);
        self.stage::<Stage6, 5, S>(system);
        self.stage::<Stage7, 6, S>(system);
        self.stage::<Stage8, 7, S>(system);
        self.stage::<Stage9, 8, S>(system);
        self.stage::<Stage10, 9, S>(system);
        self.stage::<Stage11, 10, S>(system);
        self.stage::<Stage12, 11, S>(system);
        self.keep::<11>();
        for ((to, y), k) in self.end.iter_mut().zip(&self.begin).zip(&self.k) {
            *to = y + h * Weights::dot(k);
        }
        if self.grade != Grade::Even {
            self.end.iter_mut().zip(&self.first).for_each(|(to, first)| *to += h * first);
        }
        self.error(scale)
    }

    /// One stage, at node `J`: keep the newest slope, combine all so far over the coupled components, evaluate the next.
    ///
    /// Evaluations follow on one another, so what counts is the path from one slope to the next: a product and a sum.
    #[inline(always)]
    fn stage<R: Row, const J: usize, S: System + ?Sized>(&mut self, system: &S) {
        let h = self.step;
        let last = h * R::LAST;
        for (((to, y), k), newest) in self.stage.iter_mut().zip(&self.begin).zip(&mut self.k).zip(&self.slope)
        {
            *to = (y + h * R::rest(k)) + last * newest;
            k[R::NEWEST] = *newest;
        }
        let quadratures = self.k[self.dimension..].iter_mut().zip(&self.slope[self.dimension..]);
        for (k, newest) in quadratures {
            k[R::NEWEST] = *newest;
        }
        if self.grade != Grade::Even {
            let past = h * self.grade.time(NODES[J]);
            self.stage.iter_mut().zip(&self.first).for_each(|(to, first)| *to += past * first);
        }
        // A node of 1 is the very end of the step, not t + h, which may differ in the last bit.
        let t = if NODES[J] == 1.0 { self.reach } else { self.time + self.grade.time(NODES[J]) * h };
        system.slopes(t, &self.stage, &mut self.slope);
        self.evaluations += 1;
        self.pace(self.grade.pace(NODES[J]));
    }

    /// From slopes over the part of the time to those over σ.
    #[inline(always)]
    fn pace(&mut self, pace: f64) {
        if self.grade != Grade::Even {
            self.slope
                .iter_mut()
                .zip(&self.first)
                .for_each(|(slope, first)| *slope = pace * (*slope - first));
        }
    }

    #[inline(always)]
    fn keep<const J: usize>(&mut self) {
        for (k, slope) in self.k.iter_mut().zip(&self.slope) {
            k[J] = *slope;
        }
    }

    fn recall_first(&mut self) {
        self.slope.copy_from_slice(&self.first);
        self.pace(self.grade.pace(0.0));
    }

    fn forget_step(&mut self) {
        self.last_known = false;
        self.dense_known = false;
    }
}
