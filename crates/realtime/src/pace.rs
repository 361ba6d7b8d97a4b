//! The real-time loop: one frame after each deadline, with timing statistics.
//!
//! Deadlines are multiples of the period on the monotonic clock. A delayed frame therefore does not delay later frames. Frame k is computed
//! after its deadline with the inputs available at this time. The outputs are the state at the end of the frame. Two durations are
//! recorded: the latency from the deadline to the wake-up, and the execution time from the wake-up until the outputs are sent. A frame that
//! ends after the next deadline is an overrun.

use crate::histogram::Histogram;
use crate::plant::{PlantError, STEPS, Work};
use crate::room::touched;
use crate::system::{now, sleep_until};
use crate::worst::{Slow, Worst};
use std::path::PathBuf;
use stickslip_drive::RunError;

/// Time from the start of the loop to the first deadline, ns.
const AHEAD: u64 = 2_000_000;
/// Maximum duration of a single sleep, ns. Interrupts are checked after each sleep.
const NAP: u64 = 50_000_000;
const NANO: f64 = 1e9;
/// Number of bins for the number of time steps per frame. The last bin contains all larger numbers.
const MOST_STEPS: usize = 4096;

/// Action after an overrun: a frame that ends after the next deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overrun {
    /// Missed deadlines are skipped, and the next frame waits for the next future deadline.
    ///
    /// Every frame uses the inputs available when it is computed. Simulated time falls behind the clock by one period per skipped deadline.
    /// The loop does not catch up, because the controller would not see the frames in between.
    #[default]
    Skip,
    /// The loop ends.
    Stop,
}

/// Timing of the frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Length of a frame, s.
    pub period: f64,
    /// Action after an overrun. `None` runs frames as fast as possible, without deadlines.
    pub overrun: Option<Overrun>,
    /// Time before each deadline at which the loop wakes and polls the clock, s. The value should exceed the wake-up latency of the system.
    /// With 0 the loop sleeps until the deadline.
    pub spin: f64,
}

/// Work that the loop performs in each frame.
pub trait Cycle {
    /// Computes a frame.
    ///
    /// # Errors
    /// The reason why the loop ends. The failed frame is not counted.
    fn act(&mut self, frame: u64) -> Result<Work, Stop>;

    /// Returns whether the loop continues. The loop calls this method while it waits for a distant deadline.
    fn goes_on(&self) -> bool {
        true
    }

    /// Receives the timing of a frame and the number of deadlines skipped after it. The call itself is not part of the measured time.
    fn timed(&mut self, frame: &Slow, left_out: u64) {
        let _ = (frame, left_out);
    }
}

/// Reason for the end of a loop before its last frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The simulation failed.
    Plant(PlantError),
    /// The user interrupted the loop.
    Interrupted,
    /// An overrun occurred, and the action for overruns is to stop.
    Overrun,
    /// No input was accepted for longer than allowed.
    Silence,
    /// Another process truncated the file of the shared memory.
    Cut(PathBuf),
}

impl From<PlantError> for Stop {
    fn from(error: PlantError) -> Self {
        match error {
            PlantError::Run(RunError::Interrupted { .. }) => Self::Interrupted,
            error => Self::Plant(error),
        }
    }
}

/// Timing statistics of a loop.
#[derive(Debug, Clone)]
pub struct Timing {
    /// Latencies from deadline to wake-up, ns.
    pub latency: Histogram,
    /// Execution times from wake-up to the end of the frame, ns.
    pub execution: Histogram,
    /// Number of overruns: frames that ended after the next deadline.
    pub overruns: u64,
    /// Number of skipped deadlines.
    pub left_out: u64,
    /// Maximum number of deadlines skipped in succession.
    pub longest_skip: u64,
    /// Frames with the longest execution times.
    pub slowest: Worst,
    /// Frames with the longest latencies.
    pub latest: Worst,
    /// Wall time from the first deadline to the end of the last frame, ns.
    pub wall: u64,
    /// Numbers of frames by their numbers of time steps.
    steps: Vec<u64>,
}

impl Timing {
    /// Creates empty statistics with all memory preallocated.
    pub fn new() -> Self {
        Self {
            latency: Histogram::new(),
            execution: Histogram::new(),
            overruns: 0,
            left_out: 0,
            longest_skip: 0,
            slowest: Worst::new(|slow| slow.execution),
            latest: Worst::new(|slow| slow.latency),
            wall: 0,
            steps: touched(1, 0, MOST_STEPS),
        }
    }

    /// Returns the median number of time steps per frame. Returns `u64::MAX` if the median is in the last bin.
    pub fn usual(&self) -> u64 {
        let mut seen = 0;
        let half = self.frames().div_ceil(2);
        let place = self.steps.iter().position(|count| {
            seen += count;
            seen >= half
        });
        place.filter(|place| *place < MOST_STEPS - 1).map_or(u64::MAX, |place| place as u64)
    }

    /// Returns the number of computed frames.
    pub fn frames(&self) -> u64 {
        self.execution.total()
    }

    #[inline]
    fn count(&mut self, slow: Slow, left_out: u64) {
        self.latency.count(slow.latency);
        self.execution.count(slow.execution);
        self.slowest.look(slow);
        self.latest.look(slow);
        self.steps[usize::try_from(slow.work[STEPS]).unwrap_or(MOST_STEPS).min(MOST_STEPS - 1)] += 1;
        self.left_out += left_out;
        self.longest_skip = self.longest_skip.max(left_out);
    }
}

impl Default for Timing {
    fn default() -> Self {
        Self::new()
    }
}

/// Equally spaced deadlines on the clock, ns.
#[derive(Debug, Clone, Copy)]
struct Grid {
    start: u64,
    /// Period, ns.
    period: f64,
}

impl Grid {
    /// Returns the deadline with the index `slot`, ns.
    fn at(&self, slot: u64) -> u64 {
        // The result is exact to 1 ns for loops of up to a hundred days.
        self.start + (slot as f64 * self.period).round() as u64
    }

    /// Returns the smallest index from `least` on whose deadline is not before `moment`.
    fn after(&self, moment: u64, least: u64) -> u64 {
        let about = (moment.saturating_sub(self.start) as f64 / self.period) as u64;
        let mut slot = about.max(least);
        while self.at(slot) < moment {
            slot += 1;
        }
        slot
    }
}

/// Sleeps until a time on the clock, ns, with breaks to check for interrupts.
fn wait_until(moment: u64, cycle: &impl Cycle) -> Result<(), Stop> {
    while moment.saturating_sub(now()) > NAP {
        if !cycle.goes_on() {
            return Err(Stop::Interrupted);
        }
        sleep_until(moment.min(now() + NAP));
    }
    sleep_until(moment);
    Ok(())
}

/// Runs `frames` frames unless the loop stops earlier. Apart from `cycle`, it allocates no memory and makes no system call but the sleep.
///
/// # Errors
/// The reason for an early end. `timing` then contains the statistics up to this end.
pub fn run(pace: &Pace, frames: u64, cycle: &mut impl Cycle, timing: &mut Timing) -> Result<(), Stop> {
    let start = now() + if pace.overrun.is_some() { AHEAD } else { 0 };
    let grid = Grid { start, period: NANO * pace.period };
    let spin = (NANO * pace.spin) as u64;
    let mut slot = 0;
    for frame in 0..frames {
        let mut latency = 0;
        let mut woke = now();
        if pace.overrun.is_some() {
            let deadline = grid.at(slot);
            wait_until(deadline.saturating_sub(spin), cycle)?;
            woke = now();
            while woke < deadline {
                std::hint::spin_loop();
                woke = now();
            }
            latency = woke - deadline;
        }
        let work = cycle.act(frame)?;
        let end = now();
        let slow = Slow { frame, latency, execution: end - woke, work };
        slot += 1;
        let next = match pace.overrun {
            Some(_) if end > grid.at(slot) => {
                timing.overruns += 1;
                grid.after(end, slot)
            }
            _ => slot,
        };
        timing.wall = end.saturating_sub(grid.start);
        timing.count(slow, next - slot);
        cycle.timed(&slow, next - slot);
        if next > slot && pace.overrun == Some(Overrun::Stop) {
            return Err(Stop::Overrun);
        }
        slot = next;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_deadline_is_the_first_that_lies_ahead() {
        let grid = Grid { start: 1_000, period: 100.0 };
        assert_eq!((grid.at(0), grid.at(7)), (1_000, 1_700));
        for (moment, least, slot) in [(1_700, 1, 7), (1_701, 1, 8), (1_799, 1, 8), (1_800, 1, 8), (0, 3, 3)] {
            assert_eq!(grid.after(moment, least), slot, "{moment}");
        }
        // The period is not a whole number of ns. Deadlines do not drift.
        let odd = Grid { start: 0, period: 1e9 / 3.0 };
        assert_eq!(odd.at(3_000_000_000), 1_000_000_000_000_000_000);
    }

    #[test]
    fn a_usual_frame_has_the_steps_that_half_of_all_keep() {
        let usual = |steps: &[u64]| {
            let mut timing = Timing::new();
            for steps in steps {
                let mut slow = Slow::default();
                slow.work[STEPS] = *steps;
                timing.count(slow, 0);
            }
            timing.usual()
        };
        assert_eq!((usual(&[1, 9, 3, 3, 2, 40]), usual(&[7, 8])), (3, 7));
        // More steps than the histogram distinguishes: no frame counts as unusual.
        assert_eq!(usual(&[1, 5_000, 6_000]), u64::MAX);
    }

    /// Frames that sleep beyond their deadline, with a log.
    struct Late(Vec<(u64, u64, u64)>);

    impl Cycle for Late {
        fn act(&mut self, frame: u64) -> Result<Work, Stop> {
            if frame % 5 == 2 {
                sleep_until(now() + 2_500_000);
            }
            Ok(Work::default())
        }

        fn timed(&mut self, slow: &Slow, left_out: u64) {
            self.0.push((slow.frame, slow.latency + slow.execution, left_out));
        }
    }

    #[test]
    fn overruns_are_counted_deadlines_left_out_and_all_frames_computed() {
        let pace = Pace { period: 1e-3, overrun: Some(Overrun::Skip), spin: 0.0 };
        let (mut late, mut timing) = (Late(Vec::with_capacity(20)), Timing::new());
        run(&pace, 20, &mut late, &mut timing).unwrap();
        assert!(late.0.iter().map(|(frame, ..)| *frame).eq(0..20));
        let over: Vec<_> = late.0.iter().filter(|(_, time, _)| *time > 1_000_000).collect();
        assert!(over.len() >= 4 && over.len() as u64 == timing.overruns, "{over:?}");
        // The frame takes 2.5 ms: at least two deadlines have passed, and more on a busy machine.
        assert!(over.iter().all(|(frame, _, left)| *left >= if frame % 5 == 2 { 2 } else { 1 }), "{over:?}");
        assert_eq!(timing.left_out, late.0.iter().map(|(.., left)| left).sum::<u64>());
        assert!(late.0.iter().all(|(_, time, left)| (*time > 1_000_000) == (*left > 0)));
    }

    #[test]
    fn where_an_overrun_is_the_end_it_is() {
        let pace = Pace { period: 1e-3, overrun: Some(Overrun::Stop), spin: 100e-6 };
        let (mut late, mut timing) = (Late(Vec::new()), Timing::new());
        assert_eq!(run(&pace, 20, &mut late, &mut timing), Err(Stop::Overrun));
        // On a busy machine, earlier frames may be late, too.
        assert!(timing.frames() <= 3 && timing.overruns == 1, "{}", timing.frames());
    }

    /// A loop of an hour that is interrupted while it waits.
    struct Enough(std::cell::Cell<u64>);

    impl Cycle for Enough {
        fn act(&mut self, _: u64) -> Result<Work, Stop> {
            Ok(Work::default())
        }

        fn goes_on(&self) -> bool {
            self.0.set(self.0.get() + 1);
            self.0.get() < 3
        }
    }

    #[test]
    fn a_long_wait_for_a_deadline_ends_when_it_is_asked_to() {
        let pace = Pace { period: 3600.0, overrun: Some(Overrun::Skip), spin: 0.0 };
        let (mut enough, mut timing) = (Enough(0.into()), Timing::new());
        assert_eq!(run(&pace, 20, &mut enough, &mut timing), Err(Stop::Interrupted));
        assert_eq!((timing.frames(), enough.0.get()), (1, 3));
    }

    #[test]
    fn without_a_pace_nothing_waits() {
        let pace = Pace { period: 3600.0, overrun: None, spin: 0.0 };
        let (mut late, mut timing) = (Late(Vec::new()), Timing::new());
        run(&pace, 3, &mut late, &mut timing).unwrap();
        assert_eq!((timing.frames(), timing.overruns, timing.latency.worst()), (3, 0, 0));
    }
}
