//! Event times of contacts and waveforms.

use crate::figure::Figure;
use crate::panel::{Axis, Lane, Mark, Panel};
use crate::scale::quantity;
use crate::{Ink, Label};

/// Events of one kind from one source.
#[derive(Debug, Clone, PartialEq)]
pub struct EventTrack<'a> {
    /// Name of the source, such as a contact.
    pub source: &'a str,
    /// Kind of event.
    pub kind: &'a str,
    /// Times, s, in any order.
    pub times: Vec<f64>,
}

/// Number of bins in which events are counted.
const BINS: usize = 400;
/// Maximum number of events in a bin for marks; if a bin has more events, the lane shows their rate.
const MOST_MARKS: usize = 4;
/// Minimum height of a bin with events, as a fraction of the fullest bin.
const LEAST: f64 = 0.12;

/// Draws one lane per track over a time range in s, with the number of events on its right. If events are too dense to be distinguished,
/// the lane shows their rate. The full height of such a lane is the rate given next to the number of events.
pub fn events_figure<'a>(title: &str, span: (f64, f64), tracks: &[EventTrack<'a>]) -> Figure<'a> {
    let mut sources: Vec<&str> = tracks.iter().map(|track| track.source).collect();
    sources.dedup();
    let lane = |track: &EventTrack<'a>| {
        let ink = Ink::Palette(sources.iter().position(|source| *source == track.source).unwrap_or(0));
        lane(track, span, ink)
    };
    if tracks.is_empty() {
        return Figure::without_data(title, "no events");
    }
    let panel = Panel {
        x: Axis { tight: true, covers: Some(span), ..Axis::new(Label::plain("time t"), "s") },
        lanes: tracks.iter().map(lane).collect(),
        ..Panel::default()
    };
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(200, 75, tracks.len().max(3)),
        panels: vec![panel],
        ..Figure::default()
    }
}

fn lane(track: &EventTrack<'_>, (from, to): (f64, f64), ink: Ink) -> Lane {
    let label = format!("{}: {}", track.source, track.kind);
    let mut times: Vec<f64> = track.times.iter().copied().filter(|t| (from..=to).contains(t)).collect();
    times.sort_by(f64::total_cmp);
    let width = (to - from) / BINS as f64;
    let is_sparse = counts(&times, from, width).iter().all(|count| *count <= MOST_MARKS);
    if is_sparse || width <= 0.0 {
        // A count of 0 would suggest that the event never happens.
        let is_later = times.is_empty() && track.times.iter().any(|t| *t > to);
        let note = if is_later { "later".to_owned() } else { grouped(times.len()) };
        times.dedup();
        let marks = times.iter().map(|&t| Mark { from: t, to: t, height: 1.0 }).collect();
        return Lane { label, note, marks, ink };
    }
    let density = density(&times, from, width);
    let most = density.iter().copied().fold(0.0, f64::max);
    let edge = |bin: usize| from + bin as f64 * width;
    let mark =
        |(bin, share): (usize, f64)| Mark { from: edge(bin), to: edge(bin + 1), height: share.max(LEAST) };
    let marks = density.iter().map(|density| density / most).enumerate().filter(|(_, share)| *share > 0.0);
    let note = format!("{}, ≤ {}", grouped(times.len()), quantity(most / width, "Hz", 2));
    Lane { label, note, marks: marks.map(mark).collect(), ink }
}

/// Returns the number of events in each bin.
fn counts(times: &[f64], from: f64, width: f64) -> [usize; BINS] {
    let mut counts = [0; BINS];
    times.iter().for_each(|t| counts[(((t - from) / width) as usize).min(BINS - 1)] += 1);
    counts
}

/// Returns the number of events in each bin. Each event is distributed over the two nearest bins to avoid aliasing of regular events.
fn density(times: &[f64], from: f64, width: f64) -> [f64; BINS] {
    let mut density = [0.0; BINS];
    for t in times {
        let at = ((t - from) / width - 0.5).clamp(0.0, (BINS - 1) as f64);
        let bin = at as usize;
        density[bin] += 1.0 - at.fract();
        density[(bin + 1).min(BINS - 1)] += at.fract();
    }
    density
}

/// Formats a number with thin spaces between thousands.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let group = |(i, digit): (usize, char)| {
        let is_start = i > 0 && (digits.len() - i).is_multiple_of(3) && digits.len() > 4;
        is_start.then_some('\u{2009}').into_iter().chain([digit])
    };
    digits.chars().enumerate().flat_map(group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_happens_after_the_span_only_is_not_told_as_nothing() {
        let note = |times: &[f64]| {
            let track = EventTrack { source: "ball", kind: "gross slip", times: times.to_vec() };
            lane(&track, (0.0, 1.0), Ink::Palette(0)).note
        };
        assert_eq!([note(&[1.5, 2.0]), note(&[0.5, 2.0]), note(&[])], ["later", "1", "0"]);
    }

    #[test]
    fn a_regular_train_has_no_bursts() {
        // At 19.2 events per bin, counting whole events would give 19 or 20.
        let times: Vec<f64> = (0..7680).map(|i| (f64::from(i) + 0.5) / 7680.0).collect();
        let density = density(&times, 0.0, 1.0 / BINS as f64);
        assert!(density.iter().all(|count| (count - 19.2).abs() < 0.1), "{density:?}");
        assert!((density.iter().sum::<f64>() - 7680.0).abs() < 1e-9);
    }

    #[test]
    fn every_event_is_seen_alone_or_in_a_density() {
        let lane_of = |times: Vec<f64>| {
            lane(&EventTrack { source: "ball", kind: "touch", times }, (0.0, 2.0), Ink::Palette(0))
        };
        let sparse = lane_of(vec![1.5, 0.25, f64::NAN, 7.0, 0.0, 2.0]);
        assert_eq!(sparse.marks.iter().map(|mark| mark.from).collect::<Vec<_>>(), [0.0, 0.25, 1.5, 2.0]);
        assert_eq!((sparse.note.as_str(), sparse.label.as_str()), ("4", "ball: touch"));
        // A hundred thousand events in one bin and a single one, which must stay visible.
        let mut times = vec![0.5; 100_000];
        times.push(1.7);
        let dense = lane_of(times);
        assert!(dense.marks.len() <= 4 && dense.note.starts_with("100\u{2009}001, ≤ "), "{dense:?}");
        let alone = dense.marks.iter().find(|mark| mark.from <= 1.7 && mark.to >= 1.7).unwrap();
        assert!(alone.height >= LEAST);
        // All events at the same time: the range has no width.
        let still = EventTrack { source: "", kind: "", times: vec![1.0; 9] };
        assert_eq!(lane(&still, (1.0, 1.0), Ink::Foreground).marks.len(), 1);
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(
            [0, 999, 1234, 56_789, 1_234_567].map(grouped),
            ["0", "999", "1234", "56 789", "1 234 567"].map(|text| text.replace(' ', "\u{2009}"))
        );
    }
}
