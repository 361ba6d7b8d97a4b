//! The explicit Runge–Kutta method DOP853: order 8, error estimate of orders 5 and 3, dense output of order 7.
//!
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993,
//! sections II.5, II.6, II.10 and the program DOP853.

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

/// One step of DOP853 at a time: it attempts, someone else accepts.
///
/// Stage i is evaluated in y + h Σ a_ij k_j at t + c_i h, and the step ends in y + h Σ b_i k_i; over a [`Grade`] the same holds
/// for the slopes over its σ. A step costs 11 evaluations and one more for the slopes at its end, which are the next step's first; the dense
/// output costs three more, only when asked for. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub struct DormandPrince {
    /// Coupled components; quadratures come after them.
    dimension: usize,
    /// All components.
    total: usize,
    extent: Extent,
    /// States at both ends. As all lists of components here they have one more than there are where that makes them even, for
    /// ever 0.
    begin: Vec<f64>,
    end: Vec<f64>,
    /// Coupled components of the stage under way, and all slopes there.
    stage: Vec<f64>,
    newest: Vec<f64>,
    ends: EndSlopes,
    /// Whether the system said at the start that nothing changes what acts.
    coasts: bool,
    /// Slopes of all stages, by pairs of components: the sums of a row run over one of them.
    k: Vec<Slopes>,
    /// The dense output, component by component.
    polynomials: Vec<dense::Polynomial>,
    dense_known: bool,
    /// Goes from the start to moments inside the step; there once somebody has asked.
    visitor: Option<Box<Self>>,
    evaluations: u64,
}

/// From when to when a step goes, and how its stages lie in it.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    /// Start, s.
    time: f64,
    /// End, s, where it was cut if it was.
    end_time: f64,
    /// End of the step attempted, s: there the dense output ends, also of a step that is cut.
    target: f64,
    /// Length of the step attempted, s.
    step: f64,
    grade: Grade,
}

/// Slopes at both ends of a step, of all components; those of the stages are over σ.
#[derive(Debug, Clone)]
struct EndSlopes {
    first: Vec<f64>,
    last: Vec<f64>,
    first_known: bool,
    last_known: bool,
}

impl DormandPrince {
    /// Workspace for systems of `dimension` coupled components among `total`.
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

    /// Evaluates the slopes at the end of the step tried.
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
    /// The region of stability ends on the imaginary axis at 6.0, on the real axis at -6.4. Steps that events cut end on
    /// the dense output, which near there is no longer that of a swing.
    fn stability_limit(&self) -> f64 {
        // A swing at 5.0 ends with 0.83 of its amplitude, and its dense output has 2.1 of it in the middle; at 6.0 the end
        // has 1.08 and the middle 16. At 4.0 it were 0.98 and 1.06, for a quarter more steps of a rest.
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

impl Step for DormandPrince {
    /// States have `total` components.
    fn span(&self) -> Span<'_> {
        let (begin, end) = (&self.begin[..self.total], &self.end[..self.total]);
        Span { time: self.extent.time, end_time: self.extent.end_time, begin, end }
    }

    /// Of any component; NaN where it is not known.
    fn slope(&self, i: usize, at: End) -> f64 {
        let (slopes, known) = match at {
            End::Start => (&self.ends.first, self.ends.first_known),
            End::End => (&self.ends.last, self.ends.last_known),
        };
        slopes[..self.total].get(i).filter(|_| known).map_or(f64::NAN, |slope| *slope)
    }

    /// NaN where there is no dense output.
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

    /// For an event: its state by the dense output is as good as one more attempt up to it, and free. Without dense
    /// output nothing happens.
    fn cut(&mut self, t: f64) {
        if !self.dense_known {
            return;
        }
        // Another attempt up to the event has order 8 instead of 7 and costs 11 evaluations: a fifth of all on the
        // benchmark drive, at the same error.
        let mut end = std::mem::take(&mut self.end);
        self.values(t, &mut end);
        self.end = end;
        self.extent.end_time = t;
        self.ends.last_known = false;
    }

    /// Slopes evaluated at the end become the first ones of the next step.
    fn accept(&mut self) {
        // Swapped, not copied: what was the start is overwritten by the next attempt.
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
    /// Components of `y` that are missing are 0.
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.extent.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin[..self.total].iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Slopes of another number than there are components are none.
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

    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        self.invite();
        self.visit_inside(system, t, scale, out)
    }

    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        self.settle_cut(system, scale, components);
    }

    /// The slopes at the end cost one evaluation, the dense output three more.
    fn complete(&mut self, system: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.end_slopes(system),
            Completion::Dense => self.interpolate(system),
        }
    }
}
