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

use crate::{Attempt, Completion, End, Method, Span, Step, System, Target};
use tableau::{
    NODES, Row, Slopes, Stage2, Stage3, Stage4, Stage5, Stage6, Stage7, Stage8, Stage9, Stage10, Stage11,
    Stage12, Weights,
};

/// Order of the method.
pub const ORDER: u32 = 8;

/// One step of DOP853 at a time: it attempts, someone else accepts.
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

    /// Evaluates the slopes at the start of the step.
    fn restart_slopes<S: System + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        system.slopes(self.time, &self.begin[..self.dimension], &mut self.first);
        self.evaluations += 1;
        self.coasts = system.coasts();
        self.first_known = true;
    }

    /// Evaluates the slopes at the end of the step tried.
    fn end_slopes<S: System + ?Sized>(&mut self, system: &S) {
        if !self.last_known {
            system.slopes(self.end_time, &self.end[..self.dimension], &mut self.last);
            self.evaluations += 1;
            self.last_known = true;
        }
    }

    fn attempt_span<S: System + ?Sized>(
        &mut self,
        system: &S,
        Target { end, grade }: Target,
        scale: &[f64],
    ) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        let h = end - self.time;
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

impl Method for Dop853 {
    /// The region of stability ends on the imaginary axis at 6.0, on the real axis at -6.4. Steps that events cut end on
    /// the dense output, which near there is no longer that of a swing.
    fn reach(&self) -> f64 {
        5.0
    }

    /// As [`System::coasts`] said at the last evaluation of a start.
    fn coasts(&self) -> bool {
        self.coasts
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl Step for Dop853 {
    /// States have `total` components.
    fn span(&self) -> Span<'_> {
        Span { time: self.time, end_time: self.end_time, begin: &self.begin, end: &self.end }
    }

    /// Of any component; NaN where it is not known.
    fn slope(&self, i: usize, at: End) -> f64 {
        let (slopes, known) = match at {
            End::Start => (&self.first, self.first_known),
            End::End => (&self.last, self.last_known),
        };
        slopes.get(i).filter(|_| known).map_or(f64::NAN, |slope| *slope)
    }

    /// NaN where there is no dense output.
    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        self.polynomial(i).map_or(f64::NAN, |c| dense::value(c, self.fraction(t)))
    }

    /// For an event: its state by the dense output is as good as one more attempt up to it, and free. Without dense
    /// output nothing happens.
    fn cut(&mut self, t: f64) {
        if !self.dense_known {
            return;
        }
        let mut end = std::mem::take(&mut self.end);
        self.values(t, &mut end);
        self.end = end;
        self.end_time = t;
        self.last_known = false;
    }

    /// Slopes evaluated at the end become the first ones of the next step.
    fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.time = self.end_time;
        std::mem::swap(&mut self.first, &mut self.last);
        self.first_known = self.last_known;
        self.forget_step();
    }
}

impl<S: System + ?Sized> Attempt<S> for Dop853 {
    /// Components of `y` that are missing are 0.
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin.iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Hairer, Nørsett, Wanner, section II.4; one evaluation.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        self.starting_step(system, longest, scale)
    }

    /// `scale` is the absolute tolerance of each coupled component, above 0. The error is
    /// h e₅² / √(e₅² + 0.01 e₃²), where e₅ and e₃ are the largest components of the two embedded estimates in units of
    /// `scale`; it falls with h⁸.
    #[inline]
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64 {
        self.attempt_span(system, to, scale)
    }

    /// The slopes at the end cost one evaluation, the dense output three more.
    fn complete(&mut self, system: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.end_slopes(system),
            Completion::Dense => self.interpolate(system),
        }
    }
}
