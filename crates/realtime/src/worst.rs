//! The worst frames of a loop, and what happened in them.

use crate::plant::{Work, counted};

/// How many are kept.
pub const KEPT: usize = 20;

/// What happened in a frame, by what is counted of it; the first that fits.
pub const KINDS: [&str; 5] = ["merge", "event", "turning point or growth", "corner or cut step", "plain"];

/// What happened in a frame whose loop has so many steps in a usual one: a merge is what a memory without room forgot, an event what
/// the event stepper located, a turning point or growth what a memory got or gave up, a corner or cut step what made steps more.
pub fn kind(work: &Work, usual: u64) -> &'static str {
    let has = [
        counted(work, "merges") > 0,
        counted(work, "events") > 0,
        counted(work, "knots") > 0,
        counted(work, "steps") > usual,
    ];
    KINDS[has.into_iter().position(|is| is).unwrap_or(KINDS.len() - 1)]
}

/// A frame that took long.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Slow {
    /// Which, from 0.
    pub frame: u64,
    /// From its deadline until the loop woke, ns; 0 where nothing is paced.
    pub latency: u64,
    /// From then until it was done, ns.
    pub execution: u64,
    /// Work done in it.
    pub work: Work,
}

/// The [`KEPT`] worst by one of the two times, the worst first.
#[derive(Debug, Clone)]
pub struct Worst {
    by: fn(&Slow) -> u64,
    frames: Vec<Slow>,
}

impl Worst {
    /// None yet; `by` says which time counts.
    pub fn new(by: fn(&Slow) -> u64) -> Self {
        Self { by, frames: Vec::with_capacity(KEPT) }
    }

    /// Looks at a frame. Of equal ones the earlier stays.
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

    /// Those kept.
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
        // A permutation of 0 … 996, each four times.
        for frame in 0..4 * 997_u64 {
            worst.look(Slow { frame, execution: frame * 31 % 997, ..Slow::default() });
        }
        let mut all: Vec<(u64, u64)> = (0..4 * 997_u64).map(|frame| (frame * 31 % 997, frame)).collect();
        all.sort_by_key(|(time, frame)| (std::cmp::Reverse(*time), *frame));
        let kept: Vec<(u64, u64)> = worst.frames().iter().map(|slow| (slow.execution, slow.frame)).collect();
        assert_eq!(kept, all[..KEPT]);
    }
}
