//! The memory of a contact: the curve p(h) and its wedge.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Series, is_drawable};
use crate::theme::{Dash, Ink, Style};

/// The memory curve of a contact at a moment: at which displacement the springs of every height are anchored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemoryMoment<'a> {
    /// Name of the contact.
    pub contact: &'a str,
    /// Time, as it is told.
    pub time: &'a str,
    /// Indentation depth, m: the apex lies at h = d.
    pub d: f64,
    /// Tangential displacement, m: the apex lies at p = u.
    pub u: f64,
    /// Slope κ = μE\*/G\* of the wedge |p - u| ≤ κ(d - h).
    pub slope: f64,
    /// Heights of the curve's corners, m, from 0 to d.
    pub h: &'a [f64],
    /// Anchors p(h), m, as many.
    pub p: &'a [f64],
}

/// Panels share their axes where their union is no more than this many times the largest of them.
const NEAR: f64 = 2.0;

/// One panel per moment: p upwards over h, inside the wedge that the apex (d, u) opens to the left. All panels have
/// the same scales; where the moments lie too far apart in p for one axis, every panel has its own part of it.
pub fn memory_figure<'a>(title: &str, moments: &[MemoryMoment<'a>]) -> Figure<'a> {
    let first = moments.first().map(|moment| moment.contact);
    let is_named = moments.iter().any(|moment| Some(moment.contact) != first);
    if moments.is_empty() {
        return Figure::without_data(
            title,
            "no memory recorded: the run did not come to any of the moments that were asked for",
        );
    }
    let mut panels: Vec<Panel<'a>> = moments.iter().map(|moment| panel(moment, is_named)).collect();
    let ranges: Vec<(f64, f64)> = moments.iter().map(reach).collect();
    let (low, high) =
        ranges.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |all, r| (all.0.min(r.0), all.1.max(r.1)));
    let span = ranges.iter().map(|(low, high)| high - low).fold(0.0, f64::max);
    let share = high - low <= NEAR * span;
    let deepest = moments.iter().map(|moment| moment.d).fold(0.0, f64::max);
    for (panel, (low, high)) in panels.iter_mut().zip(ranges) {
        let middle = low / 2.0 + high / 2.0;
        panel.x.covers = Some((0.0, deepest));
        panel.y.covers = Some((middle - span / 2.0, middle + span / 2.0)).filter(|_| !share);
    }
    let columns = columns(panels.len());
    let rows = panels.len().div_ceil(columns);
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(240, if rows == 1 { 760 } else { 420 }, rows),
        panels,
        arrangement: Arrangement::Grid { columns, share },
        ..Figure::default()
    }
}

fn columns(panels: usize) -> usize {
    match panels {
        1 => 1,
        2 | 4 => 2,
        _ => 3,
    }
}

/// Lowest and highest p of curve and wedge.
fn reach(moment: &MemoryMoment<'_>) -> (f64, f64) {
    let wedge = moment.slope * moment.d.max(0.0);
    let ends = [moment.u - wedge, moment.u + wedge].into_iter();
    let values = ends.chain(moment.p.iter().copied()).filter(|p| is_drawable(*p));
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

fn panel<'a>(moment: &MemoryMoment<'a>, is_named: bool) -> Panel<'a> {
    let MemoryMoment { d, u, slope, .. } = *moment;
    let time = format!("t = {}", moment.time);
    let wedge = Band {
        label: Label::markup("wedge |p − u| ≤ κ(d − h)"),
        xs: vec![0.0, d].into(),
        low: vec![u - slope * d, u].into(),
        high: vec![u + slope * d, u].into(),
        ink: Ink::Shade(1),
    };
    let style = |ink, width| Style { ink: Some(ink), dash: Some(Dash::Solid), width };
    let curve =
        Series { style: style(Ink::Palette(0), 1.2), ..Series::new("memory p(h)", moment.h, moment.p) };
    let apex = Series { style: style(Ink::Palette(1), 1.6), ..Series::new("apex (d, u)", vec![d], vec![u]) };
    Panel {
        heading: Label::plain(&if is_named { format!("{}, {time}", moment.contact) } else { time }),
        x: Axis::new(Label::plain("height h"), "m"),
        y: Axis::new(Label::plain("anchor p"), "m"),
        bands: if d > 0.0 { vec![wedge] } else { Vec::new() },
        series: vec![curve, apex],
        ..Panel::default()
    }
}
