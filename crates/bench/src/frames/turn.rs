//! Computes frames of a drive, without waiting or paced by a clock, and counts the work of each.

use super::walk::Walk;
use stickslip_realtime::pace::{self, Cycle, Stop};
use stickslip_realtime::plant::{Empty, Input, Output, Work, counted};
use stickslip_realtime::worst::Slow;
use stickslip_realtime::{Drive, Overrun, Pace, Plant, Timing};
use stickslip_run::Watcher;

/// Maximum change of an input per frame, relative to half its range.
const SHARE: f64 = 0.02;
/// Number of counted work values; larger values count as the last one.
const MOST_WORK: usize = 8192;
/// Histogram of the work of frames: evaluations plus twice the memory breakpoints added or removed, in proportion to their cost.
#[derive(Debug, Clone)]
pub(super) struct Works {
    counts: Vec<u64>,
    /// First frame of each work value, with its counts.
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

    /// Returns the first frame whose work is the given quantile.
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

/// Returns the work as one number.
fn price(work: &Work) -> u64 {
    counted(work, "evaluations") + 2 * counted(work, "knots")
}

/// Drive whose inputs change in each frame.
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

    // Changing inputs and counting is not part of the measured time.
    fn timed(&mut self, slow: &Slow, _: u64) {
        self.works.count(slow.frame, &slow.work);
        self.walk.step();
        self.goes_on = self.watcher.goes_on();
    }
}

/// Empty loop.
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

/// Returns the pacing: by a clock, or without waiting.
fn pace(period: f64, paced: bool) -> Pace {
    Pace { period, overrun: paced.then_some(Overrun::Skip), spin: 0.0 }
}

/// Returns the random walk of the inputs.
pub(super) fn walk(inputs: &[Input]) -> Walk {
    Walk::new(inputs, SHARE)
}

/// Computes a number of frames, from the initial state of a drive.
///
/// # Errors
/// An error of the drive, or an interruption by the watcher.
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

/// Runs the empty loop, which measures the machine itself.
///
/// # Errors
/// An interruption by the watcher.
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

    /// Watcher that always interrupts.
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
        // Of a hundred frames, sixty have 6 evaluations and thirty-nine have 9. The 70th has 9 evaluations and ten knots.
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
