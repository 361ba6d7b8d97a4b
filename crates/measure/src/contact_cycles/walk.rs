//! The way of a contact in a cycle, walked once more, and what its law is asked there.

use super::Track;
use std::ops::Range;
use stickslip_contact::{Apex, Interface, Memory, Segment};

/// Halvings of an interval in which the force changes sign: to the last place.
const HALVINGS: u32 = 64;

/// What the law is asked for in a cycle: between which moment and the next, and at which u; without one, where F_x passes the
/// middle of its range.
pub(super) struct Question {
    pub(super) after: usize,
    pub(super) u: Option<f64>,
    /// Extreme of u that this u is on the way back from, m.
    pub(super) extreme: f64,
    /// u where F_x passes the middle, or F_x at u.
    pub(super) answer: f64,
}

/// A contact led once more along the moments of a run.
pub(super) struct Walk {
    memory: Memory,
    /// Indentation, m.
    d: f64,
    /// Displacements of moments before those of the track, which it has not been led to yet, m.
    pub(super) pending: Vec<f64>,
    /// The moment of the track where it stands, once it has been led along all that are pending.
    pub(super) at: Option<usize>,
}

impl Walk {
    /// Where the run starts.
    pub(super) fn new(memory: Memory) -> Self {
        Self { memory, d: f64::NAN, pending: Vec::new(), at: None }
    }

    /// Takes the indentation of the first moment: it is that of all.
    pub(super) fn begin(&mut self, d: f64) {
        if self.d.is_nan() {
            self.d = d;
        }
    }

    /// Leads it along what is pending.
    pub(super) fn catch_up(&mut self, law: &Interface) {
        let Self { memory, d, pending, .. } = self;
        for u in pending.drain(..) {
            // The run has been here: its contact was not refused.
            let _ = memory.commit(law, Segment::Straight(Apex { d: *d, u }));
        }
    }

    /// Answers questions of a cycle that is not before the one asked about last.
    pub(super) fn answer(
        &mut self,
        (track, law): (&Track, &Interface),
        span: &Range<usize>,
        (count, middle): (f64, f64),
        questions: &mut [Question],
    ) {
        self.catch_up(law);
        let d = self.d;
        // In order of their moments.
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

/// Where a force that changes its sign once vanishes.
fn zero(force: impl Fn(f64) -> f64, [mut from, mut to]: [f64; 2]) -> f64 {
    let falls = force(to) < 0.0;
    for _ in 0..HALVINGS {
        let middle = from + 0.5 * (to - from);
        if (force(middle) < 0.0) == falls { to = middle } else { from = middle }
    }
    to
}
