//! Record of a run that can be cancelled.

use stickslip_drive::{Due, Entry, Record, Wants};

/// Forwards all calls to `record`, except for `goes_on`, which may cancel the run.
pub(crate) struct Interruptible<'a> {
    pub(crate) record: &'a mut dyn Record,
    pub(crate) goes_on: &'a dyn Fn() -> bool,
}

impl Record for Interruptible<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        self.record.take(entry);
    }

    fn wants(&self) -> Wants {
        self.record.wants()
    }

    fn next(&mut self, due: Due) -> Option<f64> {
        self.record.next(due)
    }

    fn goes_on(&mut self, _: f64) -> bool {
        (self.goes_on)()
    }
}
