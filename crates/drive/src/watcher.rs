//! Who looks on while a run goes on.

use crate::{Event, Record};

/// Somebody who is told how far a run has come and may end it: a progress bar, a signal, a window.
///
/// Told at every row and asked every so many steps, by the thread that runs: an answer should take nanoseconds.
pub trait Watcher {
    /// The run has come to time `t`, s.
    fn reached(&self, t: f64);

    /// Whether the run is to go on.
    fn goes_on(&self) -> bool;
}

/// Nobody: the run goes on to its end.
impl Watcher for () {
    #[inline]
    fn reached(&self, _: f64) {}

    #[inline]
    fn goes_on(&self) -> bool {
        true
    }
}

/// A record that keeps nothing, and through which somebody ends a run.
pub struct Unrecorded<'a>(pub &'a dyn Watcher);

impl Record for Unrecorded<'_> {
    fn row(&mut self, _: &[f64]) {}

    fn event(&mut self, _: &Event, _: &[f64]) {}

    fn goes_on(&mut self, _: f64) -> bool {
        self.0.goes_on()
    }

    fn wants_events(&self) -> bool {
        false
    }
}
