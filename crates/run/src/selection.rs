//! Selection of the rows and events that are written, and rounding of their values.
//!
//! Tables, plots and fingerprints contain only the selected data, so plots drawn again from the tables are identical. Evaluations use all
//! data.

use std::fmt::Write;
use stickslip_drive::{Channel, Source};
use stickslip_scenario::{Written, WrittenEvents};

/// Number of blocks into which the first `most` events are divided. Thinning keeps or drops whole blocks of this length.
const BLOCKS: u64 = 100;

/// Selection of the written rows and events of a run, and event counts so far.
pub(crate) struct Selection {
    written: Written,
    /// Number of selected events: within the time window, and of the selected kinds and contacts.
    asked: u64,
    /// Number of selected events that were written.
    taken: u64,
    /// Number of all events.
    seen: u64,
    /// Last event time before that of the first dropped event, s. All selected events up to this time are written.
    whole_until: Option<f64>,
    /// Time of the last selected event, and the previous different event time, s.
    last: f64,
    before: f64,
    /// Whether each channel is rounded.
    is_rounded: Vec<bool>,
    /// Buffers for a rounded row and for a number as text.
    row: Vec<f64>,
    text: String,
}

/// Numbers of events of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TakenEvents {
    /// Number of all events.
    pub seen: u64,
    /// Number of written events.
    pub taken: u64,
    /// If events were thinned: time up to which the selected events are complete, s.
    pub whole_until: Option<f64>,
}

impl Selection {
    /// Creates a selection.
    pub(crate) fn new(written: Written, channels: &[Channel]) -> Self {
        // The time is not rounded, because rounded times could coincide.
        let is_rounded = channels.iter().enumerate().map(|(place, channel)| place > 0 && !channel.is_state);
        Self {
            written,
            asked: 0,
            taken: 0,
            seen: 0,
            whole_until: None,
            last: 0.0,
            before: 0.0,
            is_rounded: is_rounded.collect(),
            row: Vec::new(),
            text: String::new(),
        }
    }

    /// Returns the time window of the rows, s.
    pub(crate) fn window(&self) -> [f64; 2] {
        self.written.window
    }

    /// Returns whether states are written as numbers.
    pub(crate) fn has_state_numbers(&self) -> bool {
        self.written.state_numbers
    }

    /// Returns whether an event at time t, s, is written.
    ///
    /// The decision does not depend on later events. Therefore resumed and uninterrupted runs write the same events.
    pub(crate) fn takes(&mut self, source: Source, kind: &str, t: f64) -> bool {
        self.seen += 1;
        let ([from, to], events) = (self.written.window, &self.written.events);
        if !(from..=to).contains(&t) || !is_asked(events, source, kind) || events.most == 0 {
            return false;
        }
        let takes = is_taken(self.asked, events.most);
        self.asked += 1;
        self.taken += u64::from(takes);
        if t > self.last {
            (self.before, self.last) = (self.last, t);
        }
        if !takes {
            self.whole_until.get_or_insert(self.before);
        }
        takes
    }

    /// Returns the row with rounded values.
    pub(crate) fn rounded<'a>(&'a mut self, values: &'a [f64]) -> &'a [f64] {
        let Some(digits) = self.written.digits else { return values };
        let Self { is_rounded, row, text, .. } = self;
        row.clear();
        row.extend(
            values.iter().zip(is_rounded).map(
                |(value, is_rounded)| {
                    if *is_rounded { round(*value, digits, text) } else { *value }
                },
            ),
        );
        row
    }

    /// Returns the numbers of events so far.
    pub(crate) fn events(&self) -> TakenEvents {
        TakenEvents { seen: self.seen, taken: self.taken, whole_until: self.whole_until }
    }
}

fn is_asked(events: &WrittenEvents, source: Source, kind: &str) -> bool {
    let of_kind = events.kinds.as_ref().is_none_or(|kinds| kinds.contains(&kind));
    let of_contact = events.contacts.as_ref().is_none_or(|contacts| {
        let Source::Contact(place) = source else { return false };
        contacts.contains(&place)
    });
    of_kind && of_contact
}

/// Returns whether the selected event with this number, from 0, is written. All of the first `most` events are written.
///
/// Events with numbers from 2ᵏ `most` to 2ᵏ⁺¹ `most` form blocks of `most`/100 events; every 2ᵏ⁺¹-th block is written. Doubling the number
/// of events thus adds `most`/2 written events.
fn is_taken(number: u64, most: u64) -> bool {
    if number < most {
        return true;
    }
    let octave = (number / most).ilog2();
    let block = number / (most / BLOCKS).max(1);
    block.is_multiple_of(1 << (octave + 1).min(63))
}

/// Returns the approximate number of written events.
pub(crate) fn expected(events: f64, most: u64) -> f64 {
    let most = most as f64;
    // The logarithm would be infinite for 0.
    if most == 0.0 {
        0.0
    } else if events <= most {
        events
    } else {
        most * (1.0 + 0.5 * math::log2(events / most))
    }
}

/// Returns the value rounded to a number of significant digits.
fn round(value: f64, digits: usize, text: &mut String) -> f64 {
    text.clear();
    // Writing to a string cannot fail, and the text is a valid number.
    let _ = write!(text, "{value:.*e}", digits.saturating_sub(1));
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_events_without_end_ever_fewer_are_taken_and_always_some() {
        let most = 1000;
        let taken: Vec<u64> = (0..1_024_000).filter(|number| is_taken(*number, most)).collect();
        assert!(taken.iter().copied().take(1000).eq(0..1000));
        // Half as many more in each of ten octaves.
        assert_eq!(taken.len(), 1000 + 10 * 500);
        let between = |from: u64, to: u64| taken.iter().filter(|number| (from..to).contains(number)).count();
        assert_eq!([between(1000, 2000), between(2000, 4000), between(512_000, 1_024_000)], [500; 3]);
        // Neighbours are kept in groups of ten.
        assert!(taken.chunks(10).all(|block| block[9] == block[0] + 9 && block[0] % 10 == 0));
        assert!((0..100).all(|number| is_taken(number, u64::MAX)) && is_taken(u64::MAX - 1, u64::MAX));
    }

    /// Of three events at one time, the second one is thinned out.
    #[test]
    fn a_moment_that_was_torn_apart_is_not_whole() {
        let until = |times: &[f64]| {
            let events = WrittenEvents { kinds: None, contacts: None, most: 100 };
            let window = [0.0, f64::INFINITY];
            let written = Written {
                events,
                steps: true,
                window,
                goes_by_end: false,
                digits: None,
                state_numbers: false,
            };
            let mut selection = Selection::new(written, &[]);
            for t in times {
                selection.takes(Source::Contact(0), "touch", *t);
            }
            selection.events().whole_until
        };
        let mut times: Vec<f64> = (0..110).map(f64::from).collect();
        // The block of the hundredth event, which is one event, is written; the next one is not.
        assert_eq!(until(&times), Some(100.0));
        times[101] = 100.0;
        assert_eq!(until(&times), Some(99.0));
        assert_eq!(until(&times[..101]), None);
    }

    #[test]
    fn so_many_are_expected_as_are_taken() {
        for seen in [500, 1000, 2000, 32_000, 1_024_000] {
            let taken = (0..seen).filter(|number| is_taken(*number, 1000)).count();
            assert_eq!(expected(seen as f64, 1000), taken as f64, "{seen}");
        }
        assert_eq!([0.0, 1e6].map(|events| expected(events, 0)), [0.0; 2]);
    }

    #[test]
    fn numbers_are_rounded_to_the_nearest_with_so_many_digits() {
        let mut text = String::new();
        let mut round = |value, digits| round(value, digits, &mut text);
        assert_eq!([round(1.234_567e-9, 3), round(-9.996, 3), round(0.0, 5)], [1.23e-9, -10.0, 0.0]);
        assert!(round(f64::NAN, 3).is_nan() && round(f64::INFINITY, 3).is_infinite());
        assert_eq!(round(0.1 + 0.2, 16), 0.3);
    }
}
