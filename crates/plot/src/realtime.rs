//! Real-time measurements: histograms of execution times, and time histories.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style, Theme};
use std::cmp::Ordering;

/// Histogram of times.
#[derive(Debug, Clone, PartialEq)]
pub struct TimesCurve<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Whether the curve serves only for comparison and is drawn muted.
    pub is_beside: bool,
    /// Bins as lower edge (s), upper edge (s) and count, ascending and adjacent.
    pub bins: Vec<(f64, f64, u64)>,
}

/// Marked frames of one kind, such as the slowest.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkedTimes<'a> {
    /// Kind of frames, the name in the legend.
    pub name: &'a str,
    /// Time of each frame, s.
    pub times: Vec<f64>,
    /// Index of the histogram to which the marked frames belong.
    pub on: usize,
}

/// Panel of histograms.
#[derive(Debug, Clone, PartialEq)]
pub struct TimesPanel<'a> {
    /// Heading above the panel; empty for none.
    pub heading: String,
    /// Quantity on the time axis, such as "execution time".
    pub what: &'a str,
    /// Histograms, one per loop.
    pub curves: Vec<TimesCurve<'a>>,
    /// Marked frames.
    pub marked: Vec<MarkedTimes<'a>>,
}

/// Panel of series over simulated time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimelinePanel<'a> {
    /// Name of the quantity.
    pub label: &'a str,
    /// Unit of the quantity.
    pub unit: &'a str,
    /// Whether the value axis is logarithmic.
    pub logarithmic: bool,
    /// Names and values of the series, one value per time.
    pub series: Vec<(&'a str, &'a [f64])>,
}

/// Ordinate of empty bins on the logarithmic axis.
const NONE: f64 = 0.5;

/// Draws histograms side by side on logarithmic axes, with the frame period as a vertical line.
pub fn times_figure<'a>(title: &str, period: f64, panels: &[TimesPanel<'a>]) -> Figure<'a> {
    let panel = |times: &TimesPanel<'a>| {
        let curves = times.curves.iter().enumerate().map(|(place, curve)| steps(curve, place));
        let marked = times
            .marked
            .iter()
            .enumerate()
            .map(|(place, marked)| points(marked, mark(place + 1), &times.curves));
        Panel {
            x: Axis { logarithmic: true, ..Axis::new(Label::plain(times.what), "s") },
            y: Axis { logarithmic: true, ..Axis::new(Label::plain("frames in a tenth of a decade"), "") },
            references: vec![Reference::Vertical { x: period, label: Label::plain("period") }],
            series: curves.chain(marked).collect(),
            ..Panel::default()
        }
    };
    Figure {
        title: Label::plain(title),
        panels: panels.iter().map(panel).collect(),
        arrangement: Arrangement::Row,
        size: (Figure::DEFAULT_SIZE.0, 900),
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// Draws histograms in a grid on logarithmic axes. The panels of a column have the same time range. Marks of one name
/// have the same colour and one legend entry.
pub fn times_grid<'a>(title: &str, columns: usize, panels: &[TimesPanel<'a>]) -> Figure<'a> {
    if panels.is_empty() {
        return Figure::without_data(title, "no frames");
    }
    let columns = columns.max(1);
    let mut kinds: Vec<&str> = Vec::new();
    for name in panels.iter().flat_map(|panel| &panel.marked).map(|marked| marked.name) {
        if !kinds.contains(&name) {
            kinds.push(name);
        }
    }
    // The loop for comparison has no palette colour.
    let curves = panels.iter().map(|panel| panel.curves.iter().filter(|curve| !curve.is_beside).count());
    let most = curves.max().unwrap_or(0);
    let panel = |(place, times): (usize, &TimesPanel<'a>)| {
        let column = panels.iter().skip(place % columns).step_by(columns);
        let counts = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.bins);
        let highest = counts.map(|(.., count)| *count).max().unwrap_or(1).max(1) as f64;
        let colour = |name: &str| mark(most + kinds.iter().position(|kind| *kind == name).unwrap_or(0));
        let marked = times.marked.iter().map(|marked| points(marked, colour(marked.name), &times.curves));
        // The first panel names all kinds, so that one legend serves all panels. Values not above 0 are not drawn on logarithmic axes.
        let named = if place == 0 { &kinds[..] } else { &[] };
        let keys = named.iter().map(|name| {
            let key = points(&MarkedTimes { name, times: Vec::new(), on: 0 }, colour(name), &[]);
            Series { xs: vec![-1.0].into(), ys: vec![-1.0].into(), ..key }
        });
        let marked: Vec<Series<'a>> = marked.chain(keys).collect();
        Panel {
            heading: Label::plain(&times.heading),
            x: Axis {
                logarithmic: true,
                covers: covered(column),
                ..Axis::new(Label::plain(times.what), "s")
            },
            y: Axis {
                logarithmic: true,
                covers: Some((NONE, highest)),
                ..Axis::new(Label::plain("frames"), "")
            },
            series: times.curves.iter().enumerate().map(|(k, curve)| steps(curve, k)).chain(marked).collect(),
            ..Panel::default()
        }
    };
    Figure {
        title: Label::plain(title),
        panels: panels.iter().enumerate().map(panel).collect(),
        arrangement: Arrangement::Grid { columns, share: false },
        size: Figure::size_for(220, 420, panels.len().div_ceil(columns)),
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// Returns the range of the times with counts in some panels.
fn covered<'a, 'b: 'a>(panels: impl Iterator<Item = &'a TimesPanel<'b>>) -> Option<(f64, f64)> {
    let bins = panels.flat_map(|panel| &panel.curves).flat_map(|curve| &curve.bins);
    let counted = bins.filter(|(.., count)| *count > 0);
    let ends = counted.map(|(low, high, _)| (*low, *high));
    ends.reduce(|(a, b), (low, high)| (a.min(low), b.max(high)))
}

/// Returns the outline of a histogram.
fn steps<'a>(curve: &TimesCurve<'a>, place: usize) -> Series<'a> {
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    let height = |count: u64| if count == 0 { NONE } else { count as f64 };
    let shown = |(_, _, count): &(f64, f64, u64)| *count > 0;
    let first = curve.bins.iter().position(shown).unwrap_or(0);
    let last = curve.bins.iter().rposition(shown).map_or(0, |last| last + 1);
    if let Some((low, ..)) = curve.bins.get(first) {
        xs.push(*low);
        ys.push(NONE);
    }
    for (low, high, count) in curve.bins.get(first..last).unwrap_or_default() {
        xs.extend([*low, *high]);
        ys.extend([height(*count); 2]);
    }
    if let Some((_, high, _)) = last.checked_sub(1).and_then(|last| curve.bins.get(last)) {
        xs.push(*high);
        ys.push(NONE);
    }
    let ink = if curve.is_beside { Ink::Muted } else { Ink::Palette(place) };
    let style = Style { ink: Some(ink), dash: Some(Dash::Solid), width: 1.0 };
    Series { style, ..Series::new(curve.name, xs, ys) }
}

/// Returns the colour of marks at an index after the histograms. Beyond the palette, no colour of a histogram is used again.
fn mark(place: usize) -> Ink {
    match place.cmp(&Theme::light().palette.len()) {
        Ordering::Less => Ink::Palette(place),
        Ordering::Equal => Ink::Foreground,
        Ordering::Greater => Ink::Pale(place),
    }
}

/// Returns the marks on the outline of their histogram.
fn points<'a>(marked: &MarkedTimes<'a>, colour: Ink, curves: &[TimesCurve<'a>]) -> Series<'a> {
    let height = |time: f64| {
        let bins = curves.get(marked.on).map(|curve| &curve.bins[..]).unwrap_or_default();
        let bin = bins.iter().find(|(low, high, _)| (*low..*high).contains(&time));
        bin.map_or(1.0, |(_, _, count)| (*count).max(1) as f64)
    };
    // Gaps prevent connecting lines.
    let xs: Vec<f64> = marked.times.iter().flat_map(|time| [*time, f64::NAN]).collect();
    let ys: Vec<f64> = marked.times.iter().flat_map(|time| [height(*time), f64::NAN]).collect();
    let style = Style { ink: Some(colour), dash: Some(Dash::Solid), width: 2.0 };
    Series { style, marked: true, ..Series::new(marked.name, xs, ys) }
}

/// Draws series over a common time axis in s, one panel below the other.
pub fn timeline_figure<'a>(title: &str, time: &'a [f64], panels: &[TimelinePanel<'a>]) -> Figure<'a> {
    if time.is_empty() || panels.is_empty() {
        return Figure::without_data(title, "no frames");
    }
    let panel = |line: &TimelinePanel<'a>| Panel {
        x: Axis { tight: true, ..Axis::new(Label::plain("simulated time t"), "s") },
        y: Axis { logarithmic: line.logarithmic, ..Axis::new(Label::plain(line.label), line.unit) },
        series: line.series.iter().map(|(name, values)| Series::new(*name, time, *values)).collect(),
        ..Panel::default()
    };
    Figure {
        title: Label::plain(title),
        panels: panels.iter().map(panel).collect(),
        arrangement: Arrangement::Column { share_x: true },
        size: Figure::size_for(240, 330, panels.len()),
        ..Figure::default()
    }
    .with_room_for_legends()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_stands_on_the_axis_and_has_no_gap() {
        let bins = vec![(1e-7, 1e-6, 0), (1e-6, 2e-6, 5), (2e-6, 3e-6, 0), (3e-6, 4e-6, 1), (4e-6, 5e-6, 0)];
        let curve = TimesCurve { name: "loop", is_beside: false, bins };
        let series = steps(&curve, 0);
        assert_eq!(series.xs[..], [1e-6, 1e-6, 2e-6, 2e-6, 3e-6, 3e-6, 4e-6, 4e-6]);
        assert_eq!(series.ys[..], [0.5, 5.0, 5.0, 0.5, 0.5, 1.0, 1.0, 0.5]);
        let marked = MarkedTimes { name: "events", times: vec![1.5e-6, 9.0], on: 0 };
        let marks = points(&marked, mark(1), &[curve]);
        assert_eq!((marks.ys[0], marks.ys[2], marks.is_scattered()), (5.0, 1.0, true));
    }

    #[test]
    fn marks_of_a_grid_lie_on_their_own_curve_and_have_one_colour_everywhere() {
        let curve = |count| TimesCurve { name: "loop", is_beside: false, bins: vec![(1e-6, 2e-6, count)] };
        let panel = |name, on| TimesPanel {
            heading: "scene".to_owned(),
            what: "execution time",
            curves: vec![curve(5), curve(70)],
            marked: vec![MarkedTimes { name, times: vec![1.5e-6], on }],
        };
        let figure = times_grid("", 2, &[panel("event", 0), panel("merge", 1), panel("merge", 0)]);
        let mark = |place: usize| &figure.panels[place].series[2];
        assert_eq!([0, 1, 2].map(|place| mark(place).ys[0]), [5.0, 70.0, 5.0]);
        assert_eq!((mark(0).style.ink, mark(1).style.ink), (Some(Ink::Palette(2)), Some(Ink::Palette(3))));
        assert_eq!(mark(1).style, mark(2).style);
        // Two curves, a mark, and names of both kinds.
        assert_eq!((figure.panels[0].series.len(), figure.panels[1].series.len()), (5, 3));
        assert!(crate::draw_png(&figure).is_ok());
    }

    #[test]
    fn no_mark_has_the_colour_of_a_curve_or_of_another_mark() {
        let curve = || TimesCurve { name: "loop", is_beside: false, bins: vec![(1e-6, 2e-6, 5)] };
        let names = ["latest", "plain", "corner", "growth", "event", "merge"];
        let marked = names.map(|name| MarkedTimes { name, times: vec![1.5e-6], on: 0 }).to_vec();
        let panel = TimesPanel { heading: String::new(), what: "", curves: vec![curve(), curve()], marked };
        let figure = times_grid("", 1, &[panel]);
        let theme = Theme::light();
        // Two curves, six marks, and their legend entries.
        let inks = figure.panels[0].series[..8].iter().map(|series| theme.colour(series.style.ink.unwrap()));
        let inks: Vec<_> = inks.collect();
        assert!(inks.iter().enumerate().all(|(place, ink)| !inks[..place].contains(ink)), "{inks:?}");
    }

    #[test]
    fn nothing_is_drawn_of_nothing() {
        let empty = TimesCurve { name: "", is_beside: true, bins: Vec::new() };
        assert!(steps(&empty, 0).xs.is_empty());
        assert!(!timeline_figure("", &[], &[]).panels.is_empty());
    }
}
