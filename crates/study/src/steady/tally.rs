//! Event counts of a period.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use stickslip_drive::{Entry, Event, EventKind, Record, Source, Wants};

/// Numbers of events by source and kind.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally(BTreeMap<String, usize>);

/// Returns whether an event characterises a motion.
///
/// Three types of events are excluded: corners of waveforms, reversals, which only some contacts report, and closed loops. Rounding decides
/// whether a loop closes just before the next event or with it.
pub(super) fn tells(event: &Event) -> bool {
    let of_waveform = matches!(event.source, Source::Waveform(_));
    !of_waveform && !matches!(event.kind, EventKind::Turn | EventKind::LoopClosed)
}

impl Record for Tally {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            if !tells(event) {
                return;
            }
            *self.0.entry(format!("{:?} {:?}", event.source, event.kind)).or_default() += 1;
        }
    }

    fn wants(&self) -> Wants {
        Wants::bare_events()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_touch_more_is_another_motion_and_another_order_is_none() {
        let tally = |kinds: &[EventKind]| {
            let mut tally = Tally::default();
            for (k, kind) in kinds.iter().enumerate() {
                let event = Event { t: k as f64, source: Source::Contact(0), kind: *kind };
                tally.take(Entry::Event(&event, &[]));
            }
            tally
        };
        use EventKind::{LiftOff, LoopClosed, Touch};
        let once = tally(&[Touch, LiftOff]);
        assert_eq!(once, tally(&[LiftOff, LoopClosed, Touch]));
        assert!(once != tally(&[Touch, LiftOff, Touch]) && once != tally(&[Touch]));
    }
}
