//! Slip memory of a contact: reversal displacements over depth and over the position of the springs.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// Slip memory of a contact at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct AnchorMoment<'a> {
    /// Heading of the panels, such as the time.
    pub heading: &'a str,
    /// Indentation d and displacement u, m: the apex of the wedge.
    pub apex: (f64, f64),
    /// Slope κ = μE\*/G\* of the wedge |p - u| ≤ κ(d - h).
    pub slope: f64,
    /// Corners (h, p) of the memory curve, m, from the centre to the edge.
    pub corners: &'a [(f64, f64)],
    /// Positions x of the springs in contact, m, ascending.
    pub x: &'a [f64],
    /// Heights g(x) of the springs in contact, m.
    pub g: &'a [f64],
    /// Rest positions p = u - stretch of the springs in contact, m.
    pub p: &'a [f64],
}

/// Draws two panels per time, side by side: the memory curve p(h), and p over the position x of the springs. The
/// shaded wedge is the limit of full slip, |p - u| ≤ κ(d - h) or κ(d - g(x)). All times have the same scales.
pub fn anchors_figure<'a>(title: &str, moments: &[AnchorMoment<'a>]) -> Figure<'a> {
    if moments.iter().all(|moment| moment.corners.is_empty()) {
        return Figure::without_data(title, "open contact: no memory");
    }
    let ends = moments.iter().filter(|moment| moment.apex.0 > 0.0).flat_map(|moment| {
        let (d, u) = moment.apex;
        [u - moment.slope * d, u + moment.slope * d]
    });
    let anchors = moments.iter().flat_map(|moment| moment.corners.iter().map(|(_, p)| *p));
    let range = ends
        .chain(anchors)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let deepest = moments.iter().map(|moment| moment.apex.0).fold(0.0, f64::max);
    let widest = moments.iter().flat_map(|moment| moment.x).fold(0.0_f64, |most, x| most.max(x.abs()));
    let pair = |moment| [over_height(moment, deepest, range), over_place(moment, widest, range)];
    Figure {
        title: Label::plain(title),
        panels: moments.iter().flat_map(pair).collect(),
        arrangement: Arrangement::Grid { columns: 2, share: false },
        size: Figure::size_for(250, 420, moments.len()),
        ..Figure::default()
    }
    .with_room_for_legends()
}

fn style(ink: Ink, width: f64) -> Style {
    Style { ink: Some(ink), dash: Some(Dash::Solid), width }
}

fn over_height<'a>(moment: &AnchorMoment<'a>, deepest: f64, range: (f64, f64)) -> Panel<'a> {
    let ((d, u), slope) = (moment.apex, moment.slope);
    let (h, p): (Vec<f64>, Vec<f64>) = moment.corners.iter().copied().unzip();
    let curve = Series { style: style(Ink::Palette(0), 1.2), ..Series::new("memory p(h)", h, p) };
    let apex = Series { style: style(Ink::Palette(1), 1.6), ..Series::new("apex (d, u)", vec![d], vec![u]) };
    let wedge = wedge(vec![0.0, d], [slope * d, 0.0].map(|reach| [u - reach, u + reach]).to_vec());
    Panel {
        heading: Label::plain(moment.heading),
        x: Axis { covers: Some((0.0, deepest)), ..Axis::new(Label::plain("depth h"), "m") },
        y: Axis { covers: Some(range), ..Axis::new(Label::plain("reversal p"), "m") },
        bands: if d > 0.0 { vec![wedge] } else { Vec::new() },
        series: if d > 0.0 { vec![curve, apex] } else { vec![apex] },
        ..Panel::default()
    }
}

fn over_place<'a>(moment: &AnchorMoment<'a>, widest: f64, range: (f64, f64)) -> Panel<'a> {
    let ((d, u), slope) = (moment.apex, moment.slope);
    let reach = |g: &f64| slope * (d - g).max(0.0);
    let edges = moment.g.iter().map(|g| [u - reach(g), u + reach(g)]).collect();
    let curve =
        Series { style: style(Ink::Palette(0), 1.2), ..Series::new("memory p(h)", moment.x, moment.p) };
    let absence = if moment.x.is_empty() { Label::plain("open contact") } else { Label::default() };
    Panel {
        heading: Label::plain(moment.heading),
        x: Axis { covers: Some((-widest, widest)), ..Axis::new(Label::plain("position x"), "m") },
        y: Axis { covers: Some(range), ..Axis::new(Label::plain("reversal p"), "m") },
        bands: if moment.x.is_empty() { Vec::new() } else { vec![wedge(moment.x.to_vec(), edges)] },
        series: vec![curve],
        absence,
        ..Panel::default()
    }
}

fn wedge(xs: Vec<f64>, edges: Vec<[f64; 2]>) -> Band<'static> {
    let (low, high): (Vec<f64>, Vec<f64>) = edges.into_iter().map(|[low, high]| (low, high)).unzip();
    Band {
        label: Label::plain("|p − u| ≤ κ(d − h), limit of full slip"),
        xs: xs.into(),
        low: low.into(),
        high: high.into(),
        ink: Ink::Shade(1),
    }
}
