//! Periodic orbit and its Floquet multipliers.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};
use crate::trajectory::Track;

/// Number of points of the unit circle.
const POINTS: u32 = 181;
/// Minimum half-range of the axes of the unit circle.
const REACH: f64 = 1.05;
/// Tolerance of |λ| - 1 within which a multiplier is on the unit circle.
const NEUTRAL: f64 = 1e-6;

/// One period of a periodic orbit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitCourse<'a> {
    /// Time since the start of the period, s.
    pub time: &'a [f64],
    /// Positions of the feet, m.
    pub feet: Vec<Track<'a>>,
    /// Positions of the sliders without the drift of one step length per period, m.
    pub sliders: Vec<Track<'a>>,
    /// Velocities of the sliders, m/s.
    pub speeds: Vec<Track<'a>>,
    /// Tangential forces of the contacts, N.
    pub forces: Vec<Track<'a>>,
    /// Floquet multipliers (real, imaginary part); complex pairs as two entries.
    pub multipliers: Vec<(f64, f64)>,
}

/// Draws positions, velocities and forces over one period, and the Floquet multipliers in the complex plane with the unit circle.
/// Multipliers outside the circle, whose disturbances grow, have another colour.
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

/// Returns the panel of the multipliers, grouped by stability.
fn circle(multipliers: &[(f64, f64)]) -> Panel<'static> {
    let angles = (0..POINTS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(POINTS - 1));
    let (x, y): (Vec<f64>, Vec<f64>) = angles.map(|angle| (math::cos(angle), math::sin(angle))).unzip();
    let mut series = vec![Series {
        style: Style { ink: Some(Ink::Muted), dash: Some(Dash::Solid), width: 0.6 },
        ..Series::new("", x, y)
    }];
    let grows = |(re, im): &(f64, f64)| math::hypot(*re, *im) > 1.0 + NEUTRAL;
    for (place, (name, outside)) in [("decays or neutral", false), ("grows", true)].into_iter().enumerate() {
        let points = multipliers.iter().filter(|multiplier| grows(multiplier) == outside);
        // Gaps prevent connecting lines.
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
