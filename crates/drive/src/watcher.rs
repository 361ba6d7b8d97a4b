//! Observers of a run.

use crate::{Event, Record};

/// Observer that receives the progress of a run and may stop it, such as a progress bar or a signal handler.
///
/// The observer is called at every row, and at intervals of many steps, in the thread of the run. Calls should take nanoseconds.
pub trait Watcher {
    /// Receives the time reached, s.
    fn reached(&self, t: f64);

    /// Whether the run should continue.
    fn goes_on(&self) -> bool;
}

/// No observer: the run continues to its end.
impl Watcher for () {
    #[inline]
    fn reached(&self, _: f64) {}

    #[inline]
    fn goes_on(&self) -> bool {
        true
    }
}

/// Record without output, through which an observer can stop a run.
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
