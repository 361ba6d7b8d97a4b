//! How long the frames of a loop took, and what the loop did meanwhile.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// How often times occurred.
#[derive(Debug, Clone, PartialEq)]
pub struct TimesCurve<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Whether it is what the others are held against.
    pub is_beside: bool,
    /// Lower and upper edges of the bins, s, and counts; ascending, side by side.
    pub bins: Vec<(f64, f64, u64)>,
}

/// Frames that are marked, of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkedTimes<'a> {
    /// Name in the legend: what happened in them.
    pub name: &'a str,
    /// How long each took, s.
    pub times: Vec<f64>,
    /// Place of the curve that they belong to.
    pub on: usize,
}

/// A panel of times.
#[derive(Debug, Clone, PartialEq)]
pub struct TimesPanel<'a> {
    /// Heading above it; none where empty.
    pub heading: String,
    /// What took the time.
    pub what: &'a str,
    /// How often, one curve for each loop.
    pub curves: Vec<TimesCurve<'a>>,
    /// Those that stand out.
    pub marked: Vec<MarkedTimes<'a>>,
}

/// A panel of series over time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimelinePanel<'a> {
    /// What is shown.
    pub label: &'a str,
    /// Its unit.
    pub unit: &'a str,
    /// Whether values are laid off by their decades.
    pub logarithmic: bool,
    /// Names and values, as many as times.
    pub series: Vec<(&'a str, &'a [f64])>,
}

/// Where a bin without a count is drawn: below one, for zero has no place on such an axis.
const NONE: f64 = 0.5;

/// Histograms side by side, times and counts by their decades, with the period as a line.
pub fn times_figure<'a>(title: &str, period: f64, panels: &[TimesPanel<'a>]) -> Figure<'a> {
    let panel = |times: &TimesPanel<'a>| {
        let curves = times.curves.iter().enumerate().map(|(place, curve)| steps(curve, place));
        let marked =
            times.marked.iter().enumerate().map(|(place, marked)| points(marked, place + 1, &times.curves));
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

/// Histograms row by row, times and counts by their decades; all panels of a column cover the same times, and marks of one name
/// have one colour and one entry.
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
    // The loop beside the others has no colour of the palette.
    let curves = panels.iter().map(|panel| panel.curves.iter().filter(|curve| !curve.is_beside).count());
    let most = curves.max().unwrap_or(0);
    let panel = |(place, times): (usize, &TimesPanel<'a>)| {
        let column = panels.iter().skip(place % columns).step_by(columns);
        let counts = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.bins);
        let highest = counts.map(|(.., count)| *count).max().unwrap_or(1).max(1) as f64;
        let colour = |name: &str| most + kinds.iter().position(|kind| *kind == name).unwrap_or(0);
        let marked = times.marked.iter().map(|marked| points(marked, colour(marked.name), &times.curves));
        // The first panel names all kinds: one legend then serves all panels. What is not above 0 has no place on such axes.
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

/// The shortest and the longest time that occurred in any of some panels.
fn covered<'a, 'b: 'a>(panels: impl Iterator<Item = &'a TimesPanel<'b>>) -> Option<(f64, f64)> {
    let bins = panels.flat_map(|panel| &panel.curves).flat_map(|curve| &curve.bins);
    let counted = bins.filter(|(.., count)| *count > 0);
    let ends = counted.map(|(low, high, _)| (*low, *high));
    ends.reduce(|(a, b), (low, high)| (a.min(low), b.max(high)))
}

/// The outline of a histogram.
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

/// Colours of the palettes.
const COLOURS: usize = 6;

/// Marks on the outline that they belong to; equal ones lie on each other.
fn points<'a>(marked: &MarkedTimes<'a>, colour: usize, curves: &[TimesCurve<'a>]) -> Series<'a> {
    let height = |time: f64| {
        let bins = curves.get(marked.on).map(|curve| &curve.bins[..]).unwrap_or_default();
        let bin = bins.iter().find(|(low, high, _)| (*low..*high).contains(&time));
        bin.map_or(1.0, |(_, _, count)| (*count).max(1) as f64)
    };
    // A gap after each: points that no line joins.
    let xs: Vec<f64> = marked.times.iter().flat_map(|time| [*time, f64::NAN]).collect();
    let ys: Vec<f64> = marked.times.iter().flat_map(|time| [height(*time), f64::NAN]).collect();
    // Beyond the palette one would have the colour of a curve.
    let ink = if colour < COLOURS { Ink::Palette(colour) } else { Ink::Foreground };
    let style = Style { ink: Some(ink), dash: Some(Dash::Solid), width: 2.0 };
    Series { style, marked: true, ..Series::new(marked.name, xs, ys) }
}

/// Series over one time axis (s), one panel below the other.
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
        let marks = points(&marked, 1, &[curve]);
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
    fn nothing_is_drawn_of_nothing() {
        let empty = TimesCurve { name: "", is_beside: true, bins: Vec::new() };
        assert!(steps(&empty, 0).xs.is_empty());
        assert!(!timeline_figure("", &[], &[]).panels.is_empty());
    }
}
