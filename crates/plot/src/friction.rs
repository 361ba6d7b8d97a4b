//! Friction work per area over the radius and time.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Mosaic, Panel, Reference, Series};
use crate::theme::{Dash, Ink, RAMP, Style};
use crate::{Label, scale::quantity};

/// Friction work per area since the start, by radius and time.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionWork<'a> {
    /// Name and unit of the axis of the moments, such as "time t".
    pub axis: (&'a str, &'a str),
    /// Moments in the unit of the axis, ascending.
    pub moments: &'a [f64],
    /// Distances r from the axis of the contact, m, ascending.
    pub r: &'a [f64],
    /// Friction work per area since the start, J/m², moment by moment.
    pub work: &'a [f64],
    /// Moments whose radial distribution is drawn, with their names.
    pub marks: &'a [(f64, String)],
}

/// Number of classes of the map.
const CLASSES: usize = RAMP.len();
/// Maximum number of curves over r.
const MOST_CURVES: usize = 6;

/// Draws a map of the friction work per area over radius and time, and below its radial distribution at the named moments.
pub fn friction_figure<'a>(title: &str, work: &FrictionWork<'a>) -> Figure<'a> {
    friction_figures(title, &[("", work)])
}

/// Draws the figure of [`friction_figure`] for several contacts, one below the other. Contacts without friction work are left out.
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
            "no friction work per area: the run did not reach any of the requested times".to_owned()
        } else if works.iter().all(|(_, work)| work.r.is_empty()) {
            "no friction work per area: a list of springs or a normal law has no shape in three dimensions"
                .to_owned()
        } else {
            let unit = works[0].1.axis.1;
            let until =
                if unit.is_empty() { String::new() } else { format!(" until {}", quantity(last, unit, 4)) };
            format!("no friction work{until}: no slip")
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
        // Zero has a class of its own, so that areas without slip are visible.
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
    // The last moment is always included.
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
