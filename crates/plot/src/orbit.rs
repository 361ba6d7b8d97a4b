//! A motion that repeats itself, and how it comes back when it is disturbed.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};
use crate::trajectory::Track;

/// Points of the unit circle.
const POINTS: u32 = 181;
/// What the circle's panel shows of the plane at least.
const REACH: f64 = 1.05;
/// So near to the circle a multiplier is on it.
const NEUTRAL: f64 = 1e-6;

/// One period of a motion that repeats itself.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitCourse<'a> {
    /// Time since the period began, s.
    pub time: &'a [f64],
    /// What leads, m.
    pub feet: Vec<Track<'a>>,
    /// What follows, without the way that it goes on in a period, m.
    pub sliders: Vec<Track<'a>>,
    /// Their velocities, m/s.
    pub speeds: Vec<Track<'a>>,
    /// Forces of the contacts, N.
    pub forces: Vec<Track<'a>>,
    /// Floquet multipliers, both of each pair.
    pub multipliers: Vec<(f64, f64)>,
}

/// Places, velocities and forces over one period, and the multipliers in the unit circle: what lies within fades, what lies outside
/// grows.
pub fn orbit_figure<'a>(title: &str, course: &OrbitCourse<'a>) -> Figure<'a> {
    let time = Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") };
    let track = |track: &Track<'a>, ink, dash, width| Series {
        style: Style { ink: Some(ink), dash, width },
        ..Series::new(track.name, course.time, track.values)
    };
    let coloured = |tracks: &[Track<'a>]| -> Vec<Series<'a>> {
        tracks.iter().enumerate().map(|(i, it)| track(it, Ink::Palette(i), None, 1.0)).collect()
    };
    let panel = |(label, unit): (&str, &str), series| Panel {
        x: time.clone(),
        y: Axis::new(Label::markup(label), unit),
        series,
        absence: Label::plain("nothing moves"),
        ..Panel::default()
    };
    let feet = course.feet.iter().enumerate();
    let mut places: Vec<Series<'a>> =
        feet.map(|(i, it)| track(it, Ink::Muted, Some(Dash::at(i)), 0.6)).collect();
    places.extend(coloured(&course.sliders));
    let panels = vec![
        panel(("position x, drift removed", "m"), places),
        panel(("velocity dx/dt", "m/s"), coloured(&course.speeds)),
        Panel { absence: Label::plain("no contacts"), ..panel(("force F_x", "N"), coloured(&course.forces)) },
        circle(&course.multipliers),
    ];
    let arrangement = Arrangement::Grid { columns: 2, share: false };
    Figure { title: Label::plain(title), panels, arrangement, size: (1600, 1300), ..Figure::default() }
        .with_room_for_legends()
}

/// Multipliers by what becomes of a disturbance.
fn circle(multipliers: &[(f64, f64)]) -> Panel<'static> {
    let angles = (0..POINTS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(POINTS - 1));
    let (x, y): (Vec<f64>, Vec<f64>) = angles.map(|angle| (math::cos(angle), math::sin(angle))).unzip();
    let mut series = vec![Series {
        style: Style { ink: Some(Ink::Muted), dash: Some(Dash::Solid), width: 0.6 },
        ..Series::new("", x, y)
    }];
    let grows = |(re, im): &(f64, f64)| math::hypot(*re, *im) > 1.0 + NEUTRAL;
    for (place, (name, outside)) in [("fades or stays", false), ("grows", true)].into_iter().enumerate() {
        let points = multipliers.iter().filter(|multiplier| grows(multiplier) == outside);
        // Gaps between: they are points, and no line.
        let (x, y): (Vec<f64>, Vec<f64>) = points.flat_map(|it| [*it, (f64::NAN, f64::NAN)]).unzip();
        if !x.is_empty() {
            let style = Style { ink: Some(Ink::Palette(place)), dash: Some(Dash::Solid), width: 1.6 };
            series.push(Series { style, marked: true, ..Series::new(name, x, y) });
        }
    }
    let reach = multipliers.iter().fold(REACH, |most, (re, im)| most.max(1.05 * re.abs().max(im.abs())));
    let axis = |label: &str| Axis { covers: Some((-reach, reach)), ..Axis::new(Label::plain(label), "") };
    let heading = if multipliers.is_empty() { "no multipliers" } else { "" };
    Panel {
        heading: Label::plain(heading),
        x: axis("Re λ (Floquet multipliers)"),
        y: axis("Im λ"),
        series,
        aspect: Some(1.0),
        ..Panel::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multipliers_are_points_in_a_circle_that_is_round() {
        let (time, x) = ([0.0, 1.0, 2.0], [0.0, 0.5, 0.0]);
        let slider = Track { name: "slider", values: &x };
        let multipliers = vec![(0.6, 0.801), (0.6, -0.801), (0.3, 0.0)];
        let course =
            OrbitCourse { time: &time, sliders: vec![slider], multipliers, ..OrbitCourse::default() };
        let figure = orbit_figure("steady", &course);
        let circle = &figure.panels[3];
        let names: Vec<usize> = circle.series.iter().map(|series| series.xs.len()).collect();
        assert_eq!((names, circle.aspect), (vec![181, 2, 4], Some(1.0)));
        assert!(crate::draw_png(&figure).is_ok_and(|bytes| !bytes.is_empty()));
    }
}
