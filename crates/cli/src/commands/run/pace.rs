//! Run in step with wall time.

use std::cell::Cell;
use std::time::{Duration, Instant};
use stickslip_console::progress::Bar;
use stickslip_run::Watcher;

/// Longest sleep between checks for an interruption, s.
const NAP: f64 = 0.05;

/// Watcher that delays a run to wall time: simulated time t is not passed before t seconds have elapsed. It only sleeps
/// and has no effect on results.
pub(crate) struct Paced<'a> {
    bar: &'a Bar<'a>,
    from: f64,
    begun: Cell<Option<Instant>>,
    /// Largest delay of the run behind the clock, s.
    behind: Cell<f64>,
}

impl<'a> Paced<'a> {
    /// Creates the watcher for a run that starts at a simulated time, s.
    pub(crate) fn new(bar: &'a Bar<'a>, from: f64) -> Self {
        Self { bar, from, begun: Cell::new(None), behind: Cell::new(0.0) }
    }

    /// Describes how well real time was kept.
    pub(crate) fn words(&self) -> String {
        let behind = 1e3 * self.behind.get();
        // A timer tick of the operating system and the writing of a table do not count as a delay.
        if behind < 10.0 {
            format!("real time was kept: the run was at most {behind:.3} ms behind the clock")
        } else {
            format!("real time was not kept: the run was up to {behind:.3} ms behind the clock")
        }
    }
}

impl Watcher for Paced<'_> {
    fn reached(&self, t: f64) {
        self.bar.reached(t);
        let begun = self.begun.get().unwrap_or_else(Instant::now);
        self.begun.set(Some(begun));
        let ahead = || t - self.from - begun.elapsed().as_secs_f64();
        self.behind.set(self.behind.get().max(-ahead()));
        // Checked again after every sleep, because sleeps may be longer than requested.
        while ahead() > 0.0 && self.bar.goes_on() {
            std::thread::sleep(Duration::from_secs_f64(ahead().clamp(0.0, NAP)));
        }
    }

    fn goes_on(&self) -> bool {
        self.bar.goes_on()
    }
}
