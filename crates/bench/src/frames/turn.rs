//! Frames of a drive, one after the other or after a clock, with the work of each counted.

use super::walk::Walk;
use stickslip_realtime::pace::{self, Cycle, Stop};
use stickslip_realtime::plant::{Empty, Input, Output, Work, counted};
use stickslip_realtime::worst::Slow;
use stickslip_realtime::{Drive, Overrun, Pace, Plant, Timing};
use stickslip_run::Watcher;

/// Share of half its range by which an input goes in a frame, at most.
const SHARE: f64 = 0.02;
/// Works that are told apart; a frame that comes to more counts with the last of them.
const MOST_WORK: usize = 8192;
/// Frames by their work: evaluations, and twice the turning points made or given up, each at about its price.
#[derive(Debug, Clone)]
pub(super) struct Works {
    counts: Vec<u64>,
    /// The first frame of each work, and what was counted in it.
    first: Vec<(u64, Work)>,
    total: u64,
}

impl Works {
    fn new() -> Self {
        Self { counts: vec![0; MOST_WORK], first: vec![(0, Work::default()); MOST_WORK], total: 0 }
    }

    fn count(&mut self, frame: u64, work: &Work) {
        let place = usize::try_from(price(work)).unwrap_or(MOST_WORK).min(MOST_WORK - 1);
        if self.counts[place] == 0 {
            self.first[place] = (frame, *work);
        }
        self.counts[place] += 1;
        self.total += 1;
    }

    /// The first frame whose work is the least that a share of all frames keeps.
    pub(super) fn at(&self, share: f64) -> (u64, Work) {
        let wanted = (share * self.total as f64).ceil() as u64;
        let mut seen = 0;
        for (count, first) in self.counts.iter().zip(&self.first) {
            seen += count;
            if *count > 0 && seen >= wanted {
                return *first;
            }
        }
        (0, Work::default())
    }
}

/// Work as one number.
fn price(work: &Work) -> u64 {
    counted(work, "evaluations") + 2 * counted(work, "knots")
}

/// Frames of a drive under inputs that change with each of them.
struct Fed<'a, 'm> {
    drive: Drive<'m>,
    walk: Walk,
    outputs: Vec<f64>,
    works: Works,
    watcher: &'a dyn Watcher,
    goes_on: bool,
}

impl Cycle for Fed<'_, '_> {
    fn act(&mut self, _: u64) -> Result<Work, Stop> {
        if !self.goes_on {
            return Err(Stop::Interrupted);
        }
        self.drive.frame(self.walk.values(), &mut self.outputs).map_err(Stop::Plant)
    }

    // What is drawn and counted for the measurement's sake is no part of any frame's time.
    fn timed(&mut self, slow: &Slow, _: u64) {
        self.works.count(slow.frame, &slow.work);
        self.walk.step();
        self.goes_on = self.watcher.goes_on();
    }
}

/// The loop without a drive.
struct Idle<'a> {
    watcher: &'a dyn Watcher,
    goes_on: bool,
}

impl Cycle for Idle<'_> {
    fn act(&mut self, _: u64) -> Result<Work, Stop> {
        if !self.goes_on {
            return Err(Stop::Interrupted);
        }
        Empty.frame(&[], &mut []).map_err(Stop::Plant)
    }

    fn timed(&mut self, _: &Slow, _: u64) {
        self.goes_on = self.watcher.goes_on();
    }
}

/// When frames are computed: after a clock, or one after the other.
fn pace(period: f64, paced: bool) -> Pace {
    Pace { period, overrun: paced.then_some(Overrun::Skip), spin: 0.0 }
}

/// The walk that frames are fed with.
pub(super) fn walk(inputs: &[Input]) -> Walk {
    Walk::new(inputs, SHARE)
}

/// Computes so many frames of a drive at its start.
///
/// # Errors
/// What the drive says, or the watcher's wish.
pub(super) fn frames(
    drive: Drive<'_>,
    (inputs, outputs): (&[Input], &[Output]),
    period: f64,
    (frames, paced): (u64, bool),
    watcher: &dyn Watcher,
) -> Result<(Timing, Works), Stop> {
    let (walk, outputs) = (walk(inputs), vec![0.0; outputs.len()]);
    let mut fed = Fed { drive, walk, outputs, works: Works::new(), watcher, goes_on: watcher.goes_on() };
    let mut timing = Timing::new();
    pace::run(&pace(period, paced), frames, &mut fed, &mut timing)?;
    Ok((timing, fed.works))
}

/// The same without a drive: what the machine takes by itself.
///
/// # Errors
/// The watcher's wish.
pub(super) fn empty(
    period: f64,
    (frames, paced): (u64, bool),
    watcher: &dyn Watcher,
) -> Result<Timing, Stop> {
    let mut timing = Timing::new();
    let mut idle = Idle { watcher, goes_on: watcher.goes_on() };
    pace::run(&pace(period, paced), frames, &mut idle, &mut timing)?;
    Ok(timing)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Somebody who has had enough.
    struct Enough;

    impl Watcher for Enough {
        fn reached(&self, _: f64) {}

        fn goes_on(&self) -> bool {
            false
        }
    }

    #[test]
    fn the_empty_loop_hears_the_watcher() {
        assert_eq!(empty(1.0, (u64::MAX, true), &Enough).map(|_| ()), Err(Stop::Interrupted));
        assert_eq!(empty(1e-6, (100, false), &()).map(|timing| timing.frames()), Ok(100));
    }

    #[test]
    fn median_and_worst_work_are_those_of_the_first_frame_that_had_it() {
        let mut works = Works::new();
        // Of a hundred frames sixty have 6 evaluations, thirty-nine 9, the 70th 9 and ten turning points.
        for frame in 0..100_u64 {
            let mut work = Work::default();
            work[2] = if frame < 60 { 6 } else { 9 };
            work[5] = if frame == 70 { 10 } else { 0 };
            works.count(frame, &work);
        }
        assert_eq!((works.at(0.5).0, works.at(0.61).0, works.at(1.0).0), (0, 60, 70));
        assert_eq!((counted(&works.at(1.0).1, "knots"), price(&works.at(1.0).1)), (10, 29));
    }
}
