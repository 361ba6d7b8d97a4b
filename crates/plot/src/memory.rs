//! The slip memory of a contact: reversal displacements over depth, in the wedge of full slip.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// The memory curve of a contact at one time: the displacement p(h) at which the springs of each depth are unstretched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemoryMoment<'a> {
    /// Name of the contact.
    pub contact: &'a str,
    /// Time with its unit.
    pub time: &'a str,
    /// Indentation depth, m: the apex lies at h = d.
    pub d: f64,
    /// Tangential displacement, m: the apex lies at p = u.
    pub u: f64,
    /// Slope κ = μE\*/G\* of the wedge |p - u| ≤ κ(d - h).
    pub slope: f64,
    /// Depths of the corners of the curve, m, from 0 to d.
    pub h: &'a [f64],
    /// Displacements p(h), m, one per depth.
    pub p: &'a [f64],
}

/// Draws one panel per time: p - u over h, inside the wedge of full slip |p - u| ≤ κ(d - h). All panels have the same axes.
pub fn memory_figure<'a>(title: &str, moments: &[MemoryMoment<'a>]) -> Figure<'a> {
    let first = moments.first().map(|moment| moment.contact);
    let is_named = moments.iter().any(|moment| Some(moment.contact) != first);
    if moments.is_empty() {
        return Figure::without_data(
            title,
            "no memory recorded: the run did not reach any of the requested times",
        );
    }
    let panels: Vec<Panel<'a>> = moments.iter().map(|moment| panel(moment, is_named)).collect();
    let columns = columns(panels.len());
    let rows = panels.len().div_ceil(columns);
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(240, if rows == 1 { 760 } else { 420 }, rows),
        panels,
        arrangement: Arrangement::Grid { columns, share: true },
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

fn panel<'a>(moment: &MemoryMoment<'a>, is_named: bool) -> Panel<'a> {
    let MemoryMoment { d, u, slope, .. } = *moment;
    let time = format!("t = {}", moment.time);
    let wedge = Band {
        label: Label::markup("|p − u| ≤ κ(d − h)"),
        xs: vec![0.0, d].into(),
        low: vec![-slope * d, 0.0].into(),
        high: vec![slope * d, 0.0].into(),
        ink: Ink::Shade(1),
    };
    let style = |ink, width| Style { ink: Some(ink), dash: Some(Dash::Solid), width };
    let from_apex: Vec<f64> = moment.p.iter().map(|p| p - u).collect();
    let curve =
        Series { style: style(Ink::Palette(0), 1.2), ..Series::new("memory p(h)", moment.h, from_apex) };
    let apex =
        Series { style: style(Ink::Palette(1), 1.6), ..Series::new("indentation d", vec![d], vec![0.0]) };
    Panel {
        heading: Label::plain(&if is_named { format!("{}, {time}", moment.contact) } else { time }),
        x: Axis::new(Label::plain("depth h"), "m"),
        y: Axis::new(Label::plain("p − u"), "m"),
        bands: if d > 0.0 { vec![wedge] } else { Vec::new() },
        series: vec![curve, apex],
        ..Panel::default()
    }
}
