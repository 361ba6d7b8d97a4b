//! The memory of a contact: the curve p(h) and its wedge.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// The memory curve of a contact at a moment: at which displacement the springs of every height are anchored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemoryMoment<'a> {
    /// Name of the contact.
    pub contact: &'a str,
    /// Time, s.
    pub time: f64,
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

/// One panel per moment: p upwards over h, inside the wedge that the apex (d, u) opens to the left.
pub fn memory_figure<'a>(title: &str, moments: &[MemoryMoment<'a>]) -> Figure<'a> {
    let first = moments.first().map(|moment| moment.contact);
    let is_named = moments.iter().any(|moment| Some(moment.contact) != first);
    let mut panels: Vec<Panel<'a>> = moments.iter().map(|moment| panel(moment, is_named)).collect();
    if panels.is_empty() {
        panels.push(Panel { absence: Label::plain("no memory recorded"), ..Panel::default() });
    }
    let columns = columns(panels.len());
    let rows = panels.len().div_ceil(columns);
    Figure {
        title: Label::plain(title),
        size: (Figure::DEFAULT_SIZE.0, (300 + 440 * rows as u32).clamp(1000, Figure::MOST)),
        panels,
        arrangement: Arrangement::Grid { columns, share: true },
        ..Figure::default()
    }
}

fn columns(panels: usize) -> usize {
    match panels {
        0 | 1 => 1,
        2 | 4 => 2,
        _ => 3,
    }
}

fn panel<'a>(moment: &MemoryMoment<'a>, is_named: bool) -> Panel<'a> {
    let MemoryMoment { d, u, slope, .. } = *moment;
    let time = format!("t = {} s", moment.time);
    let wedge = Band {
        label: Label::markup("|p − u| ≤ κ(d − h)"),
        xs: vec![0.0, d].into(),
        low: vec![u - slope * d, u].into(),
        high: vec![u + slope * d, u].into(),
        ink: Ink::Shade(1),
    };
    let style = |dash| Style { ink: Some(Ink::Palette(0)), dash: Some(dash), width: 1.0 };
    let curve = Series { style: style(Dash::Solid), ..Series::new("memory p(h)", moment.h, moment.p) };
    let apex = Style { ink: Some(Ink::Palette(1)), dash: None, width: 1.5 };
    let apex = Series { style: apex, ..Series::new("apex (d, u)", vec![d], vec![u]) };
    Panel {
        heading: Label::plain(&if is_named { format!("{}, {time}", moment.contact) } else { time }),
        x: Axis::new(Label::plain("height h"), "m"),
        y: Axis::new(Label::plain("anchor p"), "m"),
        bands: if d > 0.0 { vec![wedge] } else { Vec::new() },
        series: vec![curve, apex],
        ..Panel::default()
    }
}
