//! Observers of a run.

use crate::{Entry, Record, Wants};

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
    fn take(&mut self, _: Entry<'_>) {}

    fn wants(&self) -> Wants {
        Wants::no_events()
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.0.goes_on()
    }
}
