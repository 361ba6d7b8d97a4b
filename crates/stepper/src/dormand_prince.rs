//! The explicit Runge–Kutta method DOP853: order 8, error estimate of orders 5 and 3, dense output of order 7.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993, sections
//! II.5, II.6, II.10 and the program DOP853.

mod coast;
mod dense;
mod estimate;
mod grade;
mod order5;
mod order8;
mod stages;
mod tableau;
mod visit;

pub use grade::Grade;

use crate::{Attempt, Completion, End, Hand, Method, Span, Step, System, Target};
use std::ops::Range;
use tableau::Slopes;

/// Order of the method.
pub const ORDER: u32 = 8;

/// DOP853 as a one-step method whose steps the caller accepts.
///
/// Stage i is evaluated at y + h Σ a_ij k_j and t + c_i h; the step ends at y + h Σ b_i k_i. In a graded step ([`Grade`]) the same formulas
/// hold for derivatives with respect to σ.
///
/// A step costs 11 evaluations, and one for the slopes at its end, which the next step reuses. The dense output, computed on request only,
/// costs three more. After construction the method allocates no memory.
#[derive(Debug, Clone)]
pub struct DormandPrince {
    /// Number of coupled components; quadratures come after these components.
    dimension: usize,
    /// Number of all components.
    total: usize,
    extent: Extent,
    /// States at both ends of the step. All lists of components are padded with a zero to an even length.
    begin: Vec<f64>,
    end: Vec<f64>,
    /// Coupled components of the current stage (`stage`), and all slopes there (`newest`).
    stage: Vec<f64>,
    newest: Vec<f64>,
    ends: EndSlopes,
    /// Whether the system reported constant accelerations at the start of the step.
    coasts: bool,
    /// Slopes of all stages, by pairs of components.
    k: Vec<Slopes>,
    /// Dense output by component.
    polynomials: Vec<dense::Polynomial>,
    dense_known: bool,
    /// Stepper for times inside the step; created on first use.
    visitor: Option<Box<Self>>,
    evaluations: u64,
}

/// Times of a step, and the distribution of its stages.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    /// Start, s.
    time: f64,
    /// End of the step, s; for a cut step the time of the cut.
    end_time: f64,
    /// End of the attempted step, s. The dense output ends there, even if the step was cut.
    target: f64,
    /// Length of the attempted step, s.
    step: f64,
    grade: Grade,
}

/// Time derivatives of all components at both ends of a step. Slopes of stages, in contrast, are derivatives with respect to σ.
#[derive(Debug, Clone)]
struct EndSlopes {
    first: Vec<f64>,
    last: Vec<f64>,
    first_known: bool,
    last_known: bool,
}

impl DormandPrince {
    /// Returns a workspace for systems with `dimension` coupled components and `total` components.
    ///
    /// A `total` below `dimension` counts as `dimension`.
    #[must_use]
    pub fn new(dimension: usize, total: usize) -> Self {
        let total = total.max(dimension);
        let room = vec![0.0; total.next_multiple_of(2)];
        Self {
            dimension,
            total,
            extent: Extent::default(),
            begin: room.clone(),
            end: room.clone(),
            stage: vec![0.0; dimension.next_multiple_of(2)],
            newest: room.clone(),
            ends: EndSlopes { first: room.clone(), last: room, first_known: false, last_known: false },
            coasts: false,
            k: vec![Slopes::default(); total.div_ceil(2)],
            polynomials: vec![dense::Polynomial::default(); total],
            dense_known: false,
            visitor: None,
            evaluations: 0,
        }
    }

    /// Evaluates the slopes at the start of the step.
    fn restart_slopes<S: System + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        let first = &mut self.ends.first[..self.total];
        system.slopes(self.extent.time, &self.begin[..self.dimension], first);
        self.evaluations += 1;
        self.coasts = system.coasts();
        self.ends.first_known = true;
    }

    /// Evaluates the slopes at the end of the step, unless already known.
    fn end_slopes<S: System + ?Sized>(&mut self, system: &S) {
        if !self.ends.last_known {
            let last = &mut self.ends.last[..self.total];
            system.slopes(self.extent.end_time, &self.end[..self.dimension], last);
            self.evaluations += 1;
            self.ends.last_known = true;
        }
    }

    fn forget_step(&mut self) {
        self.ends.last_known = false;
        self.dense_known = false;
    }
}

impl Method for DormandPrince {
    /// Returns 5.0. The stability region ends at 6.0 on the imaginary axis and at -6.4 on the real axis. Near the boundary of this region,
    /// the dense output of an oscillation, where events cut steps, is inaccurate.
    fn stability_limit(&self) -> f64 {
        // At |hλ| = 5 an oscillation has 0.83 of its amplitude at the end of a step; at 6 it grows.
        5.0
    }

    /// Returns the value of [`System::coasts`] at the last evaluation of the slopes at the start.
    fn coasts(&self) -> bool {
        self.coasts
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl Step for DormandPrince {
    /// States have `total` components.
    #[inline]
    fn span(&self) -> Span<'_> {
        let (begin, end) = (&self.begin[..self.total], &self.end[..self.total]);
        Span { time: self.extent.time, end_time: self.extent.end_time, begin, end }
    }

    /// Accepts the index of any component. Returns NaN if the slope is unknown.
    fn slope(&self, i: usize, at: End) -> f64 {
        let (slopes, known) = match at {
            End::Start => (&self.ends.first, self.ends.first_known),
            End::End => (&self.ends.last, self.ends.last_known),
        };
        slopes[..self.total].get(i).filter(|_| known).map_or(f64::NAN, |slope| *slope)
    }

    /// Returns NaN if the dense output is unknown.
    #[inline]
    fn value_at(&self, i: usize, part: f64) -> f64 {
        self.polynomial(i).map_or(f64::NAN, |c| dense::value(c, part))
    }

    #[inline]
    fn part(&self, t: f64) -> f64 {
        self.fraction(t)
    }

    fn moment(&self, part: f64) -> [f64; 2] {
        let Extent { time, step, grade, .. } = self.extent;
        [time + step * grade.time(part), step * grade.pace(part)]
    }

    /// Does nothing if the dense output is unknown.
    fn cut(&mut self, t: f64) {
        if !self.dense_known {
            return;
        }
        // Another attempt up to the event would have order 8 instead of 7, but cost 11 evaluations.
        let mut end = std::mem::take(&mut self.end);
        self.values(t, &mut end);
        self.end = end;
        self.extent.end_time = t;
        self.ends.last_known = false;
    }

    /// Slopes known at the end become the slopes at the start of the next step.
    fn accept(&mut self) {
        // Swapped instead of copied: the next attempt overwrites the old start.
        std::mem::swap(&mut self.begin, &mut self.end);
        self.extent.time = self.extent.end_time;
        std::mem::swap(&mut self.ends.first, &mut self.ends.last);
        self.ends.first_known = self.ends.last_known;
        self.forget_step();
    }

    fn first_slopes(&self, slopes: &mut Vec<f64>) {
        slopes.clear();
        if self.ends.first_known {
            slopes.extend_from_slice(&self.ends.first[..self.total]);
        }
    }
}

impl<S: System + ?Sized> Attempt<S> for DormandPrince {
    /// Missing components of `y` are 0.
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.extent.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin[..self.total].iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Starts anew if the length of `slopes` differs from the number of components.
    fn take_up(&mut self, system: &S, (t, y): (f64, &[f64]), _: Hand, slopes: &[f64]) {
        if slopes.len() != self.total {
            return self.start(system, t, y);
        }
        self.extent.time = t;
        self.begin[..self.total].copy_from_slice(&y[..self.total]);
        self.forget_step();
        self.ends.first[..self.total].copy_from_slice(slopes);
        (self.ends.first_known, self.coasts) = (true, system.coasts());
    }

    /// Uses the rule of Hairer, Nørsett, Wanner, section II.4, which costs one evaluation.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        self.starting_step(system, longest, scale)
    }

    /// `scale` is the absolute tolerance of each coupled component, above 0. The error is h e₅² / √(e₅² + 0.01 e₃²). e₅ and e₃ are the
    /// largest components of the two embedded estimates in units of `scale`. The error is of order h⁸.
    #[inline]
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64 {
        self.attempt_span(system, to, scale)
    }

    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        self.invite();
        self.visit_inside(system, t, scale, out)
    }

    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        self.settle_cut(system, scale, components);
    }

    /// Slopes at the end cost one evaluation, the dense output three more.
    fn complete(&mut self, system: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.end_slopes(system),
            Completion::Dense => self.interpolate(system),
        }
    }
}
