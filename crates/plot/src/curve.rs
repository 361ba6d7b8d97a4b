//! Performance curves of a drive over a varied parameter.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Lane, Mark, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Performance of a drive over a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineCurve<'a> {
    /// Name and unit of the parameter.
    pub axis: (&'a str, &'a str),
    /// Whether the parameter axis is logarithmic.
    pub logarithmic: bool,
    /// Values of the parameter, ascending.
    pub values: &'a [f64],
    /// Value of the parameter in the scenario; `None` draws no line.
    pub present: Option<f64>,
    /// Special values of the parameter and their names, drawn as vertical lines.
    pub landmarks: Vec<(String, f64)>,
    /// Results over the parameter, one panel each.
    pub courses: Vec<MachineCourse<'a>>,
    /// Values of the parameter without a result, grouped by reason.
    pub faults: Vec<(String, Vec<f64>)>,
}

/// Result over the parameter, such as the step length.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineCourse<'a> {
    /// Name of the result.
    pub name: &'a str,
    /// Unit of the result.
    pub unit: &'a str,
    /// Curves, for example one per direction.
    pub lines: Vec<MachineLine<'a>>,
}

/// Curve of a result.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineLine<'a> {
    /// Name in the legend; empty for none.
    pub name: &'a str,
    /// Result at each value of the parameter; not finite if unknown.
    pub values: Vec<f64>,
    /// Half-range over which the result varies from period to period, at each value; 0 if it is constant.
    pub spreads: Vec<f64>,
}

/// Height of a panel and of a lane, px.
const PANEL: u32 = 640;
const LANE: u32 = 70;

/// Draws one panel per result. A band shows the variation of a result from period to period. Lanes at the bottom mark
/// the values without a result, one lane per reason.
pub fn machine_figure<'a>(title: &str, curve: &MachineCurve<'a>) -> Figure<'a> {
    let is_known = |line: &MachineLine<'_>| line.values.iter().any(|value| value.is_finite());
    if !curve.courses.iter().flat_map(|course| &course.lines).any(is_known) {
        return Figure::without_data(title, "no point of the curve has a result");
    }
    let panels = curve.courses.iter().enumerate().map(|(place, course)| panel(place, curve, course));
    let (wide, high) = Figure::size_for(360, PANEL, curve.courses.len());
    let (_, lanes) = Figure::size_for(0, LANE, curve.faults.len());
    Figure {
        title: Label::plain(title),
        panels: panels.chain(without_answer(curve)).collect(),
        arrangement: Arrangement::Column { share_x: true },
        size: (wide, (high + lanes).min(Figure::MOST)),
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// Returns the panel of the values without a result, one lane per reason with its count; `None` if all values have a result.
fn without_answer<'a>(curve: &MachineCurve<'a>) -> Option<Panel<'a>> {
    let lane = |(kind, (reason, at)): (usize, &(String, Vec<f64>))| Lane {
        label: reason.clone(),
        note: at.len().to_string(),
        marks: at.iter().map(|x| Mark { from: *x, to: *x, height: 1.0 }).collect(),
        ink: Ink::Palette(3 + kind),
    };
    (!curve.faults.is_empty()).then(|| Panel {
        x: across(curve),
        lanes: curve.faults.iter().enumerate().map(lane).collect(),
        share: f64::from(LANE) / f64::from(PANEL) * curve.faults.len() as f64,
        ..Panel::default()
    })
}

/// Returns the axis of the parameter.
fn across(curve: &MachineCurve<'_>) -> Axis {
    let (name, unit) = curve.axis;
    Axis { logarithmic: curve.logarithmic, ..Axis::new(Label::plain(name), unit) }
}

fn panel<'a>(place: usize, curve: &MachineCurve<'a>, course: &MachineCourse<'a>) -> Panel<'a> {
    let style = |ink, width| Style { ink: Some(ink), dash: Some(Dash::Solid), width };
    // Curves of one name have the same colour in all panels. A single curve has the colour of its panel.
    let first = if course.lines.len() > 1 { 0 } else { place };
    let line = |(k, line): (usize, &MachineLine<'a>)| Series {
        marked: true,
        style: style(Ink::Palette(first + k), 1.0),
        ..Series::new(line.name, curve.values, line.values.clone())
    };
    let present = curve.present.filter(|x| is_within(*x, curve.values));
    let present = present.map(|x| Reference::Vertical { x, label: Label::plain("value in the scenario") });
    let landmarks =
        curve.landmarks.iter().map(|(name, x)| Reference::Vertical { x: *x, label: Label::plain(name) });
    Panel {
        x: across(curve),
        y: Axis::new(Label::plain(course.name), course.unit),
        bands: swings(curve.values, &course.lines),
        series: course.lines.iter().enumerate().map(line).collect(),
        references: [Reference::Horizontal { y: 0.0, label: Label::default() }]
            .into_iter()
            .chain(present)
            .chain(landmarks)
            .collect(),
        ..Panel::default()
    }
}

/// Returns the bands of the curves whose result varies from period to period. Only the first has a legend entry.
fn swings<'a>(xs: &'a [f64], lines: &[MachineLine<'a>]) -> Vec<Band<'a>> {
    let swinging = lines.iter().filter(|line| line.spreads.iter().any(|spread| *spread > 0.0));
    let band = |(place, line): (usize, &MachineLine<'a>)| {
        let edge = |sign: f64| -> Vec<f64> {
            line.values.iter().zip(&line.spreads).map(|(value, spread)| value + sign * spread).collect()
        };
        Band {
            label: Label::plain(if place == 0 { "range of step lengths" } else { "" }),
            xs: xs.into(),
            low: edge(-1.0).into(),
            high: edge(1.0).into(),
            ink: Ink::Shade(2),
        }
    };
    swinging.enumerate().map(band).collect()
}

fn is_within(x: f64, values: &[f64]) -> bool {
    values.first().is_some_and(|first| *first <= x) && values.last().is_some_and(|last| x <= *last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(values: &[f64]) -> MachineCurve<'_> {
        let line = |name, spread| MachineLine {
            name,
            values: vec![1e-9, f64::NAN, 3e-9],
            spreads: vec![0.0, f64::NAN, spread],
        };
        let course = |name, spread| MachineCourse { name, unit: "m", lines: vec![line("", spread)] };
        MachineCurve {
            axis: ("load", "N"),
            logarithmic: false,
            values,
            present: Some(0.1),
            landmarks: vec![("stall".to_owned(), 0.25)],
            courses: vec![course("step", 0.0), course("swing", 1e-9)],
            faults: vec![("refused".to_owned(), vec![0.2])],
        }
    }

    #[test]
    fn what_swings_has_a_band_and_what_is_not_known_a_mark_below() {
        let values = [0.1, 0.2, 0.3];
        let figure = machine_figure("Title", &curve(&values));
        let [step, swing, without] = &figure.panels[..] else { panic!("{}", figure.panels.len()) };
        assert!(step.bands.is_empty() && swing.bands.len() == 1);
        assert_eq!(swing.bands[0].high[2], 4e-9);
        // Points without a result are gaps.
        assert!(step.series.len() == 1 && step.series[0].ys[1].is_nan());
        assert_eq!((without.lanes[0].label.as_str(), without.lanes[0].marks[0].from), ("refused", 0.2));
        assert_eq!(step.references.len(), 3);
        assert_eq!(crate::draw_svg(&figure).err(), None);
    }

    /// Two curves of a result differ in colour, equally in every panel; only one band has a legend entry.
    #[test]
    fn lines_of_one_panel_have_colours_and_names_of_their_own() {
        let values = [0.1, 0.2, 0.3];
        let mut curve = curve(&values);
        for course in &mut curve.courses {
            let way = |name| MachineLine { name, spreads: vec![1e-9; 3], ..course.lines[0].clone() };
            course.lines = vec![way("forward"), way("backward")];
        }
        let figure = machine_figure("Title", &curve);
        let inks = |panel: &Panel<'_>| panel.series.iter().map(|line| line.style.ink).collect::<Vec<_>>();
        let wanted = [0, 1].map(|place| Some(Ink::Palette(place)));
        assert!(figure.panels[..2].iter().all(|panel| inks(panel) == wanted));
        let names: Vec<&Label> = figure.panels[0].bands.iter().map(|band| &band.label).collect();
        assert_eq!(names, [&Label::plain("range of step lengths"), &Label::default()]);
        assert_eq!(figure.panels[0].series[1].label, Label::plain("backward"));
    }

    /// On a logarithmic axis the mark at 1 lies midway between those at 1/5 and 5.
    #[test]
    fn marks_lie_where_the_axis_lays_them() {
        let values = [0.1, 1.0, 10.0];
        let mut curve = MachineCurve { logarithmic: true, present: None, ..curve(&values) };
        (curve.landmarks, curve.faults) = (Vec::new(), vec![("refused".to_owned(), vec![0.2, 1.0, 5.0])]);
        let figure = machine_figure("", &curve);
        let crate::theme::Colour(r, g, b) = figure.theme.palette[3];
        let mark = format!("fill=\"#{r:02X}{g:02X}{b:02X}\"");
        let svg = crate::draw_svg(&figure).unwrap();
        let x = |line: &str| line.split("x=\"").nth(1)?.split('"').next()?.parse::<f64>().ok();
        let marks: Vec<f64> = svg
            .lines()
            .filter(|line| line.starts_with("<rect") && line.contains(&mark))
            .filter_map(x)
            .collect();
        let [low, middle, high] = marks[..] else { panic!("{} marks", marks.len()) };
        assert!(low < middle && middle < high, "{marks:?}");
        assert!((low + high - 2.0 * middle).abs() <= f64::from(crate::canvas::UNITS), "{marks:?}");
    }

    /// On a logarithmic axis the corners of a band lie at the points of its curve.
    #[test]
    fn a_band_lies_over_its_line_on_a_logarithmic_axis() {
        let values = [0.1, 1.0, 10.0];
        let mut curve = MachineCurve { logarithmic: true, present: None, ..curve(&values) };
        (curve.landmarks, curve.faults) = (Vec::new(), Vec::new());
        let line = MachineLine { name: "", values: vec![2e-9; 3], spreads: vec![1e-9; 3] };
        curve.courses = vec![MachineCourse { name: "swing", unit: "m", lines: vec![line] }];
        let panel = &machine_figure("", &curve).panels[0];
        let places: Vec<f64> = panel.columns(&panel.bands[0]).flatten().map(|(x, ..)| x).collect();
        let points: Vec<f64> = panel.points(&panel.series[0]).flatten().map(|(x, _)| x).collect();
        assert_eq!((&places, &places[..]), (&points, &[-1.0, 0.0, 1.0][..]));
        let (x, _) = crate::range::extents(panel);
        let (low, high) = x.range(0.0).unwrap();
        assert!(low == -1.0 && high == 1.0, "{low} {high}");
    }

    #[test]
    fn a_curve_without_an_answer_says_so() {
        let values = [0.1];
        let mut curve = curve(&values);
        let lines = curve.courses.iter_mut().flat_map(|course| &mut course.lines);
        lines.for_each(|line| line.values.fill(f64::NAN));
        assert!(machine_figure("Title", &curve).panels[0].series.is_empty());
    }
}
