//! Waveforms: value and rate over time.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// Waveform as points over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveformCourse<'a> {
    /// Name of the waveform.
    pub name: &'a str,
    /// Unit of the values; empty if unknown.
    pub unit: &'a str,
    /// Times, s; twice at jumps of the value or the rate.
    pub time: &'a [f64],
    /// Value at each time.
    pub value: &'a [f64],
    /// Rate at each time, per s.
    pub rate: &'a [f64],
    /// Times of the corners, s.
    pub corners: &'a [f64],
    /// Values at the corners.
    pub corner_values: &'a [f64],
}

const NOTHING: &str = "no waveform";

/// Draws each waveform next to its rate, one waveform per row. Dots are corners, between which the waveform is smooth.
pub fn waveform_figure<'a>(title: &str, courses: &[WaveformCourse<'a>]) -> Figure<'a> {
    if courses.is_empty() {
        return Figure::without_data(title, NOTHING);
    }
    let panels: Vec<Panel<'a>> = courses
        .iter()
        .enumerate()
        .flat_map(|(place, course)| [value(place, course), rate(place, course)])
        .collect();
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Grid { columns: 2, share: false },
        size: Figure::size_for(140, 440, courses.len()),
        ..Figure::default()
    }
}

fn value<'a>(place: usize, course: &WaveformCourse<'a>) -> Panel<'a> {
    let mut series = vec![line(place, course.time, course.value)];
    // Points separated by gaps are drawn as dots.
    let gapped = |values: &[f64]| values.iter().flat_map(|value| [*value, f64::NAN]).collect::<Vec<f64>>();
    if !course.corners.is_empty() {
        let style = Style { ink: Some(Ink::Foreground), dash: Some(Dash::Solid), width: 0.7 };
        let dots = Series::new("", gapped(course.corners), gapped(course.corner_values));
        series.push(Series { style, ..dots });
    }
    Panel {
        heading: Label::plain(course.name),
        x: time(),
        y: Axis::new(Label::plain("value"), course.unit),
        series,
        ..Panel::default()
    }
}

fn rate<'a>(place: usize, course: &WaveformCourse<'a>) -> Panel<'a> {
    let unit = if course.unit.is_empty() { "1/s".to_owned() } else { format!("{}/s", course.unit) };
    Panel {
        // A heading of the same height as next to it.
        heading: Label::plain("rate"),
        x: time(),
        y: Axis::new(Label::plain("rate"), &unit),
        series: vec![line(place, course.time, course.rate)],
        ..Panel::default()
    }
}

fn time() -> Axis {
    Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") }
}

fn line<'a>(place: usize, time: &'a [f64], values: &'a [f64]) -> Series<'a> {
    let style = Style { ink: Some(Ink::Palette(place)), dash: Some(Dash::Solid), width: 1.0 };
    Series { style, ..Series::new("", time, values) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_waveform_has_its_value_and_its_rate() {
        let course = WaveformCourse {
            name: "drive",
            unit: "m",
            time: &[0.0, 1.0, 1.0, 2.0],
            value: &[0.0, 1.0, 1.0, 0.0],
            rate: &[1.0, 1.0, -1.0, -1.0],
            corners: &[1.0],
            corner_values: &[1.0],
        };
        let figure = waveform_figure("Title", &[course, WaveformCourse { unit: "", ..course }]);
        assert_eq!(figure.panels.len(), 4);
        assert_eq!((figure.panels[0].y.unit.as_str(), figure.panels[1].y.unit.as_str()), ("m", "m/s"));
        assert_eq!(figure.panels[3].y.unit, "1/s");
        assert!(figure.panels[0].series[1].is_scattered() && figure.panels[1].series.len() == 1);
        assert!(crate::draw_svg(&figure).is_ok());
        assert!(waveform_figure("Title", &[]).panels[0].series.is_empty());
    }
}
