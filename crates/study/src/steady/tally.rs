//! How often each thing happens in a period.

use stickslip_drive::{Event, EventKind, Record, Source};

/// How often each thing happens, by who and what.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally(Vec<(Source, EventKind, usize)>);

/// Whether an event tells one motion from another. Corners are the waveform's, and turns are told of some contacts alone. Whether a loop
/// closes just before the next event or with it is a matter of rounding, and it closes smoothly where it begins.
pub(super) fn tells(event: &Event) -> bool {
    let of_waveform = matches!(event.source, Source::Waveform(_));
    !of_waveform && !matches!(event.kind, EventKind::Turn | EventKind::LoopClosed)
}

impl Tally {
    /// Whether as much happens as in another, in whatever order.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.0.len() == other.0.len() && self.0.iter().all(|one| other.0.contains(one))
    }
}

impl Record for Tally {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, event: &Event, _: &[f64]) {
        if !tells(event) {
            return;
        }
        let known =
            self.0.iter_mut().find(|(source, kind, _)| (*source, *kind) == (event.source, event.kind));
        match known {
            Some((.., count)) => *count += 1,
            None => self.0.push((event.source, event.kind, 1)),
        }
    }
    fn wants_event_rows(&self) -> bool {
        false
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
                tally.event(&Event { t: k as f64, source: Source::Contact(0), kind: *kind }, &[]);
            }
            tally
        };
        use EventKind::{LiftOff, LoopClosed, Touch};
        let once = tally(&[Touch, LiftOff]);
        assert!(once.is_like(&tally(&[LiftOff, LoopClosed, Touch])));
        assert!(!once.is_like(&tally(&[Touch, LiftOff, Touch])) && !once.is_like(&tally(&[Touch])));
    }
}
