//! Comparison of two event lists: missing, extra and moved events.

use super::alignment::Alignment;
use super::allowance::Allowance;
use super::results::{EventRow, Results};
use serde::Serialize;
use std::collections::HashMap;
use stickslip_run::Real;

/// Differences of two event lists. Events with the same source and kind are compared in order of time.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct EventDifferences {
    /// Number of compared events of run A.
    pub a: usize,
    /// Number of compared events of run B.
    pub b: usize,
    /// Largest time difference of events that agree within the tolerance, s.
    #[serde(rename = "worst_s")]
    pub worst: Real,
    /// Allowed time difference, s.
    #[serde(rename = "allowed_s")]
    pub allowed: Real,
    /// Events that only run A has, in order of time.
    pub missing: Vec<Lone>,
    /// Events that only run B has, in order of time.
    pub extra: Vec<Lone>,
    /// Events in both lists whose times differ by more than allowed.
    pub moved: Vec<Moved>,
}

/// An event that only one list contains.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lone {
    /// Name of the contact or waveform.
    pub source: String,
    /// Kind of the event.
    pub kind: String,
    /// Time, s.
    #[serde(rename = "time_s")]
    pub time: Real,
}

/// An event that occurs at different times in A and B.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moved {
    /// The event in A.
    #[serde(flatten)]
    pub event: Lone,
    /// Time of the event in B minus its time in A, s.
    #[serde(rename = "by_s")]
    pub by: Real,
}

/// Times of the events of one source and kind in both lists, s.
struct Track<'a> {
    source: &'a str,
    kind: &'a str,
    a: Vec<f64>,
    b: Vec<f64>,
}

/// Compares the events up to the time `end`, s.
pub(super) fn compare(a: &Results, b: &Results, end: f64, allowance: &Allowance) -> EventDifferences {
    let mut differences = EventDifferences { allowed: Real(allowance.time), ..EventDifferences::default() };
    let Some(window) = a.asked.common(&b.asked, allowance.time) else { return differences };
    for track in tracks((a, b), (window, end), allowance) {
        differences.add(&track, allowance.time);
    }
    let by_time = |p: &Lone, q: &Lone| p.time.0.total_cmp(&q.time.0);
    differences.missing.sort_by(by_time);
    differences.extra.sort_by(by_time);
    differences.moved.sort_by(|p, q| by_time(&p.event, &q.event));
    differences
}

/// Groups the events by source and kind, in order of first occurrence.
///
/// If one run ends before the other, events at its end are omitted, because this run may not have written them.
fn tracks<'a>(
    (a, b): (&'a Results, &'a Results),
    ([from, to], end): ([f64; 2], f64),
    allowance: &Allowance,
) -> Vec<Track<'a>> {
    let last = if a.end == b.end { f64::INFINITY } else { end - allowance.time };
    // After thinning of events, a single different event would shift all later events.
    let whole = a.events_until.min(b.events_until);
    let last = if whole.is_finite() { last.min(whole - allowance.time) } else { last };
    let last = last.min(to);
    let mut tracks: Vec<Track<'a>> = Vec::new();
    let mut places: HashMap<(&'a str, &'a str), usize> = HashMap::new();
    let wanted =
        |event: &EventRow<'_>| (from..=last).contains(&event.time) && !allowance.ignores(event.source);
    let mut file = |event: EventRow<'a>, is_first: bool| {
        let place = *places.entry((event.source, event.kind)).or_insert_with(|| {
            tracks.push(Track { source: event.source, kind: event.kind, a: Vec::new(), b: Vec::new() });
            tracks.len() - 1
        });
        let track = &mut tracks[place];
        if is_first { &mut track.a } else { &mut track.b }.push(event.time);
    };
    a.events().filter(wanted).for_each(|event| file(event, true));
    b.events().filter(wanted).for_each(|event| file(event, false));
    tracks
}

impl EventDifferences {
    fn add(&mut self, track: &Track<'_>, tolerance: f64) {
        let event = |time: f64| Lone {
            source: track.source.to_owned(),
            kind: track.kind.to_owned(),
            time: Real(time),
        };
        let alignment = Alignment::new(&track.a, &track.b, tolerance);
        (self.a, self.b) = (self.a + track.a.len(), self.b + track.b.len());
        self.missing.extend(alignment.missing.iter().map(|&i| event(track.a[i])));
        self.extra.extend(alignment.extra.iter().map(|&j| event(track.b[j])));
        for (i, j) in alignment.pairs {
            let by = track.b[j] - track.a[i];
            if by.abs() <= tolerance {
                self.worst.0 = self.worst.0.max(by.abs());
            } else {
                self.moved.push(Moved { event: event(track.a[i]), by: Real(by) });
            }
        }
    }

    /// Returns whether both lists agree.
    pub fn is_same(&self) -> bool {
        self.missing.is_empty() && self.extra.is_empty() && self.moved.is_empty()
    }

    /// Returns the first event that differs, with a description of the difference.
    pub fn first(&self) -> Option<(&Lone, &'static str)> {
        let missing = self.missing.first().map(|event| (event, "is missing"));
        let extra = self.extra.first().map(|event| (event, "is extra"));
        let moved = self.moved.first().map(|moved| (&moved.event, "has moved"));
        let all = [missing, extra, moved].into_iter().flatten();
        all.min_by(|(p, _), (q, _)| p.time.0.total_cmp(&q.time.0))
    }
}
