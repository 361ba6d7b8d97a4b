//! What an event-aware run asks of a method.

use crate::Grade;
use std::ops::Range;

/// What a method is, whatever it is at.
// Three small contracts instead of one, and only the last one knows the system: who asks for the ends of a step names no
// system to do so.
pub trait Method {
    /// Largest |hλ| at which a motion e^{λt} that swings or fades does not grow.
    fn stability_limit(&self) -> f64;
    /// Whether the coming steps are exact and free at any length.
    fn coasts(&self) -> bool;
    /// Whether it knows steps whose stages crowd towards an end; otherwise all are even.
    fn grades(&self) -> bool {
        true
    }
    /// Evaluations of the slopes since construction.
    fn evaluations(&self) -> u64;
    /// Where the motion stands among the methods of a pair.
    fn hand(&self) -> Hand {
        Hand::default()
    }
    /// Stands there again after an attempt that is to be made once more.
    fn set_hand(&mut self, hand: Hand) {
        let _ = hand;
    }
}

/// The step tried: what is known of it, and what becomes of it.
pub trait Step {
    /// Its two ends.
    fn span(&self) -> Span<'_>;
    /// Slope of a velocity, component `i` of the state, at one end of it; known at its start, and at its end once the step is
    /// [complete](Attempt::complete).
    fn slope(&self, i: usize, at: End) -> f64;
    /// Component `i` at time `t` of it, by the dense output.
    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        self.value_at(i, self.part(t))
    }
    /// Where in it time `t` lies, as the dense output counts: asked once for all components of a moment.
    fn part(&self, t: f64) -> f64;
    /// The time at such a part of it, s, and how fast time goes there, s per part.
    fn moment(&self, part: f64) -> [f64; 2];
    /// Component `i` at such a part of it.
    fn value_at(&self, i: usize, part: f64) -> f64;
    /// Ends it at an earlier time `t`, in the state of the dense output.
    fn cut(&mut self, t: f64);
    /// Moves to its end.
    fn accept(&mut self);
    /// The slopes at its start, in the stepper's own order, into the room of `slopes`; none where they are not known. They
    /// belong to a run's state: what the system answers now may round otherwise than what it answered before its memory moved.
    fn first_slopes(&self, slopes: &mut Vec<f64>);
}

/// A one-step method that attempts; someone else accepts.
///
/// ```text
/// start ──► attempt ──► (complete, value, cut) ──► accept ──► attempt …
///             ▲  │ error too large: same start, other step
///             └──┘
/// ```
pub trait Attempt<S: ?Sized>: Method + Step {
    /// Puts the stepper at time `t` and state `y`, of which it takes as many components as it has, and evaluates the
    /// slopes there: due at first, and after anything that makes them jump.
    fn start(&mut self, system: &S, t: f64, y: &[f64]);
    /// Puts a new stepper where another one stood with its motion at time `t` and state `y`, with the
    /// [slopes](Step::first_slopes) that it had there: both go on to the same bits. Without slopes it starts.
    fn take_up(&mut self, system: &S, at: (f64, &[f64]), hand: Hand, slopes: &[f64]);
    /// A first step for a fresh start, at most `longest`.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64;
    /// Tries a step and returns its error in units of `scale`: 1 is just at the tolerance, [`f64::INFINITY`] not finite.
    ///
    /// May be called any number of times from the same start.
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64;
    /// All components at a time `t` inside the step tried, as exactly as at its end, where the dense output is not as exact as that; false
    /// where it is, or is all there is. The step stays as it is, and nothing is counted. `scale` as for an attempt.
    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        let _ = (system, t, scale, out);
        false
    }
    /// Puts some components of a step that was cut as exactly as [`visit`](Self::visit) tells them, and counts that.
    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        let _ = (system, scale, components);
    }
    /// Cuts the step at an earlier time `t`, where the dense output is there, into the state that [`visit`](Self::visit) tells.
    fn cut_exactly(&mut self, system: &S, t: f64, scale: &[f64]) {
        let _ = (system, scale);
        self.cut(t);
    }
    /// Makes more known of the step tried, at the first call only.
    fn complete(&mut self, system: &S, what: Completion);
}

/// Which of two methods carries a motion, and what is known where it stands. It belongs to the state of a run: both methods
/// evaluate one law, in another order, and what is known is not counted again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hand {
    /// Whether the last attempt was one with graded stages.
    pub graded: bool,
    /// Whether the other method is there, too; of an implicit one whether its derivatives are.
    pub both: bool,
}

/// Where a step is to end, and how its stages lie in it.
///
/// An end, not a length: t + (end - t) may miss a corner far ahead by a last place, and a waveform has its other side there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// End, s; met to the last bit, as a waveform's corner wants it.
    pub end: f64,
    /// How its stages lie in it.
    pub grade: Grade,
}

impl Target {
    /// An end met by stages that lie evenly.
    #[must_use]
    pub fn even(end: f64) -> Self {
        Self { end, grade: Grade::Even }
    }
}

/// What is to be known of a step beyond its error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completion {
    /// The slopes at its end.
    EndSlopes,
    /// The dense output.
    Dense,
}

/// The ends of the step tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span<'a> {
    /// Time at its start, s.
    pub time: f64,
    /// Time at its end, s.
    pub end_time: f64,
    /// State at its start.
    pub begin: &'a [f64],
    /// State at its end.
    pub end: &'a [f64],
}

/// An end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Where it starts.
    Start,
    /// Where it ends.
    End,
}
