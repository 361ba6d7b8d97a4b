//! The loop: one frame after each deadline, and how long everything took.
//!
//! Deadlines lie at multiples of the period on the monotonic clock, not a period after the last frame: what delays one frame
//! delays no other. Frame k is computed after its deadline, with the inputs that are there then, and says where the drive
//! stands at the frame's end. Of each frame two times are taken: from the deadline until the loop woke (the machine's), and
//! from then until the outputs were out (the program's). A frame that ends after the next deadline has overrun.

use crate::histogram::Histogram;
use crate::plant::{PlantError, STEPS, Work};
use crate::room::touched;
use crate::system::{now, sleep_until};
use crate::worst::{Slow, Worst};
use std::path::PathBuf;
use stickslip_drive::RunError;

/// How far ahead the first deadline lies, ns.
const AHEAD: u64 = 2_000_000;
/// Longest sleep before somebody who wants the loop to end is heard, ns.
const NAP: u64 = 50_000_000;
const NANO: f64 = 1e9;
/// Numbers of steps of a frame that are told apart; from here on all are one.
const MOST_STEPS: usize = 4096;

/// What is done where a frame ends after the next deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overrun {
    /// Deadlines that have passed are left out: the next frame waits for the first that still lies ahead. All frames are
    /// computed, each with the inputs of its own time; simulated time falls behind the clock by a period for each deadline
    /// left out. Frames without waiting would catch up, but no controller would have seen what comes between them; one long
    /// frame would, too, but it is not the frame that was asked for, and no replay would have it.
    #[default]
    Skip,
    /// The loop ends.
    Stop,
}

/// When frames are computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Length of a frame, s.
    pub period: f64,
    /// What is done where one ends after the next deadline; none: nothing waits for any deadline.
    pub overrun: Option<Overrun>,
    /// How long before each deadline the loop wakes and watches the clock, s: waking takes the system longer than a short
    /// frame, and differs from time to time. 0 sleeps up to the deadline.
    pub spin: f64,
}

/// What is done in each frame.
pub trait Cycle {
    /// Does the work of frame `frame`.
    ///
    /// # Errors
    /// Why the loop ends here; the frame then does not count.
    fn act(&mut self, frame: u64) -> Result<Work, Stop>;

    /// Whether the loop is to go on; asked while it waits for a deadline that is far off.
    fn goes_on(&self) -> bool {
        true
    }

    /// Is told how long a frame took, and how many deadlines are left out after it; not part of any frame's time.
    fn timed(&mut self, frame: &Slow, left_out: u64) {
        let _ = (frame, left_out);
    }
}

/// Why a loop ended before its last frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// The plant.
    Plant(PlantError),
    /// Somebody asked.
    Interrupted,
    /// A frame ended after the next deadline, and that was to be the end.
    Overrun,
    /// No input came for longer than was allowed.
    Silence,
    /// Another process made the file of the shared memory shorter.
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

/// How long everything took.
#[derive(Debug, Clone)]
pub struct Timing {
    /// From deadlines until the loop woke, ns.
    pub latency: Histogram,
    /// From then until the frames were done, ns.
    pub execution: Histogram,
    /// Frames that ended after the next deadline.
    pub overruns: u64,
    /// Deadlines left out.
    pub left_out: u64,
    /// Most deadlines left out in a row.
    pub longest_skip: u64,
    /// Frames that took longest.
    pub slowest: Worst,
    /// Frames that the loop woke for latest.
    pub latest: Worst,
    /// From the first deadline until the last frame was done, ns.
    pub wall: u64,
    /// Frames by their numbers of steps.
    steps: Vec<u64>,
}

impl Timing {
    /// Nothing yet, with all the room that is needed.
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

    /// Steps of a usual frame: the least number that half of them keep. Where that is beyond all that is told apart, no frame
    /// has more.
    pub fn usual(&self) -> u64 {
        let mut seen = 0;
        let half = self.frames().div_ceil(2);
        let place = self.steps.iter().position(|count| {
            seen += count;
            seen >= half
        });
        place.filter(|place| *place < MOST_STEPS - 1).map_or(u64::MAX, |place| place as u64)
    }

    /// Number of frames computed.
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

/// Deadlines, ns on the clock.
#[derive(Debug, Clone, Copy)]
struct Grid {
    start: u64,
    /// Period, ns.
    period: f64,
}

impl Grid {
    /// The deadline of a slot.
    fn at(&self, slot: u64) -> u64 {
        // To the ns in any loop that ends within a hundred days.
        self.start + (slot as f64 * self.period).round() as u64
    }

    /// The first slot whose deadline is not before a moment, at least `least`.
    fn after(&self, moment: u64, least: u64) -> u64 {
        let about = (moment.saturating_sub(self.start) as f64 / self.period) as u64;
        let mut slot = about.max(least);
        while self.at(slot) < moment {
            slot += 1;
        }
        slot
    }
}

/// Sleeps until a moment, by naps where that is far off.
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

/// Runs frames until there are no more of them or something stops them. Besides what the cycle does, nothing is allocated, and
/// nothing but the sleep is asked of the system.
///
/// # Errors
/// Why it ended before the last frame; `timing` has what was counted until then.
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
        // A period that is no number of ns: deadlines do not drift.
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
        // Many more than are told apart: no frame has too many.
        assert_eq!(usual(&[1, 5_000, 6_000]), u64::MAX);
    }

    /// Frames that sleep over their deadline, and what they log.
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
        // 2.5 ms from a deadline: two have passed, at least; a busy machine passes more.
        assert!(over.iter().all(|(frame, _, left)| *left >= if frame % 5 == 2 { 2 } else { 1 }), "{over:?}");
        assert_eq!(timing.left_out, late.0.iter().map(|(.., left)| left).sum::<u64>());
        assert!(late.0.iter().all(|(_, time, left)| (*time > 1_000_000) == (*left > 0)));
    }

    #[test]
    fn where_an_overrun_is_the_end_it_is() {
        let pace = Pace { period: 1e-3, overrun: Some(Overrun::Stop), spin: 100e-6 };
        let (mut late, mut timing) = (Late(Vec::new()), Timing::new());
        assert_eq!(run(&pace, 20, &mut late, &mut timing), Err(Stop::Overrun));
        // A busy machine may be late before.
        assert!(timing.frames() <= 3 && timing.overruns == 1, "{}", timing.frames());
    }

    /// Frames of an hour, in whose wait somebody has had enough.
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
