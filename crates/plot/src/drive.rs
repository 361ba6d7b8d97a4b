//! Time histories of a drive: voltage, current, positions and contact forces.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style, Theme};
use crate::trajectory::Track;

/// Height of each panel after the second, px.
const MORE: u32 = 280;

/// Driver of a piezo stack, with its time histories.
#[derive(Debug, Clone, PartialEq)]
pub struct Supply<'a> {
    /// Name of the stack.
    pub name: &'a str,
    /// Commanded voltage, V; empty if unknown.
    pub command: Vec<f64>,
    /// Voltage at the stack, V.
    pub voltage: &'a [f64],
    /// Current into the stack, A.
    pub current: &'a [f64],
    /// Time ranges in which the command exceeds the voltage window, s.
    pub cut: Vec<(f64, f64)>,
    /// Time ranges in which the current is at its limit, s.
    pub limited: Vec<(f64, f64)>,
}

/// Time histories of a drive, usually over its last periods.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DriveCourse<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// Drivers. Without drivers there are no panels of voltage and current.
    pub supplies: Vec<Supply<'a>>,
    /// Free strokes of actuators and positions of feet, m, drawn muted.
    pub feet: Vec<Track<'a>>,
    /// Positions of the sliders, m.
    pub bodies: Vec<Track<'a>>,
    /// Tangential forces of the contacts, N.
    pub forces: Vec<Track<'a>>,
    /// Friction limit μF_N of the only contact, N, drawn with both signs.
    pub limit: Option<f64>,
    /// Whether the slide rises at more than 45 degrees.
    pub is_upright: bool,
}

/// Draws voltage, current, positions and contact forces below each other on one time axis. Active driver limits are shaded.
pub fn drive_figure<'a>(title: &str, course: &DriveCourse<'a>) -> Figure<'a> {
    let mut panels = Vec::new();
    if !course.supplies.is_empty() {
        panels.extend(supplies(course));
    }
    if !course.feet.is_empty() || !course.bodies.is_empty() || panels.is_empty() {
        let label = if course.is_upright { "position x, up" } else { "position x" };
        let foot = |(place, track): (usize, &Track<'a>)| {
            let style = Style { ink: Some(Ink::Muted), dash: Some(Dash::at(place)), width: 0.7 };
            curve(course, track.name, track.values, style)
        };
        let body =
            |(place, track): (usize, &Track<'a>)| curve(course, track.name, track.values, solid(place));
        let series = course
            .feet
            .iter()
            .enumerate()
            .map(foot)
            .chain(course.bodies.iter().enumerate().map(body))
            .collect();
        panels.push(Panel { series, absence: Label::plain("nothing moves"), ..panel(label, "m", 1.6) });
    }
    if !course.forces.is_empty() {
        let force =
            |(place, track): (usize, &Track<'a>)| curve(course, track.name, track.values, solid(place));
        let line = |y| Reference::Horizontal { y, label: Label::markup("±μF_N") };
        let limit = course.limit.filter(|limit| *limit > 0.0 && limit.is_finite());
        panels.push(Panel {
            series: course.forces.iter().enumerate().map(force).collect(),
            references: limit.into_iter().flat_map(|limit| [line(limit), line(-limit)]).collect(),
            ..panel("contact force", "N", 1.0)
        });
    }
    let (width, height) = Figure::DEFAULT_SIZE;
    let size = (width, height + MORE * (panels.len() as u32).saturating_sub(2));
    let arrangement = Arrangement::Column { share_x: true };
    Figure { title: Label::plain(title), panels, arrangement, size, ..Figure::default() }
        .with_room_for_legends()
}

/// Returns the panels of voltage and current of all drivers.
fn supplies<'a>(course: &DriveCourse<'a>) -> [Panel<'a>; 2] {
    let (mut voltage, mut current) = (panel("voltage", "V", 1.0), panel("current", "A", 1.0));
    for (place, supply) in course.supplies.iter().enumerate() {
        let command = Style { ink: Some(Ink::Muted), dash: Some(Dash::Dashed), width: 0.7 };
        if supply.command.len() == course.time.len() {
            let name = if place == 0 { "command" } else { "" };
            let series = Series::new(name, course.time, supply.command.clone());
            voltage.series.push(Series { style: command, ..series });
        }
        voltage.series.push(curve(course, supply.name, supply.voltage, solid(place)));
        current.series.push(curve(course, supply.name, supply.current, solid(place)));
        voltage.bands.extend(shade("window limit", &supply.cut, supply.voltage));
        current.bands.extend(shade("current limit", &supply.limited, supply.current));
    }
    [voltage, current]
}

fn panel<'a>(label: &str, unit: &str, share: f64) -> Panel<'a> {
    Panel {
        x: Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") },
        y: Axis::new(Label::plain(label), unit),
        share,
        ..Panel::default()
    }
}

fn curve<'a>(course: &DriveCourse<'a>, name: &str, values: &'a [f64], style: Style) -> Series<'a> {
    Series { style, ..Series::new(name, course.time, values) }
}

/// Returns a palette colour with a solid line until the colours repeat.
fn solid(place: usize) -> Style {
    Style { ink: Some(Ink::Palette(place)), dash: Some(Dash::at(place / Theme::COLOURS)), width: 1.0 }
}

/// Shades time ranges over the range of the values. `None` without ranges or values.
fn shade<'a>(name: &str, spans: &[(f64, f64)], values: &[f64]) -> Option<Band<'a>> {
    let finite = values.iter().filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
    if spans.is_empty() || low > high {
        return None;
    }
    let edge = |y: f64| spans.iter().flat_map(|_| [y, y, f64::NAN]).collect::<Vec<f64>>();
    Some(Band {
        label: Label::plain(name),
        xs: spans.iter().flat_map(|(from, to)| [*from, *to, *to]).collect::<Vec<f64>>().into(),
        low: edge(low).into(),
        high: edge(high).into(),
        ink: Ink::Shade(1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_shaded_where_they_are_active() {
        let (time, volts, amperes) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 1.0, 0.0], [2.0, 2.0, 0.0, -2.0]);
        let supply = Supply {
            name: "stack",
            command: vec![0.0, 2.0, 2.0, 0.0],
            voltage: &volts,
            current: &amperes,
            cut: Vec::new(),
            limited: vec![(0.0, 1.0), (2.5, 3.0)],
        };
        let course = DriveCourse { time: &time, supplies: vec![supply], ..DriveCourse::default() };
        let figure = drive_figure("Title", &course);
        assert_eq!(figure.panels.len(), 2);
        assert!(figure.panels[0].bands.is_empty());
        let band = &figure.panels[1].bands[0];
        assert_eq!(
            figure.panels[1].columns(band).flatten().collect::<Vec<_>>(),
            [(0.0, -2.0, 2.0), (1.0, -2.0, 2.0), (2.5, -2.0, 2.0), (3.0, -2.0, 2.0)]
        );
        assert!(crate::draw_svg(&figure).is_ok());
    }
}
