//! Progress of the runs: bars on a terminal, else a line where something begins and ends.

use crate::answer::complain;
use crate::interrupt::Interrupt;
use crate::visible::{Spelling, visible};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::{Arguments, Write};
use std::io::IsTerminal;
use stickslip_run::Watcher;

/// Ticks of a bar: one per 0.01 %.
const TICKS: u64 = 10_000;

/// The bars of all runs.
pub struct Progress {
    bars: MultiProgress,
    /// Whether there is somebody to be told who sees no bars.
    by_lines: bool,
}

/// The bar of one run, and the signal that ends it.
pub struct Bar<'a> {
    bar: ProgressBar,
    /// Before which time the bar does not move, s, and its length, s.
    from: f64,
    duration: f64,
    interrupt: &'a Interrupt,
}

/// A line that counts what has been done, and the signal that ends it.
pub struct Counter<'a> {
    bar: ProgressBar,
    interrupt: &'a Interrupt,
}

impl Watcher for Counter<'_> {
    fn reached(&self, count: f64) {
        self.bar.set_position(count as u64);
    }

    fn goes_on(&self) -> bool {
        !self.interrupt.is_raised()
    }
}

impl Drop for Counter<'_> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress {
    /// Shows bars on stderr if that is a terminal and they are wanted.
    pub fn new(wanted: bool) -> Self {
        let shown = wanted && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Self { bars: MultiProgress::with_draw_target(target), by_lines: wanted && !shown }
    }

    /// Says a line where no bar is seen.
    pub fn tell(&self, line: Arguments<'_>) {
        if self.by_lines {
            complain(line);
        }
    }

    /// A bar for a run from one time to another, s, of a bar from 0 on.
    pub fn start<'a>(&self, name: &str, [from, duration]: [f64; 2], interrupt: &'a Interrupt) -> Bar<'a> {
        let bar = self.bars.add(ProgressBar::new(TICKS));
        bar.set_position(ticks(from, duration));
        bar.reset_eta();
        let rate = move |state: &ProgressState, text: &mut dyn Write| {
            let simulated = state.pos() as f64 / TICKS as f64 * duration - from;
            let _ = write!(text, "{:.3} s/s", simulated / state.elapsed().as_secs_f64().max(1e-9));
        };
        bar.set_style(style("{prefix} {percent:>3} % {bar:30} {eta} left, {rate}").with_key("rate", rate));
        bar.set_prefix(visible(name, Spelling::Text).into_owned());
        Bar { bar, from, duration, interrupt }
    }

    /// A bar for work that has a budget of `wall` s of wall time.
    pub fn budget<'a>(&self, name: &str, wall: f64, interrupt: &'a Interrupt) -> Bar<'a> {
        let bar = self.bars.add(ProgressBar::new(TICKS));
        bar.set_style(style("{prefix} {percent:>3} % {bar:30} {eta} left"));
        bar.set_prefix(visible(name, Spelling::Text).into_owned());
        Bar { bar, from: 0.0, duration: wall, interrupt }
    }

    /// A line for work whose end nobody knows: how many of these have been done.
    pub fn count<'a>(&self, name: &str, of: &'static str, interrupt: &'a Interrupt) -> Counter<'a> {
        let bar = self.bars.add(ProgressBar::no_length());
        bar.set_style(style("{prefix} {pos} {msg}"));
        bar.set_prefix(visible(name, Spelling::Text).into_owned());
        bar.set_message(of);
        Counter { bar, interrupt }
    }

    /// Does something with the bars out of the way.
    pub fn aside<T>(&self, act: impl FnOnce() -> T) -> T {
        self.bars.suspend(act)
    }
}

/// Where a bar of a length stands at time t, s.
fn ticks(t: f64, duration: f64) -> u64 {
    (t / duration * TICKS as f64) as u64
}

/// The templates are fixed and good; the plain style would do, too.
fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl Watcher for Bar<'_> {
    fn reached(&self, t: f64) {
        self.bar.set_position(ticks(t.max(self.from), self.duration));
    }

    fn goes_on(&self) -> bool {
        !self.interrupt.is_raised()
    }
}

impl Drop for Bar<'_> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
