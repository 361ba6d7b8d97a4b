//! Record of a run that can be cancelled.

use stickslip_drive::{Event, Record, State};

/// Forwards all calls to `record`, except for `goes_on`, which may cancel the run.
pub(crate) struct Interruptible<'a> {
    pub(crate) record: &'a mut dyn Record,
    pub(crate) goes_on: &'a dyn Fn() -> bool,
}

impl Record for Interruptible<'_> {
    fn row(&mut self, values: &[f64]) {
        self.record.row(values);
    }
    fn event(&mut self, event: &Event, values: &[f64]) {
        self.record.event(event, values);
    }
    fn wants_events(&self) -> bool {
        self.record.wants_events()
    }
    fn wants_event_rows(&self) -> bool {
        self.record.wants_event_rows()
    }
    fn leaves(&mut self, state: &State) {
        self.record.leaves(state);
    }
    fn enters(&mut self, state: &State) {
        self.record.enters(state);
    }
    fn goes_on(&mut self, _: f64) -> bool {
        (self.goes_on)()
    }
}
