//! Trajectories: positions and displacements of a drive over time.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Height of each panel after the second, px.
const MORE: u32 = 300;

/// Named position or displacement over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Track<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Values, m.
    pub values: &'a [f64],
}

/// Coordinate other than the position along the slide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coordinate {
    /// Position normal to the slide, m.
    Height,
    /// Angle, rad.
    Pitch,
}

/// Motion in a coordinate with a panel of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion<'a> {
    /// Coordinate of the panel.
    pub coordinate: Coordinate,
    /// Feet, drawn muted behind the sliders.
    pub feet: Vec<Track<'a>>,
    /// Sliders, in the same colours as in the other panels.
    pub sliders: Vec<Track<'a>>,
}

/// Motion of a drive.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// Feet, drawn muted behind the sliders.
    pub feet: Vec<Track<'a>>,
    /// Sliders. Without feet and sliders there is no panel of positions.
    pub sliders: Vec<Track<'a>>,
    /// Motion in the other coordinates, one panel each.
    pub beside: Vec<Motion<'a>>,
    /// Displacements u of the contacts, m. Without them there is no panel of displacements.
    pub relative: Vec<Track<'a>>,
    /// Gross slip displacement `u_c`, m, drawn with both signs. For contacts that oscillate about u = 0; in a drive u
    /// drifts by a step length per period.
    pub gross_slip: Option<f64>,
    /// Whether the slide rises at more than 45 degrees; the axis label then states this.
    pub is_upright: bool,
}

/// Draws positions over time at the top, then the other coordinates and the contact displacements, on one time axis.
pub fn trajectory_figure<'a>(title: &str, trajectory: &Trajectory<'a>) -> Figure<'a> {
    let beside = &trajectory.beside;
    let slider_names =
        names(trajectory.sliders.iter().chain(beside.iter().flat_map(|motion| &motion.sliders)));
    let feet_names = names(trajectory.feet.iter().chain(beside.iter().flat_map(|motion| &motion.feet)));
    let series = |track: &Track<'a>, ink, dash, width| Series {
        style: Style { ink: Some(ink), dash, width },
        ..Series::new(track.name, trajectory.time, track.values)
    };
    let time = Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") };
    let panel = |(label, unit): (&str, &str), feet: &[Track<'a>], sliders: &[Track<'a>], share| {
        let place = |track: &Track<'_>| slider_names.iter().position(|name| *name == track.name).unwrap_or(0);
        // Feet have the same colour and differ in dashes, equally in all panels.
        let foot = |track: &Track<'_>| feet_names.iter().position(|name| *name == track.name).unwrap_or(0);
        let feet = feet.iter().map(|track| series(track, Ink::Muted, Some(Dash::at(foot(track))), 0.6));
        let sliders = sliders.iter().map(|track| series(track, Ink::Palette(place(track)), None, 1.0));
        Panel {
            x: time.clone(),
            y: Axis::new(Label::plain(label), unit),
            series: feet.chain(sliders).collect(),
            absence: Label::plain("nothing moves"),
            share,
            ..Panel::default()
        }
    };
    let mut panels = Vec::new();
    if !trajectory.feet.is_empty() || !trajectory.sliders.is_empty() || trajectory.beside.is_empty() {
        let position = if trajectory.is_upright { "position x, up" } else { "position x" };
        panels.push(panel((position, "m"), &trajectory.feet, &trajectory.sliders, 1.6));
    }
    for motion in &trajectory.beside {
        let axis = match motion.coordinate {
            Coordinate::Height => ("height z", "m"),
            Coordinate::Pitch => ("pitch θ", "rad"),
        };
        panels.push(panel(axis, &motion.feet, &motion.sliders, 1.0));
    }
    if !trajectory.relative.is_empty() {
        let relative = trajectory.relative.iter().enumerate();
        let limit = |y| Reference::Horizontal { y, label: Label::markup("±u_c") };
        let gross_slip = trajectory.gross_slip.filter(|u| *u > 0.0 && u.is_finite());
        panels.push(Panel {
            x: time,
            y: Axis::new(Label::plain("displacement u"), "m"),
            series: relative.map(|(i, track)| series(track, Ink::Palette(i), None, 1.0)).collect(),
            references: gross_slip.into_iter().flat_map(|u| [limit(u), limit(-u)]).collect(),
            share: 1.0,
            ..Panel::default()
        });
    }
    let (width, height) = Figure::DEFAULT_SIZE;
    let size = (width, height + MORE * (panels.len() as u32).saturating_sub(2));
    let arrangement = Arrangement::Column { share_x: true };
    Figure { title: Label::plain(title), panels, arrangement, size, ..Figure::default() }
        .with_room_for_legends()
}

/// Returns the distinct names of tracks, in order of appearance.
fn names<'a>(tracks: impl Iterator<Item = &'a Track<'a>>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for track in tracks {
        if !names.contains(&track.name) {
            names.push(track.name);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn followers_are_told_apart_by_the_same_dashes_in_all_panels() {
        let track = |name| Track { name, values: &[0.0, 1.0] };
        let lifted = Motion {
            coordinate: Coordinate::Height,
            feet: vec![track("b"), track("c")],
            sliders: Vec::new(),
        };
        let trajectory = Trajectory {
            time: &[0.0, 1.0],
            feet: vec![track("a"), track("b")],
            beside: vec![lifted],
            ..Trajectory::default()
        };
        let figure = trajectory_figure("", &trajectory);
        let dashes =
            |panel: usize| -> Vec<_> { figure.panels[panel].series.iter().map(|s| s.style.dash).collect() };
        assert_eq!(dashes(0), [Some(Dash::at(0)), Some(Dash::at(1))]);
        assert_eq!(dashes(1), [Some(Dash::at(1)), Some(Dash::at(2))]);
        assert!(Dash::at(0) == Dash::Solid && Dash::at(1) != Dash::Solid && Dash::at(2) != Dash::at(1));
    }
}
