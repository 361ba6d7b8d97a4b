//! The curves of a machine: what it does over something that is varied.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Lane, Mark, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// What a machine does over something that is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineCurve<'a> {
    /// What is varied, and its unit.
    pub axis: (&'a str, &'a str),
    /// Whether its decades are as far apart everywhere.
    pub logarithmic: bool,
    /// Its values, ascending.
    pub values: &'a [f64],
    /// What it is in the scene that the curve is of.
    pub present: Option<f64>,
    /// Values with a name.
    pub landmarks: Vec<(String, f64)>,
    /// What the machine does, a panel each.
    pub courses: Vec<MachineCourse<'a>>,
    /// Values at which nothing is known, by the reason.
    pub faults: Vec<(String, Vec<f64>)>,
}

/// One thing that a machine does.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineCourse<'a> {
    /// What.
    pub name: &'a str,
    /// Its unit.
    pub unit: &'a str,
    /// How much, a line for each way to do it.
    pub lines: Vec<MachineLine<'a>>,
}

/// One way to do it.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineLine<'a> {
    /// Its name in the legend; none where empty.
    pub name: &'a str,
    /// How much, as many as there are values; not finite where it is not known.
    pub values: Vec<f64>,
    /// How far it swings about that from period to period, as many; 0 where it does not.
    pub spreads: Vec<f64>,
}

/// Height of a panel, and of a lane, px.
const PANEL: u32 = 640;
const LANE: u32 = 70;

/// A panel for each thing that the machine does, one below the other: a line through its points, a band where it swings from period
/// to period. Points without an answer are marks in lanes below them all, one for each reason.
pub fn machine_figure<'a>(title: &str, curve: &MachineCurve<'a>) -> Figure<'a> {
    let is_known = |line: &MachineLine<'_>| line.values.iter().any(|value| value.is_finite());
    if !curve.courses.iter().flat_map(|course| &course.lines).any(is_known) {
        return Figure::without_data(title, "no point of the curve has an answer");
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

/// The points without an answer, by the reason, and how many they are; none where all have one.
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

/// The axis of what is varied.
fn across(curve: &MachineCurve<'_>) -> Axis {
    let (name, unit) = curve.axis;
    Axis { logarithmic: curve.logarithmic, ..Axis::new(Label::plain(name), unit) }
}

fn panel<'a>(place: usize, curve: &MachineCurve<'a>, course: &MachineCourse<'a>) -> Panel<'a> {
    let style = |ink, width| Style { ink: Some(ink), dash: Some(Dash::Solid), width };
    // Lines of one name have one colour in all panels; a line alone has that of its panel.
    let first = if course.lines.len() > 1 { 0 } else { place };
    let line = |(k, line): (usize, &MachineLine<'a>)| Series {
        marked: true,
        style: style(Ink::Palette(first + k), 1.0),
        ..Series::new(line.name, curve.values, line.values.clone())
    };
    let present = curve.present.filter(|x| is_within(*x, curve.values));
    let present = present.map(|x| Reference::Vertical { x, label: Label::plain("as in the scenario") });
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

/// Between which values lines swing, those that do; one name is enough for all.
fn swings<'a>(xs: &'a [f64], lines: &[MachineLine<'a>]) -> Vec<Band<'a>> {
    let swinging = lines.iter().filter(|line| line.spreads.iter().any(|spread| *spread > 0.0));
    let band = |(place, line): (usize, &MachineLine<'a>)| {
        let edge = |sign: f64| -> Vec<f64> {
            line.values.iter().zip(&line.spreads).map(|(value, spread)| value + sign * spread).collect()
        };
        Band {
            label: Label::plain(if place == 0 { "swings from period to period" } else { "" }),
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
        // Nothing is drawn where a value would be told by it.
        assert!(step.series.len() == 1 && step.series[0].ys[1].is_nan());
        assert_eq!((without.lanes[0].label.as_str(), without.lanes[0].marks[0].from), ("refused", 0.2));
        assert_eq!(step.references.len(), 3);
        assert_eq!(crate::draw_svg(&figure).err(), None);
    }

    /// Two ways to do one thing are told apart by their colours, the same in every panel; only one of their bands is named.
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
        assert_eq!(names, [&Label::plain("swings from period to period"), &Label::default()]);
        assert_eq!(figure.panels[0].series[1].label, Label::plain("backward"));
    }

    /// On a logarithmic axis a point at 1 lies half way between points at 1/5 and 5, of which it is the geometric mean.
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

    /// A band stands over the points of its line: its corners at the ends of a logarithmic axis are as far left and right as the marks
    /// of the line are.
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
