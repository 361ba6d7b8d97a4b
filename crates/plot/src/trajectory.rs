//! Trajectories: the motion of a drive over time.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Ink, Style};

/// A named position or displacement over the trajectory's time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Track<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Values, m.
    pub values: &'a [f64],
}

/// The motion of a drive.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// The feet, drawn muted behind the sliders.
    pub feet: Vec<Track<'a>>,
    /// The sliders.
    pub sliders: Vec<Track<'a>>,
    /// Relative displacements of the contacts, m; no lower panel without.
    pub relative: Vec<Track<'a>>,
    /// Displacement `u_c` at which gross slip starts, m, marked with both signs in the lower panel; for contacts that
    /// oscillate about u = 0. In a drive u runs away with every step.
    pub gross_slip: Option<f64>,
}

/// Position over time: sliders over feet above, relative displacements below, on one time axis.
pub fn trajectory_figure<'a>(title: &str, trajectory: &Trajectory<'a>) -> Figure<'a> {
    let series = |track: &Track<'a>, ink, width| Series {
        style: Style { ink: Some(ink), dash: None, width },
        ..Series::new(track.name, trajectory.time, track.values)
    };
    let time = Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") };
    let feet = trajectory.feet.iter().map(|track| series(track, Ink::Muted, 0.6));
    let sliders = trajectory.sliders.iter().enumerate().map(|(i, track)| series(track, Ink::Palette(i), 1.0));
    let mut panels = vec![Panel {
        x: time.clone(),
        y: Axis::new(Label::plain("position x"), "m"),
        series: feet.chain(sliders).collect(),
        absence: Label::plain("nothing moves"),
        share: 1.6,
        ..Panel::default()
    }];
    if !trajectory.relative.is_empty() {
        let relative = trajectory.relative.iter().enumerate();
        let limit = |y| Reference::Horizontal { y, label: Label::markup("±u_c") };
        let gross_slip = trajectory.gross_slip.filter(|u| *u > 0.0 && u.is_finite());
        panels.push(Panel {
            x: time,
            y: Axis::new(Label::plain("displacement u"), "m"),
            series: relative.map(|(i, track)| series(track, Ink::Palette(i), 1.0)).collect(),
            references: gross_slip.into_iter().flat_map(|u| [limit(u), limit(-u)]).collect(),
            share: 1.0,
            ..Panel::default()
        });
    }
    let arrangement = Arrangement::Column { share_x: true };
    Figure { title: Label::plain(title), panels, arrangement, ..Figure::default() }.with_room_for_legends()
}
