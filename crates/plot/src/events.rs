//! Events over time.

use crate::figure::Figure;
use crate::panel::{Axis, Lane, Mark, Panel, is_drawable};
use crate::{Ink, Label};

/// The events of one kind from one source.
#[derive(Debug, Clone, PartialEq)]
pub struct EventTrack<'a> {
    /// Name of the source, such as a contact.
    pub source: &'a str,
    /// What happened.
    pub kind: &'a str,
    /// Moments, s, in any order.
    pub times: Vec<f64>,
}

/// Moments closer than this share of the span are drawn as one mark.
const BIN: f64 = 1.0 / 400.0;
/// Height of a mark that stands for a single event where others stand for many.
const SINGLE: f64 = 0.3;

/// One lane per track, in their order, over a span of time (s); right of it the number of its events. Where events
/// lie closer than their marks, a mark is the taller the more it stands for.
pub fn events_figure<'a>(title: &str, span: (f64, f64), tracks: &[EventTrack<'a>]) -> Figure<'a> {
    let mut sources: Vec<&str> = tracks.iter().map(|track| track.source).collect();
    sources.dedup();
    let lane = |track: &EventTrack<'a>| Lane {
        label: format!("{}: {}", track.source, track.kind),
        note: track.times.len().to_string(),
        marks: marks(&track.times, span),
        ink: Ink::Palette(sources.iter().position(|source| *source == track.source).unwrap_or(0)),
    };
    let panel = Panel {
        x: Axis { tight: true, covers: Some(span), ..Axis::new(Label::plain("time t"), "s") },
        lanes: tracks.iter().map(lane).collect(),
        absence: Label::plain("no events"),
        ..Panel::default()
    };
    Figure {
        title: Label::plain(title),
        size: (Figure::DEFAULT_SIZE.0, (240 + 70 * tracks.len() as u32).clamp(500, Figure::MOST)),
        panels: vec![panel],
        ..Figure::default()
    }
}

/// Marks of moments inside a span, one for all that share a bin.
fn marks(times: &[f64], (from, to): (f64, f64)) -> Vec<Mark> {
    let mut times: Vec<f64> =
        times.iter().copied().filter(|t| is_drawable(*t) && (from..=to).contains(t)).collect();
    times.sort_by(f64::total_cmp);
    let width = BIN * (to - from);
    let bin = |t: f64| ((t - from) / width).floor();
    let bins: Vec<&[f64]> = times.chunk_by(|a, b| bin(*a) == bin(*b)).collect();
    let most = bins.iter().map(|bin| bin.len()).max().unwrap_or(1);
    let mark = |bin: &&[f64]| {
        let share = (bin.len() - 1) as f64 / (most.max(2) - 1) as f64;
        let height = if most == 1 { 1.0 } else { SINGLE + (1.0 - SINGLE) * share };
        Mark { from: bin[0], to: bin[bin.len() - 1], height }
    };
    bins.iter().map(mark).collect()
}
