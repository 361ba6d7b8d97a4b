//! The implicit Runge–Kutta method Radau IIA of order 9 for stiff systems, with error estimate and dense output of order 5.
//!
//! An explicit method needs steps as short as the fastest decay. Radau IIA is L-stable: a component that decays within a step is close to
//! zero at the end of the step, for any step length.
//!
//! Source: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., Springer 1996, sections IV.5 and IV.8.

mod dense;
mod elimination;
mod estimate;
mod jacobian;
mod newton;
mod tableau;
mod visit;

use crate::{Attempt, Completion, End, Hand, Method, Span, Step, System, Target};
use elimination::Elimination;
use jacobian::Jacobian;
use std::ops::Range;
use tableau::{NODES, STAGES, Stages};

/// Order of the error estimate and of the error of the dense output: both are proportional to this power of the step.
pub const ORDER: u32 = 6;

/// Five-stage Radau IIA as a one-step method whose steps the caller accepts.
///
/// Stage i is at y + h Σ aᵢⱼ kⱼ with the slopes kⱼ of all stages; the last stage is the end of the step. The Jacobian costs one evaluation
/// per coupled component and one more. Each of two or three Newton corrections costs five. Slopes at the end and dense output cost none.
/// All steps have evenly distributed stages. After construction the method allocates no memory.
#[derive(Debug, Clone)]
pub struct Radau {
    /// Number of coupled components; quadratures come after these components.
    dimension: usize,
    /// Number of positions among the coupled components.
    positions: usize,
    extent: Extent,
    /// States at both ends.
    begin: Vec<f64>,
    end: Vec<f64>,
    /// Slopes at both ends.
    first: Vec<f64>,
    last: Vec<f64>,
    first_known: bool,
    last_known: bool,
    coasts: bool,
    /// Slopes of the stages (`k`) and states of the stages minus the start (`z`), by component.
    k: Vec<Stages>,
    z: Vec<Stages>,
    jacobian: Jacobian,
    /// Factored matrices of the Newton corrections (`matrix`) and of the error estimate (`filter`).
    matrix: Elimination,
    filter: Elimination,
    /// Residuals of the stage slopes, later their corrections (`missed`); resulting shifts of the stages (`shift`).
    missed: Vec<f64>,
    shift: Vec<Stages>,
    /// Coupled components of the current stage (`stage`), and all slopes there (`newest`).
    stage: Vec<f64>,
    newest: Vec<f64>,
    polynomials: Vec<dense::Polynomial>,
    dense_known: bool,
    /// Stepper for times inside the step; created on first use.
    visitor: Option<Box<Self>>,
    evaluations: u64,
}

/// Times of a step.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    /// Start, s.
    time: f64,
    /// End of the step, s; for a cut step the time of the cut.
    end_time: f64,
    /// End of the attempted step, s.
    target: f64,
    /// Length of the attempted step, s.
    step: f64,
}

/// Returns an array by its index. Unlike `array::from_fn`, it is inlined in every build.
#[inline(always)]
fn lanes<const N: usize>(f: impl Fn(usize) -> f64) -> [f64; N] {
    let (mut made, mut i) = ([0.0; N], 0);
    while i < N {
        made[i] = f(i);
        i += 1;
    }
    made
}

impl Radau {
    /// Returns a workspace for systems with `total` components, of which `dimension` are coupled and `positions` are positions
    /// ([`System::positions`]).
    ///
    /// Derivatives are finite differences with the increments `differences` of the coupled components, in their units. Increments should be
    /// small on the scale where slopes are nonlinear, and well above rounding. A `total` below `dimension` counts as `dimension`.
    #[must_use]
    pub fn new((dimension, positions): (usize, usize), total: usize, differences: Vec<f64>) -> Self {
        let total = total.max(dimension);
        let positions = positions.min(dimension / 2);
        let unknown = dimension - positions;
        Self {
            dimension,
            positions,
            extent: Extent::default(),
            begin: vec![0.0; total],
            end: vec![0.0; total],
            first: vec![0.0; total],
            last: vec![0.0; total],
            first_known: false,
            last_known: false,
            coasts: false,
            k: vec![[0.0; STAGES]; total],
            z: vec![[0.0; STAGES]; total],
            jacobian: Jacobian::new((dimension, total), differences),
            matrix: Elimination::new(STAGES * unknown),
            filter: Elimination::new(unknown),
            missed: vec![0.0; STAGES * unknown],
            shift: vec![[0.0; STAGES]; dimension],
            stage: vec![0.0; dimension],
            newest: vec![0.0; total],
            polynomials: vec![[0.0; STAGES]; total],
            dense_known: false,
            visitor: None,
            evaluations: 0,
        }
    }

    /// Evaluates the slopes at the start of the step.
    fn restart_slopes<S: System + ?Sized>(&mut self, system: &S) {
        self.forget_step();
        system.slopes(self.extent.time, &self.begin[..self.dimension], &mut self.first);
        self.evaluations += 1;
        self.coasts = system.coasts();
        (self.first_known, self.jacobian.known) = (true, false);
    }

    fn forget_step(&mut self) {
        (self.last_known, self.dense_known) = (false, false);
    }

    /// Computes the Jacobian at the start of the step.
    fn linearise<S: System + ?Sized>(&mut self, system: &S) {
        self.jacobian.take(system, self.extent.time, &self.begin);
    }

    /// Computes a parabolic step under constant forces, with its stages, without an evaluation.
    fn coast(&mut self) {
        let (h, p) = (self.extent.step, self.positions);
        for (i, slope) in self.first.iter().enumerate() {
            let bend = if i < p { self.first[p + i] } else { 0.0 };
            self.z[i] = NODES.map(|c| c * h * (slope + 0.5 * c * h * bend));
            self.end[i] = self.begin[i] + h * (slope + 0.5 * h * bend);
            self.last[i] = slope + h * bend;
        }
    }
}

impl Method for Radau {
    /// Returns infinity, because the method is L-stable.
    fn stability_limit(&self) -> f64 {
        f64::INFINITY
    }

    /// Returns the value of [`System::coasts`] at the last evaluation of the slopes at the start.
    fn coasts(&self) -> bool {
        self.coasts
    }

    fn grades(&self) -> bool {
        false
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// `both` means that the Jacobian at the start is known and its evaluations are counted.
    fn hand(&self) -> Hand {
        Hand { graded: false, both: self.jacobian.known }
    }

    fn set_hand(&mut self, hand: Hand) {
        self.jacobian.known &= hand.both;
    }
}

impl Step for Radau {
    /// States have `total` components.
    fn span(&self) -> Span<'_> {
        Span { time: self.extent.time, end_time: self.extent.end_time, begin: &self.begin, end: &self.end }
    }

    /// Accepts the index of any component; NaN if the slope is unknown. The slope at the end is that of the method's polynomial, because
    /// the right-hand side would amplify rounding of the state by the fastest decay rate.
    fn slope(&self, i: usize, at: End) -> f64 {
        let (slopes, known) = match at {
            End::Start => (&self.first, self.first_known),
            End::End => (&self.last, self.last_known),
        };
        slopes.get(i).filter(|_| known).map_or(f64::NAN, |slope| *slope)
    }

    /// Returns NaN if the dense output is unknown.
    #[inline]
    fn value_at(&self, i: usize, part: f64) -> f64 {
        self.polynomial(i).map_or(f64::NAN, |c| self.begin[i] + dense::rise(c, part))
    }

    #[inline]
    fn part(&self, t: f64) -> f64 {
        self.fraction(t)
    }

    fn moment(&self, part: f64) -> [f64; 2] {
        [self.extent.time + part * self.extent.step, self.extent.step]
    }

    /// The dense output gives the new end state and slopes. Does nothing if the dense output is unknown.
    fn cut(&mut self, t: f64) {
        if !self.dense_known {
            return;
        }
        let (part, pace) = (self.fraction(t), self.extent.step.recip());
        for (i, c) in self.polynomials.iter().enumerate() {
            self.end[i] = self.begin[i] + dense::rise(c, part);
            self.last[i] = pace * dense::rate(c, part);
        }
        self.extent.end_time = t;
    }

    /// Slopes at the end become the slopes at the start of the next step.
    fn accept(&mut self) {
        std::mem::swap(&mut self.begin, &mut self.end);
        self.extent.time = self.extent.end_time;
        std::mem::swap(&mut self.first, &mut self.last);
        (self.first_known, self.jacobian.known) = (self.last_known, false);
        self.forget_step();
    }

    fn first_slopes(&self, slopes: &mut Vec<f64>) {
        slopes.clear();
        if self.first_known {
            slopes.extend_from_slice(&self.first);
        }
    }
}

impl<S: System + ?Sized> Attempt<S> for Radau {
    /// Missing components of `y` are 0.
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.extent.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin.iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Starts anew if the length of `slopes` differs from the number of components.
    fn take_up(&mut self, system: &S, (t, y): (f64, &[f64]), hand: Hand, slopes: &[f64]) {
        if slopes.len() != self.first.len() {
            return self.start(system, t, y);
        }
        self.extent.time = t;
        let count = self.begin.len();
        self.begin.copy_from_slice(&y[..count]);
        self.forget_step();
        self.first.copy_from_slice(slopes);
        (self.first_known, self.coasts, self.jacobian.known) = (true, system.coasts(), false);
        if hand.both {
            self.linearise(system);
        }
    }

    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        self.starting_step(system, longest, scale)
    }

    /// `scale` is the absolute tolerance of each component, above 0. The error is infinite if the Newton iteration fails, which means that
    /// the step is too long.
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        self.extent.step = to.end - self.extent.time;
        (self.extent.end_time, self.extent.target) = (to.end, to.end);
        if self.coasts {
            self.coast();
            return if self.end.iter().sum::<f64>().is_finite() { 0.0 } else { f64::INFINITY };
        }
        if !self.jacobian.known {
            self.linearise(system);
            self.evaluations += self.jacobian.cost();
        }
        if !self.solve_stages(system, scale) {
            return f64::INFINITY;
        }
        self.arrive();
        let error = self.error(scale);
        if self.end.iter().sum::<f64>().is_finite() { error } else { f64::INFINITY }
    }

    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        self.invite();
        self.visit_inside(system, t, scale, out)
    }

    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        self.settle_cut(system, scale, components);
    }

    fn cut_exactly(&mut self, system: &S, t: f64, scale: &[f64]) {
        self.cut(t);
        self.settle_cut(system, scale, 0..self.end.len());
    }

    /// Neither the slopes at the end nor the dense output need an evaluation.
    fn complete(&mut self, _: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.last_known = true,
            Completion::Dense => self.interpolate(),
        }
    }
}
