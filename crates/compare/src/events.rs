//! Lists of events: which are missing, extra or moved.

use super::alignment::Alignment;
use super::allowance::Allowance;
use super::results::{EventRow, Results};
use serde::Serialize;
use std::collections::HashMap;
use stickslip_run::Real;

/// How the lists of events differ. Events are told apart by source and kind; those of one source and kind keep their
/// order.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct EventDifferences {
    /// Numbers of events compared.
    pub a: usize,
    /// In B.
    pub b: usize,
    /// Largest distance in time of those that agree.
    #[serde(rename = "worst_s")]
    pub worst: Real,
    /// Distance in time that is allowed, s.
    #[serde(rename = "allowed_s")]
    pub allowed: Real,
    /// In A only, in order of time.
    pub missing: Vec<Lone>,
    /// In B only.
    pub extra: Vec<Lone>,
    /// In both, but farther apart than allowed.
    pub moved: Vec<Moved>,
}

/// An event of one list.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lone {
    /// Name of a contact or waveform.
    pub source: String,
    /// What happened.
    pub kind: String,
    /// When, s.
    #[serde(rename = "time_s")]
    pub time: Real,
}

/// An event at different times.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moved {
    /// The event in A.
    #[serde(flatten)]
    pub event: Lone,
    /// From A to B.
    #[serde(rename = "by_s")]
    pub by: Real,
}

/// Times of the events of one source and kind in both lists.
struct Track<'a> {
    source: &'a str,
    kind: &'a str,
    a: Vec<f64>,
    b: Vec<f64>,
}

/// Compares the events until `end`, s.
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

/// The tracks in order of appearance. Where one run ends before the other, an event at its very end may not have been
/// written any more: those are left out.
fn tracks<'a>(
    (a, b): (&'a Results, &'a Results),
    ([from, to], end): ([f64; 2], f64),
    allowance: &Allowance,
) -> Vec<Track<'a>> {
    let last = if a.end == b.end { f64::INFINITY } else { end - allowance.time };
    // Of thinned events one more or less moves all that follow.
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

    /// Whether both lists agree.
    pub fn is_same(&self) -> bool {
        self.missing.is_empty() && self.extra.is_empty() && self.moved.is_empty()
    }

    /// The first event that differs, with how.
    pub fn first(&self) -> Option<(&Lone, &'static str)> {
        let missing = self.missing.first().map(|event| (event, "is missing"));
        let extra = self.extra.first().map(|event| (event, "is extra"));
        let moved = self.moved.first().map(|moved| (&moved.event, "has moved"));
        let all = [missing, extra, moved].into_iter().flatten();
        all.min_by(|(p, _), (q, _)| p.time.0.total_cmp(&q.time.0))
    }
}
