//! Dormand–Prince 5(4) without events, as a reference method. One call integrates between two corners of the waveforms.

use crate::dormand_prince::ORDER;
use crate::{
    Attempt, Completion, DormandPrince, Grade, Method, Step, StepControl, StepLimits, System, Target,
};
use std::ops::Range;

/// A system that is notified of each accepted step and then updates its memory.
pub trait Accepting: System {
    /// Accepts the step that ended at time `t` (s) in the state `y` (`total` components). Returning `false` ends the integration there.
    fn accept(&mut self, t: f64, y: &[f64]) -> bool;
}

/// Options of [`integrate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceOptions {
    /// First step, s. None selects the length automatically at the cost of two evaluations. To continue, use [`ReferenceRun::step`].
    pub first: Option<f64>,
    /// Maximum step, s, above 0; unbounded by default. Set a value if long steps could pass over changes of the slopes.
    pub longest: f64,
    /// Largest number of attempts, including rejected ones; default a million.
    pub steps: u32,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self { first: None, longest: f64::INFINITY, steps: 1_000_000 }
    }
}

/// Result of an integration.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceRun {
    /// State at the end, `total` components.
    pub y: Vec<f64>,
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of rejected steps.
    pub rejected: u64,
    /// Number of evaluations of the slopes.
    pub evaluations: u64,
    /// Longer one of the last two accepted steps, s: a suitable first step for the next call.
    pub step: f64,
}

/// Reason why an integration failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// The times are not finite or not increasing.
    #[error("expected finite times with start < end, got {start} and {end}")]
    Span {
        /// Start, s.
        start: f64,
        /// End, s.
        end: f64,
    },
    /// The state has a wrong length.
    #[error("expected {expected} components, got {got}")]
    State {
        /// `total` of the system.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// A tolerance is missing or not positive.
    #[error("expected an absolute tolerance above 0 for component {index}, got {got}")]
    Scale {
        /// Index of the coupled component.
        index: usize,
        /// Tolerance given; NaN if missing.
        got: f64,
    },
    /// The options allow no step.
    #[error("expected a maximum step above 0 and a first step above 0, got {longest} and {first:?}")]
    Options {
        /// Largest step, s.
        longest: f64,
        /// First step, s.
        first: Option<f64>,
    },
    /// The number of attempts exceeds the limit, possibly because the slopes are not finite.
    #[error("stopped at t = {t} s after {steps} steps")]
    TooManySteps {
        /// Time reached, s.
        t: f64,
        /// Number of attempts.
        steps: u32,
    },
    /// The step length fell below the spacing of floating-point times.
    #[error("the step size became 0 at t = {t} s")]
    StepTooSmall {
        /// Time reached, s.
        t: f64,
    },
}

/// Integrates `system` over a `span` of time (s) from the state `y`, and reports every accepted step to the system.
///
/// `scale` is the absolute tolerance of each coupled component, above 0; the largest error counts. Quadratures are integrated without error
/// control. The integration ends if `system` refuses a step.
///
/// # Errors
///
/// [`ReferenceError`]: invalid arguments, or an unfinished integration. Steps accepted before the error stay accepted.
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
        // Extends the last step slightly to avoid a very short one.
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
        // The last step alone may be cut by the end of the section.
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
