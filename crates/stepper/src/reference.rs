//! The plain explicit reference: the pair of order 5(4) of Dormand and Prince, without events. One call covers one smooth stretch of a
//! waveform.

use crate::dormand_prince::ORDER;
use crate::{
    Attempt, Completion, DormandPrince, Grade, Method, Step, StepControl, StepLimits, System, Target,
};
use std::ops::Range;

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
}

/// Integrates `system` over a `span` of time (s), starting in `y`, and tells it of every accepted step.
///
/// `scale` is the absolute tolerance of each coupled component, above 0; the largest error counts.
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
    let Range { start, end } = span;
    let longest = options.longest.min(end - start);
    let mut step = DormandPrince::new(system.dimension(), system.total());
    step.start(system, start, y);
    let mut h = options.first.unwrap_or_else(|| step.first_step(system, longest, scale)).min(longest);
    let mut control = StepControl::new(ORDER, StepLimits { longest, ..StepLimits::default() });
    let mut run = ReferenceRun { y: y.to_vec(), steps: 0, rejected: 0, evaluations: 0, step: 0.0 };
    let (mut t, mut before) = (start, 0.0_f64);
    while t < end {
        if run.steps + run.rejected >= u64::from(options.steps) {
            return Err(ReferenceError::TooManySteps { t, steps: options.steps });
        }
        // A last step a little longer than wished rather than a sliver behind it.
        let to = if t + 1.01 * h >= end { end } else { t + h };
        if to - t <= f64::EPSILON * t.abs() {
            return Err(ReferenceError::StepTooSmall { t });
        }
        let verdict =
            control.propose(step.attempt(system, Target { end: to, grade: Grade::Few }, scale), to - t);
        h = verdict.next;
        if !verdict.accepted {
            run.rejected += 1;
            continue;
        }
        step.complete(system, Completion::EndSlopes);
        step.accept();
        run.y.copy_from_slice(step.span().begin);
        // Not the last step alone, which the end of the stretch has cut.
        (run.step, before) = (before.max(to - t), to - t);
        (run.steps, t) = (run.steps + 1, to);
        if !system.accept(t, &run.y) {
            break;
        }
    }
    run.evaluations = step.evaluations();
    Ok(run)
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
