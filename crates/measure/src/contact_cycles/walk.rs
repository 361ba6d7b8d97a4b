//! Replays a contact along the sampled displacements and evaluates its law between the samples.

use super::Track;
use std::ops::Range;
use stickslip_contact::{Apex, Interface, Memory, Segment};

/// Number of bisections that locate a sign change of the force to full precision.
const HALVINGS: u32 = 64;

/// A point of a cycle at which the contact law is evaluated, between the samples `after` and `after + 1`.
///
/// If `u` is `None`, the point is where F_x crosses the middle of its range.
pub(super) struct Question {
    pub(super) after: usize,
    pub(super) u: Option<f64>,
    /// Extreme of u from which the secant to this u starts, m.
    pub(super) extreme: f64,
    /// Result: u at the crossing, m, or F_x at u, N.
    pub(super) answer: f64,
}

/// Replay of a contact: its slip memory is moved a second time along the sampled displacements of a run.
pub(super) struct Walk {
    memory: Memory,
    /// Indentation, m.
    d: f64,
    /// Displacements of earlier samples along which the replayed contact has not been moved yet, m.
    pub(super) pending: Vec<f64>,
    /// Index of the sample that the replayed contact has reached.
    pub(super) at: Option<usize>,
}

impl Walk {
    /// Creates a contact with the slip memory at the start of the run.
    pub(super) fn new(memory: Memory) -> Self {
        Self { memory, d: f64::NAN, pending: Vec::new(), at: None }
    }

    /// Sets the constant indentation d, m, at the first sample.
    pub(super) fn begin(&mut self, d: f64) {
        if self.d.is_nan() {
            self.d = d;
        }
    }

    /// Moves the contact along the pending displacements.
    pub(super) fn catch_up(&mut self, law: &Interface) {
        let Self { memory, d, pending, .. } = self;
        for u in pending.drain(..) {
            // The run has accepted these displacements, so the commit cannot fail.
            let _ = memory.commit(law, Segment::Straight(Apex { d: *d, u }));
        }
    }

    /// Evaluates the contact law at the given points of a cycle. Cycles must be passed in order of time.
    pub(super) fn answer(
        &mut self,
        (track, law): (&Track, &Interface),
        span: &Range<usize>,
        (count, middle): (f64, f64),
        questions: &mut [Question],
    ) {
        self.catch_up(law);
        let d = self.d;
        // The points are in order of time.
        let mut next = 0;
        for i in self.at.map_or(0, |at| at + 1)..=span.end {
            if i > span.start {
                let first = next;
                next += questions[next..].iter().take_while(|question| question.after == i - 1).count();
                for question in &mut questions[first..next] {
                    let force = |u: f64| count * self.memory.force(law, Apex { d, u });
                    question.answer = match question.u {
                        Some(u) => force(u),
                        None => zero(|u| force(u) - middle, [track.u[i - 1], track.u[i]]),
                    };
                }
            }
            let _ = self.memory.commit(law, Segment::Straight(Apex { d, u: track.u[i] }));
            self.at = Some(i);
        }
    }
}

/// Returns the displacement at which a force changes its sign, by bisection.
fn zero(force: impl Fn(f64) -> f64, [mut from, mut to]: [f64; 2]) -> f64 {
    let falls = force(to) < 0.0;
    for _ in 0..HALVINGS {
        let middle = from + 0.5 * (to - from);
        if (force(middle) < 0.0) == falls { to = middle } else { from = middle }
    }
    to
}
