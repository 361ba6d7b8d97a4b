//! The implicit Runge–Kutta method Radau IIA of order 9, for stiff systems: error estimate and dense output of order 5. What is to be
//! known of a moment as exactly as an end is had by a step up to there.
//!
//! Where something settles within nanoseconds what is to be seen for milliseconds, an explicit method takes steps of
//! nanoseconds all the time, or its own errors grow. This one is L-stable: what fades within a step is gone at its end, whatever
//! its length.
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

/// Power of the step with which the error estimate falls, and the error of the dense output.
pub const ORDER: u32 = 6;

/// One step of Radau IIA with five stages at a time: it attempts, someone else accepts.
///
/// Stage i is at y + h Σ aᵢⱼ kⱼ with the slopes kⱼ of all stages, the last one at the end. A step costs one evaluation
/// for each coupled component and one more, for the derivatives at its start, and five for each of two or three corrections;
/// its slopes at the end and the dense output are free. Grades are not known to it: all steps are even. Nothing is allocated
/// after construction.
#[derive(Debug, Clone)]
pub struct Radau {
    /// Coupled components; quadratures come after them.
    dimension: usize,
    /// Positions among them.
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
    /// By component: slopes of the stages, and the stages less the start.
    k: Vec<Stages>,
    z: Vec<Stages>,
    jacobian: Jacobian,
    /// Of the corrections, and of the estimate.
    matrix: Elimination,
    filter: Elimination,
    /// What the slopes of the stages miss, then their corrections; and what these make of the stages.
    missed: Vec<f64>,
    shift: Vec<Stages>,
    /// Coupled components of a stage, and all slopes there.
    stage: Vec<f64>,
    newest: Vec<f64>,
    polynomials: Vec<dense::Polynomial>,
    dense_known: bool,
    /// Goes from the start to moments inside the step; there once somebody has asked.
    visitor: Option<Box<Self>>,
    evaluations: u64,
}

/// From when to when a step goes.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    /// Start, s.
    time: f64,
    /// End, s, where it was cut if it was.
    end_time: f64,
    /// End of the step attempted, s.
    target: f64,
    /// Length of the step attempted, s.
    step: f64,
}

impl Radau {
    /// Workspace for systems of `dimension` coupled components, `positions` of them as [`System::positions`] has them, among
    /// `total`. Derivatives are differences over `differences` of each coupled component, in its unit: small against what
    /// bends its slopes, and far above its rounding.
    ///
    /// A `total` below `dimension` counts as `dimension`.
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

    /// Derivatives at the start, and what the first step needs beside them.
    fn linearise<S: System + ?Sized>(&mut self, system: &S) {
        self.jacobian.take(system, self.extent.time, &self.begin);
    }

    /// A parabola under constant forces: its stages, without an evaluation.
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
    /// None: what fades fades in any step.
    fn stability_limit(&self) -> f64 {
        f64::INFINITY
    }

    /// As [`System::coasts`] said at the last evaluation of a start.
    fn coasts(&self) -> bool {
        self.coasts
    }

    fn grades(&self) -> bool {
        false
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Whether the derivatives at the start are known, and counted.
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

    /// Of any component; NaN where it is not known. At the end it is that of the method's own polynomial: slopes of a state
    /// that is off by rounding are off by as much as it settles fast.
    fn slope(&self, i: usize, at: End) -> f64 {
        let (slopes, known) = match at {
            End::Start => (&self.first, self.first_known),
            End::End => (&self.last, self.last_known),
        };
        slopes.get(i).filter(|_| known).map_or(f64::NAN, |slope| *slope)
    }

    /// NaN where there is no dense output.
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

    /// Its state and its slopes by the dense output. Without dense output nothing happens.
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

    /// Slopes at the end become the first ones of the next step.
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
    /// Components of `y` that are missing are 0.
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        self.extent.time = t;
        self.begin.fill(0.0);
        for (to, from) in self.begin.iter_mut().zip(y) {
            *to = *from;
        }
        self.restart_slopes(system);
    }

    /// Slopes of another number than there are components are none.
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

    /// `scale` is the absolute tolerance of each component, above 0. Infinite where no stages are found: the step is too long.
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

    /// Neither costs an evaluation.
    fn complete(&mut self, _: &S, what: Completion) {
        match what {
            Completion::EndSlopes => self.last_known = true,
            Completion::Dense => self.interpolate(),
        }
    }
}
