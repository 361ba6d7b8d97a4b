//! Where friction does its work: over the radius, along the way.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Mosaic, Panel, Reference, Series};
use crate::theme::{Dash, Ink, RAMP, Style};
use crate::{Label, scale::quantity};

/// Friction work per area by place, so far, at some moments.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionWork<'a> {
    /// What the moments are counted by, such as "time t", and its unit.
    pub axis: (&'a str, &'a str),
    /// Moments, ascending.
    pub moments: &'a [f64],
    /// Distances from the axis, m, ascending.
    pub r: &'a [f64],
    /// Work per area so far, J/m², moment by moment.
    pub work: &'a [f64],
    /// Moments to be marked, with their names.
    pub marks: &'a [(f64, String)],
}

/// Classes of the map.
const CLASSES: usize = RAMP.len();
/// Curves over r at most.
const MOST_CURVES: usize = 6;

/// Above, work per area over place and moment as a map; below, over place at the moments that are marked, the last darkest.
pub fn friction_figure<'a>(title: &str, work: &FrictionWork<'a>) -> Figure<'a> {
    friction_figures(title, &[("", work)])
}

/// The same of several contacts by their names, one below the other; those that never slip are left out.
pub fn friction_figures<'a>(title: &str, works: &[(&str, &FrictionWork<'a>)]) -> Figure<'a> {
    let mut panels = Vec::new();
    for (name, work) in works {
        let most = work.work.iter().copied().filter(|w| w.is_finite()).fold(0.0, f64::max);
        if most > 0.0 {
            let heading = Label::plain(name);
            panels.extend(
                [map(work, most), profiles(work)].map(|panel| Panel { heading: heading.clone(), ..panel }),
            );
        }
    }
    if panels.is_empty() {
        let last = works.iter().filter_map(|(_, work)| work.moments.last()).copied().fold(f64::NAN, f64::max);
        let words = if works.is_empty() {
            "no map of friction work: the run did not come to any of the moments that were asked for"
                .to_owned()
        } else if works.iter().all(|(_, work)| work.r.is_empty()) {
            "no map of friction work: a list of springs or a normal law has no shape in three dimensions"
                .to_owned()
        } else {
            let unit = works[0].1.axis.1;
            let until =
                if unit.is_empty() { String::new() } else { format!(" until {}", quantity(last, unit, 4)) };
            format!("no friction work{until}: nothing has slipped")
        };
        return Figure::without_data(title, &words);
    }
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(300, 520, panels.len()),
        panels,
        arrangement: Arrangement::Column { share_x: false },
        ..Figure::default()
    }
    .with_room_for_legends()
}

fn map<'a>(work: &FrictionWork<'a>, most: f64) -> Panel<'a> {
    let class = |value: &f64| {
        let share = if value.is_finite() { (value / most).clamp(0.0, 1.0) } else { 1.0 };
        // Nothing is a class of its own, so that what has never slipped is seen.
        (share * (CLASSES - 1) as f64).ceil() as u8
    };
    let label = |place: usize| match place {
        0 => "no work".to_owned(),
        place => format!("≤ {}", quantity(most * place as f64 / (CLASSES - 1) as f64, "J/m²", 3)),
    };
    let classes =
        RAMP.iter().enumerate().map(|(place, colour)| (Label::plain(&label(place)), Ink::Colour(*colour)));
    let mark = |(at, _): &(f64, String)| Reference::Vertical { x: *at, label: Label::default() };
    Panel {
        x: Axis { tight: true, ..Axis::new(Label::plain(work.axis.0), work.axis.1) },
        y: Axis { tight: true, ..Axis::new(Label::plain("r"), "m") },
        mosaic: Some(Mosaic {
            xs: work.moments.into(),
            ys: work.r.into(),
            cells: work.work.iter().map(class).collect::<Vec<u8>>().into(),
            classes: classes.collect(),
        }),
        references: work.marks.iter().map(mark).collect(),
        ..Panel::default()
    }
}

fn profiles<'a>(work: &FrictionWork<'a>) -> Panel<'a> {
    let nearest = |at: f64| {
        let off = |place: &usize| (work.moments[*place] - at).abs();
        (0..work.moments.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    };
    let stride = work.marks.len().div_ceil(MOST_CURVES).max(1);
    // The last is always among them.
    let marks = work.marks.iter().rev().step_by(stride).rev();
    let curves = marks.enumerate().filter_map(|(place, (at, name))| {
        let moment = nearest(*at)?;
        let values = work.work.get(moment * work.r.len()..(moment + 1) * work.r.len())?;
        let style = Style { ink: Some(Ink::Palette(place)), dash: Some(Dash::at(place)), width: 0.9 };
        Some(Series { style, ..Series::new(Label::plain(name), work.r, values) })
    });
    Panel {
        x: Axis { tight: true, ..Axis::new(Label::plain("r"), "m") },
        y: Axis::new(Label::plain("friction work per area"), "J/m²"),
        series: curves.collect(),
        ..Panel::default()
    }
}
