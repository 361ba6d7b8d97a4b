//! A run that keeps step with the clock on the wall.

use std::cell::Cell;
use std::time::{Duration, Instant};
use stickslip_console::progress::Bar;
use stickslip_run::Watcher;

/// Longest sleep before somebody who wants it to end is heard, s.
const NAP: f64 = 0.05;

/// Lets a run wait for its own time: from what it reaches at t seconds it goes on when t seconds have passed. It looks at the clock
/// and sleeps, so that no bit of what it computes can depend on it.
pub(crate) struct Paced<'a> {
    bar: &'a Bar<'a>,
    from: f64,
    begun: Cell<Option<Instant>>,
    /// Furthest that the run was behind the clock, s.
    behind: Cell<f64>,
}

impl<'a> Paced<'a> {
    /// For a run that goes on from a simulated time, s.
    pub(crate) fn new(bar: &'a Bar<'a>, from: f64) -> Self {
        Self { bar, from, begun: Cell::new(None), behind: Cell::new(0.0) }
    }

    /// How it went, in words.
    pub(crate) fn words(&self) -> String {
        let behind = 1e3 * self.behind.get();
        // A tick of an ordinary kernel and what a table takes to be written are no falling behind.
        if behind < 10.0 {
            format!("real time was kept: the run was never more than {behind:.3} ms behind the clock")
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
        // Asked anew after every nap: sleeps are as long as the system likes.
        while ahead() > 0.0 && self.bar.goes_on() {
            std::thread::sleep(Duration::from_secs_f64(ahead().clamp(0.0, NAP)));
        }
    }

    fn goes_on(&self) -> bool {
        self.bar.goes_on()
    }
}
