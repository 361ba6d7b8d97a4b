//! The slowest frames of a loop and their causes.

use crate::plant::{Work, counted};

/// Number of frames in a list of the slowest frames.
pub const KEPT: usize = 20;

/// Causes of slow frames. The first cause that applies is reported.
pub const KINDS: [&str; 5] = ["merge", "event", "turning point or growth", "corner or cut step", "plain"];

/// Returns the cause of a slow frame. `usual` is the usual number of time steps per frame.
///
/// * merge: a full slip memory merged breakpoints;
/// * event: the event-driven integrator located an event;
/// * turning point or growth: a slip memory gained or lost breakpoints;
/// * corner or cut step: the frame had more time steps than usual.
pub fn kind(work: &Work, usual: u64) -> &'static str {
    let has = [
        counted(work, "merges") > 0,
        counted(work, "events") > 0,
        counted(work, "knots") > 0,
        counted(work, "steps") > usual,
    ];
    KINDS[has.into_iter().position(|is| is).unwrap_or(KINDS.len() - 1)]
}

/// Timing of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Slow {
    /// Number of the frame, from 0.
    pub frame: u64,
    /// Latency from the deadline to the wake-up, ns; 0 without pacing.
    pub latency: u64,
    /// Execution time from the wake-up to the end of the frame, ns.
    pub execution: u64,
    /// Work of the frame.
    pub work: Work,
}

/// The [`KEPT`] slowest frames by latency or by execution time, in descending order.
#[derive(Debug, Clone)]
pub struct Worst {
    by: fn(&Slow) -> u64,
    frames: Vec<Slow>,
}

impl Worst {
    /// Creates an empty list. `by` returns the time of a frame that determines the order.
    pub fn new(by: fn(&Slow) -> u64) -> Self {
        Self { by, frames: Vec::with_capacity(KEPT) }
    }

    /// Adds a frame if it is among the slowest frames. Of frames with equal times, earlier frames are kept.
    #[inline]
    pub fn look(&mut self, frame: Slow) {
        let time = (self.by)(&frame);
        let full = self.frames.len() == KEPT;
        if full && self.frames.last().is_some_and(|last| (self.by)(last) >= time) {
            return;
        }
        if full {
            self.frames.pop();
        }
        let place = self.frames.partition_point(|other| (self.by)(other) >= time);
        self.frames.insert(place, frame);
    }

    /// Returns the kept frames.
    pub fn frames(&self) -> &[Slow] {
        &self.frames
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_named_by_the_rarest_thing_in_it() {
        // Steps, rejected, evaluations, events, detours, knots, merges.
        let plain = [2, 0, 6, 0, 0, 0, 0];
        assert_eq!(kind(&plain, 2), "plain");
        assert_eq!(kind(&plain, 1), "corner or cut step");
        assert_eq!(kind(&[2, 0, 6, 0, 0, 1, 0], 1), "turning point or growth");
        assert_eq!(kind(&[2, 0, 6, 1, 0, 1, 0], 1), "event");
        assert_eq!(kind(&[2, 0, 6, 1, 0, 1, 4], 1), "merge");
    }

    #[test]
    fn the_worst_are_kept_and_of_equal_ones_the_earlier() {
        let mut worst = Worst::new(|slow| slow.execution);
        // A permutation of 0 … 996; each number occurs four times.
        for frame in 0..4 * 997_u64 {
            worst.look(Slow { frame, execution: frame * 31 % 997, ..Slow::default() });
        }
        let mut all: Vec<(u64, u64)> = (0..4 * 997_u64).map(|frame| (frame * 31 % 997, frame)).collect();
        all.sort_by_key(|(time, frame)| (std::cmp::Reverse(*time), *frame));
        let kept: Vec<(u64, u64)> = worst.frames().iter().map(|slow| (slow.execution, slow.frame)).collect();
        assert_eq!(kept, all[..KEPT]);
    }
}
