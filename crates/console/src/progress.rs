//! Progress of runs: progress bars on a terminal, otherwise single lines.

use crate::answer::complain;
use crate::interrupt::Interrupt;
use crate::visible::{Spelling, visible};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::{Arguments, Write};
use std::io::IsTerminal;
use stickslip_run::Watcher;

/// Number of steps of a progress bar: one per 0.01 %.
const TICKS: u64 = 10_000;

/// Progress bars of all runs.
pub struct Progress {
    bars: MultiProgress,
    /// Whether progress is printed as lines because no bars are shown.
    by_lines: bool,
}

/// Progress bar of one run. As the watcher of the run, the bar also stops the run on an interrupt.
pub struct Bar<'a> {
    bar: ProgressBar,
    /// Time at which the run starts, s. The bar never shows an earlier time.
    from: f64,
    duration: f64,
    interrupt: &'a Interrupt,
}

/// Line that counts completed items. As a watcher, the counter also stops the work on an interrupt.
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
    /// Creates the display of progress. Bars are shown if they are wanted and stderr is a terminal.
    pub fn new(wanted: bool) -> Self {
        let shown = wanted && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Self { bars: MultiProgress::with_draw_target(target), by_lines: wanted && !shown }
    }

    /// Prints a line about progress to stderr if progress is wanted and no bars are shown.
    pub fn tell(&self, line: Arguments<'_>) {
        if self.by_lines {
            complain(line);
        }
    }

    /// Adds a bar for a run from the time `from` to `duration`, s. The start of the bar is time 0.
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

    /// Adds a bar for work with a budget of `wall` seconds of wall time.
    pub fn budget<'a>(&self, name: &str, wall: f64, interrupt: &'a Interrupt) -> Bar<'a> {
        let bar = self.bars.add(ProgressBar::new(TICKS));
        bar.set_style(style("{prefix} {percent:>3} % {bar:30} {eta} left"));
        bar.set_prefix(visible(name, Spelling::Text).into_owned());
        Bar { bar, from: 0.0, duration: wall, interrupt }
    }

    /// Adds a line that counts items when their total number is unknown. `of` is the name of the items.
    pub fn count<'a>(&self, name: &str, of: &'static str, interrupt: &'a Interrupt) -> Counter<'a> {
        let bar = self.bars.add(ProgressBar::no_length());
        bar.set_style(style("{prefix} {pos} {msg}"));
        bar.set_prefix(visible(name, Spelling::Text).into_owned());
        bar.set_message(of);
        Counter { bar, interrupt }
    }

    /// Hides the bars while the function `act` runs, and returns the value of `act`.
    pub fn aside<T>(&self, act: impl FnOnce() -> T) -> T {
        self.bars.suspend(act)
    }
}

/// Returns the position of a bar for time t, s.
fn ticks(t: f64, duration: f64) -> u64 {
    (t / duration * TICKS as f64) as u64
}

/// Returns the bar style of a template, or the default style if the template is invalid.
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
