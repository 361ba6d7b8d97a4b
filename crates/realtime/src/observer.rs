//! Who looks on while a loop runs, and may end it.

use stickslip_drive::{Event, Record};

/// Who looks on. Asked by the loop before each frame and every so many steps within one, and told by a thread beside it: neither
/// answer may wait.
pub trait Observer: Sync {
    /// The loop has come to a simulated time, s.
    fn reached(&self, t: f64);

    /// Whether it is to go on.
    fn goes_on(&self) -> bool;
}

/// Nobody.
impl Observer for () {
    fn reached(&self, _: f64) {}

    fn goes_on(&self) -> bool {
        true
    }
}

/// A record that keeps nothing, and through which an observer ends a run within its frame.
pub(crate) struct Heeding<'o>(pub(crate) &'o dyn Observer);

impl Record for Heeding<'_> {
    fn row(&mut self, _: &[f64]) {}

    fn event(&mut self, _: &Event, _: &[f64]) {}

    fn goes_on(&mut self, _: f64) -> bool {
        self.0.goes_on()
    }

    fn wants_events(&self) -> bool {
        false
    }
}
