//! The plain explicit reference: `Dopri5` of the crate `ode_solvers`, order 5(4), without events.
//!
//! One call covers one smooth stretch of a waveform. The crate is driven within what it does correctly (0.6.2):
//! output `Sparse`, the only one that reports each accepted step with its own time and state; a new instance for each
//! stretch, because it cannot restart; states of fixed size up to 16 components, because dynamic ones allocate dozens
//! of times per step: 708 ns instead of 203 for a step of three components.

mod scaled;

use crate::System;
use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, Dyn, OVector};
use ode_solvers::dop_shared::IntegrationError;
use ode_solvers::{Dopri5, OutputType};
use scaled::{Progress, Scaled, UNCONTROLLED};
use std::ops::{Mul, Range};

/// A system that is told of each accepted step, and moves its memory then.
pub trait Accepting: System {
    /// Commits the step that ended at time `t` in the state `y` (`total` components); `false` ends the stretch there.
    fn accept(&mut self, t: f64, y: &[f64]) -> bool;
}

/// How [`integrate`] steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceOptions {
    /// First step, s; none: chosen at the price of two evaluations. A stretch that goes on from another one knows better:
    /// [`ReferenceRun::step`].
    pub first: Option<f64>,
    /// Longest step, s, above 0; default unbounded. To be set where slopes are deaf to what a long step passes over.
    pub longest: f64,
    /// Most steps tried, rejected ones included; default a million.
    pub steps: u32,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self { first: None, longest: f64::INFINITY, steps: 1_000_000 }
    }
}

/// What came of a stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceRun {
    /// State at the end, `total` components.
    pub y: Vec<f64>,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the slopes.
    pub evaluations: u64,
    /// Longer one of the last two accepted steps, s: a good first step for the next stretch, whose end did not cut it.
    pub step: f64,
}

/// Why a stretch was not finished.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// Times that do not lead forward.
    #[error("expected finite times with start < end, got {start} and {end}")]
    Span {
        /// Start, s.
        start: f64,
        /// End, s.
        end: f64,
    },
    /// A state of the wrong length.
    #[error("expected {expected} components, got {got}")]
    State {
        /// `total` of the system.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// A tolerance that is missing or not positive.
    #[error("expected an absolute tolerance above 0 for component {index}, got {got}")]
    Scale {
        /// Coupled component.
        index: usize,
        /// Tolerance given; NaN if missing.
        got: f64,
    },
    /// Options that allow no step.
    #[error("expected a longest step above 0 and a first step above 0, got {longest} and {first:?}")]
    Options {
        /// Longest step, s.
        longest: f64,
        /// First step, s.
        first: Option<f64>,
    },
    /// More steps than allowed; also where the slopes are not finite.
    #[error("stopped at t = {t} s after {steps} steps")]
    TooManySteps {
        /// Time reached, s.
        t: f64,
        /// Steps tried.
        steps: u32,
    },
    /// The step fell below the spacing of doubles.
    #[error("the step vanished at t = {t} s")]
    StepTooSmall {
        /// Time reached, s.
        t: f64,
    },
    /// The solver took the problem for stiff.
    #[error("the problem looks stiff at t = {t} s")]
    Stiff {
        /// Time reached, s.
        t: f64,
    },
}

impl From<IntegrationError> for ReferenceError {
    fn from(error: IntegrationError) -> Self {
        match error {
            IntegrationError::MaxNumStepReached { x, n_step } => Self::TooManySteps { t: x, steps: n_step },
            IntegrationError::StepSizeUnderflow { x } => Self::StepTooSmall { t: x },
            IntegrationError::StiffnessDetected { x } => Self::Stiff { t: x },
        }
    }
}

/// Integrates `system` over a `span` of time (s), starting in `y`, and tells it of every accepted step.
///
/// `scale` is the absolute tolerance of each coupled component, above 0; the error is their root mean square.
/// Quadratures are carried along but do not steer.
///
/// # Errors
///
/// [`ReferenceError`]: arguments that fit no system, or a stretch that could not be finished; what was accepted until
/// then stays accepted.
pub fn integrate<S: Accepting>(
    system: &mut S,
    span: Range<f64>,
    y: &[f64],
    scale: &[f64],
    options: &ReferenceOptions,
) -> Result<ReferenceRun, ReferenceError> {
    check(system, &span, y, scale, options)?;
    let job = Job { span, y, scale, options };
    // A few sizes, filled up with zeros, not one for each number of components: each is a solver of its own in the program.
    match system.total() {
        0..=2 => job.run(system, Const::<2>),
        3..=4 => job.run(system, Const::<4>),
        5..=6 => job.run(system, Const::<6>),
        7..=8 => job.run(system, Const::<8>),
        9..=12 => job.run(system, Const::<12>),
        13..=16 => job.run(system, Const::<16>),
        total => job.run(system, Dyn(total)),
    }
}

fn check<S: Accepting>(
    system: &S,
    span: &Range<f64>,
    y: &[f64],
    scale: &[f64],
    options: &ReferenceOptions,
) -> Result<(), ReferenceError> {
    let Range { start, end } = *span;
    if !(start < end && start.is_finite() && end.is_finite()) {
        return Err(ReferenceError::Span { start, end });
    }
    if y.len() != system.total() {
        return Err(ReferenceError::State { expected: system.total(), got: y.len() });
    }
    for index in 0..system.dimension() {
        let got = scale.get(index).copied().unwrap_or(f64::NAN);
        if !(got > 0.0 && got.is_finite()) {
            return Err(ReferenceError::Scale { index, got });
        }
    }
    let ReferenceOptions { first, longest, .. } = *options;
    if !(longest > 0.0 && first.is_none_or(|h| h > 0.0 && h.is_finite())) {
        return Err(ReferenceError::Options { longest, first });
    }
    Ok(())
}

/// One stretch of smooth slopes, checked, in the words of [`integrate`].
struct Job<'a> {
    span: Range<f64>,
    y: &'a [f64],
    scale: &'a [f64],
    options: &'a ReferenceOptions,
}

impl Job<'_> {
    fn run<S: Accepting, D: Dim>(&self, system: &mut S, size: D) -> Result<ReferenceRun, ReferenceError>
    where
        DefaultAllocator: Allocator<D>,
        OVector<f64, D>: Mul<f64, Output = OVector<f64, D>>,
    {
        let (dimension, total) = (system.dimension(), system.total());
        let Range { start, end } = self.span;
        let longest = self.options.longest.min(end - start);
        // The solver knows one tolerance for all: it integrates y/weight at the tolerance 1. A quadrature's weight is
        // so large that its error vanishes; a power of two scales it without rounding.
        let weight = OVector::<f64, D>::from_fn_generic(size, Const::<1>, |i, _| {
            if i < dimension { self.scale[i] } else { UNCONTROLLED }
        });
        let z = OVector::<f64, D>::from_fn_generic(size, Const::<1>, |i, _| {
            self.y.get(i).map_or(0.0, |y| y / weight[i])
        });
        // Its mean runs over padding and quadratures too; this makes it one over the coupled components.
        let tolerance = (dimension.max(1) as f64 / size.value() as f64).sqrt();
        let mut progress = Progress { time: start, end, steps: [0.0; 2], y: self.y.to_vec() };
        let scaled = Scaled { system, weight, dimension, total, progress: &mut progress };
        let first = self.options.first.unwrap_or(0.0).min(longest);
        // Safety 0.9, β 0.04 and the factors 0.2 and 10 are the crate's defaults. Its test for stiffness is put off for
        // ever: a step bounded by stability is what an explicit reference does.
        let mut solver = Dopri5::from_param(
            scaled,
            start,
            end,
            end - start,
            z,
            0.0,
            tolerance,
            0.9,
            0.04,
            0.2,
            10.0,
            longest,
            first,
            self.options.steps,
            u32::MAX,
            OutputType::Sparse,
        );
        let stats = solver.integrate()?;
        drop(solver);
        Ok(ReferenceRun {
            steps: u64::from(stats.accepted_steps),
            rejected: u64::from(stats.rejected_steps),
            evaluations: u64::from(stats.num_eval),
            // Not the last step alone, which the end of the stretch has cut: fifty stretches of a swing then take 1 564
            // evaluations, and 2 250 where each chooses its first step anew.
            step: progress.steps[0].max(progress.steps[1]),
            y: progress.y,
        })
    }
}
