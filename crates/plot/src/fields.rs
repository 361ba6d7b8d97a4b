//! Stresses and displacements in a contact over the radius, at several times.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Series};
use crate::theme::{Dash, Ink, Style};
use crate::{Label, SpringCondition};

/// Stresses and displacements of a contact at one time, over the distance from its axis.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldsMoment<'a> {
    /// Heading of the panels, such as the time.
    pub heading: &'a str,
    /// Distances r from the axis, m, ascending from 0.
    pub r: &'a [f64],
    /// Pressure p at each distance, Pa; not finite for a gap.
    pub pressure: &'a [f64],
    /// Shear stress τ at each distance, Pa.
    pub shear: &'a [f64],
    /// Surface displacement u at each distance, m.
    pub displacement: &'a [f64],
    /// Local slip relative to the centre at each distance, m.
    pub slip: &'a [f64],
    /// Coefficient of friction μ.
    pub friction: f64,
    /// Rings with their states, from the centre to the edge.
    pub zones: &'a [FieldsZone],
}

/// Ring of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldsZone {
    /// Inner and outer radius, m.
    pub radii: [f64; 2],
    /// State of the ring.
    pub condition: SpringCondition,
    /// Whether the ring sticks with the stretch distribution of an earlier slip.
    pub frozen: bool,
}

/// Stresses above this multiple of the median pressure are gaps: pressure is unbounded at tips and edges.
const TALL: f64 = 3.5;

/// Draws two panels per time, side by side, over both sides of the axis. The left one shows p, τ and the friction limit ±μp; the right one
/// shows displacement and slip. The state of each ring is shaded. All times have the same scales.
pub fn fields_figure<'a>(title: &str, moments: &[FieldsMoment<'a>]) -> Figure<'a> {
    if moments.iter().all(|moment| moment.r.is_empty()) {
        let words = if moments.is_empty() {
            "no fields: the run did not reach any of the requested times"
        } else {
            "no fields: the contact is open, or it is a list of springs"
        };
        return Figure::without_data(title, words);
    }
    let tall = TALL * median(moments);
    let bounded = |value: f64| if value.abs() <= tall { value } else { f64::NAN };
    let stress = reach(moments.iter().flat_map(|moment| {
        let limits = moment.pressure.iter().map(|p| -moment.friction * bounded(*p));
        moment
            .pressure
            .iter()
            .map(|p| bounded(*p))
            .chain(limits)
            .chain(moment.shear.iter().map(|t| bounded(*t)))
    }));
    let ways =
        reach(moments.iter().flat_map(|moment| moment.displacement.iter().chain(moment.slip).copied()));
    let pair = |moment| [stresses(moment, stress, bounded), displacements(moment, ways)];
    let mut panels: Vec<Panel<'a>> = moments.iter().flat_map(pair).collect();
    name_all(&mut panels);
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Grid { columns: 2, share: false },
        size: Figure::size_for(250, 440, moments.len()),
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// Adds the legend entries of all panels to the first panel, so that one legend serves all.
fn name_all(panels: &mut [Panel<'_>]) {
    let (mut curves, mut areas) = (Vec::<Series<'static>>::new(), Vec::<Band<'static>>::new());
    for panel in panels.iter() {
        for series in &panel.series {
            if !curves.iter().any(|known| known.label == series.label) {
                let style = series.style;
                curves.push(Series { style, ..Series::new(series.label.clone(), vec![], vec![]) });
            }
        }
        for band in &panel.bands {
            if !areas.iter().any(|known| known.label == band.label) {
                let none = || Vec::new().into();
                let (label, ink) = (band.label.clone(), band.ink);
                areas.push(Band { label, ink, xs: none(), low: none(), high: none() });
            }
        }
    }
    if let Some(first) = panels.first_mut() {
        first.series.extend(curves);
        first.bands.extend(areas);
    }
}

/// Returns the median of the positive, finite pressures of all times, Pa.
fn median(moments: &[FieldsMoment<'_>]) -> f64 {
    let pressures = moments.iter().flat_map(|moment| moment.pressure);
    let mut pressures: Vec<f64> = pressures.copied().filter(|p| *p > 0.0 && p.is_finite()).collect();
    pressures.sort_by(f64::total_cmp);
    pressures.get(pressures.len() / 2).copied().unwrap_or(f64::INFINITY)
}

/// Returns the range of the finite values, including 0.
fn reach(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.filter(|value| value.is_finite()).fold((0.0, 0.0), |(low, high), v| (low.min(v), high.max(v)))
}

/// Extends an even function of r to both sides of the axis.
fn both_sides(r: &[f64], values: impl Iterator<Item = f64>) -> (Vec<f64>, Vec<f64>) {
    let right: Vec<(f64, f64)> = r.iter().copied().zip(values).collect();
    let left = right.iter().rev().filter(|(r, _)| *r > 0.0).map(|(r, value)| (-r, *value));
    left.chain(right.iter().copied()).unzip()
}

/// Returns the bands of the rings on both sides of the axis, over the full height of the panel.
fn shades(zones: &[FieldsZone], (low, high): (f64, f64)) -> Vec<Band<'static>> {
    let band = |zone: &FieldsZone, side: f64| {
        let (label, ink) = look(zone);
        let mut xs = zone.radii.map(|r| side * r);
        xs.sort_by(f64::total_cmp);
        Band {
            label: Label::plain(label),
            xs: xs.to_vec().into(),
            low: vec![low; 2].into(),
            high: vec![high; 2].into(),
            ink,
        }
    };
    zones.iter().flat_map(|zone| [band(zone, -1.0), band(zone, 1.0)]).collect()
}

/// Returns the legend entry and colour of a ring.
fn look(zone: &FieldsZone) -> (&'static str, Ink) {
    match zone.condition {
        SpringCondition::Open => ("open", Ink::Shade(0)),
        SpringCondition::Stick if zone.frozen => ("sticks, with locked-in earlier slip", Ink::Shade(1)),
        SpringCondition::Stick => ("sticks", Ink::Shade(0)),
        SpringCondition::SlipForward => ("slips +", Ink::Pale(4)),
        SpringCondition::SlipBackward => ("slips −", Ink::Pale(5)),
    }
}

fn curve<'a>(
    label: &str,
    (r, values): (&[f64], impl Iterator<Item = f64>),
    (ink, dash, width): (Ink, Dash, f64),
) -> Series<'a> {
    let (xs, ys) = both_sides(r, values);
    Series {
        style: Style { ink: Some(ink), dash: Some(dash), width },
        ..Series::new(Label::markup(label), xs, ys)
    }
}

fn stresses<'a>(
    moment: &FieldsMoment<'a>,
    (low, high): (f64, f64),
    bounded: impl Fn(f64) -> f64,
) -> Panel<'a> {
    let pressure = |factor: f64| moment.pressure.iter().map(|p| factor * bounded(*p)).collect::<Vec<f64>>();
    let limit = |label, factor: f64| {
        curve(label, (moment.r, pressure(factor).into_iter()), (Ink::Muted, Dash::Dashed, 0.6))
    };
    Panel {
        heading: Label::plain(moment.heading),
        x: Axis { tight: true, ..Axis::new(Label::plain("r"), "m") },
        y: Axis { covers: Some((low, high)), ..Axis::new(Label::plain("stress"), "Pa") },
        bands: shades(moment.zones, (low, high)),
        series: vec![
            curve("pressure p", (moment.r, pressure(1.0).into_iter()), (Ink::Foreground, Dash::Solid, 0.8)),
            limit("±μp", moment.friction),
            limit("±μp", -moment.friction),
            curve(
                "shear stress τ",
                (moment.r, moment.shear.iter().map(|t| bounded(*t))),
                (Ink::Palette(1), Dash::Solid, 1.2),
            ),
        ],
        ..Panel::default()
    }
}

fn displacements<'a>(moment: &FieldsMoment<'a>, (low, high): (f64, f64)) -> Panel<'a> {
    Panel {
        heading: Label::plain(moment.heading),
        x: Axis { tight: true, ..Axis::new(Label::plain("r"), "m") },
        y: Axis { covers: Some((low, high)), ..Axis::new(Label::plain("displacement, slip"), "m") },
        bands: shades(moment.zones, (low, high)),
        series: vec![
            curve(
                "displacement u",
                (moment.r, moment.displacement.iter().copied()),
                (Ink::Palette(0), Dash::Solid, 1.2),
            ),
            curve(
                "slip relative to the centre",
                (moment.r, moment.slip.iter().copied()),
                (Ink::Palette(2), Dash::LongDash, 0.9),
            ),
        ],
        ..Panel::default()
    }
}
