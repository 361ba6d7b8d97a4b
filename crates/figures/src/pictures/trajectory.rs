//! Plot of the motion of the bodies over time.

use super::layout::gravity;
use super::period::LastPeriod;
use super::{Kind, Sources, Undrawn, alike, of_contacts};
use crate::look::{Pen, Picture};
use stickslip_drive::scene::{Axis, Body, Freedom, Named, Side};
use stickslip_plot::{Coordinate, Motion, Track, Trajectory, enlarged_beside, trajectory_figure};
use stickslip_run::Job;
use stickslip_run::Kept;
use stickslip_run::Series;
use stickslip_scenario::PlotName;

pub(super) const KIND: Kind = Kind {
    shows: "positions and contact displacements over time; for a long run also the last period",
    needs: |job| [needs(job), of_contacts(job, &["u_m"])].concat(),
    draw,
};

/// Draws positions over time, heights and angles if there are any, and contact displacements. For a long run the last period is enlarged
/// next to the plot of the whole run.
fn draw(sources: &Sources<'_>, pen: &Pen<'_>) -> Result<Vec<Picture>, Undrawn> {
    let (job, kept) = (sources.job, sources.kept);
    let series = &kept.series;
    let contacts: Vec<&str> = job.model.contacts().map(|(name, _)| name).collect();
    let columns: Vec<Vec<&[f64]>> = contacts.iter().map(|name| vec![series.column(name, "u_m")]).collect();
    // Groups of equal displacements over the whole run, so that the enlargement has the same colours.
    let groups = alike::groups(&columns);
    let named = |group: &Vec<usize>| alike::name(&group.iter().map(|&c| contacts[c]).collect::<Vec<_>>());
    let names: Vec<String> = groups.iter().map(named).collect();
    let relative: Vec<(&str, &str)> =
        groups.iter().zip(&names).map(|(group, name)| (contacts[group[0]], name.as_str())).collect();
    let broken = series.broken(job.scenario.written.window);
    let whole = motion(job, &broken, &relative);
    let whole = Trajectory { gross_slip: gross_slip(job, kept), ..whole };
    let figure = trajectory_figure(job.title(), &whole);
    let Some((period, rows)) = LastPeriod::with_rows(job, kept) else {
        return Ok(pen.draw(PlotName::Trajectory, figure)?);
    };
    // Counted from the start of the period, since the drift may be much larger than the stroke.
    let rows = rows.counted_from_start(&["x_m", "u_m"]);
    let part = trajectory_figure("", &motion(job, &rows, &relative));
    let words = format!("period {}, from 0", period.number);
    Ok(pen.draw(PlotName::Trajectory, enlarged_beside(figure, part, period.span, &words))?)
}

/// Returns the motion in a series. Each contact has the name of its curve.
fn motion<'a>(job: &'a Job, series: &'a Series, contacts: &[(&'a str, &'a str)]) -> Trajectory<'a> {
    let (feet, sliders) = tracks(job, series, Axis::X);
    let beside =
        [(Axis::Z, Coordinate::Height), (Axis::Pitch, Coordinate::Pitch)].map(|(axis, coordinate)| {
            let (feet, sliders) = tracks(job, series, axis);
            Motion { coordinate, feet, sliders }
        });
    let relative =
        contacts.iter().map(|(contact, name)| Track { name, values: series.column(contact, "u_m") });
    Trajectory {
        time: series.time(),
        feet,
        sliders,
        beside: beside.into_iter().filter(|motion| !motion.sliders.is_empty()).collect(),
        relative: relative.collect(),
        gross_slip: None,
        is_upright: gravity(&job.scenario.scene).is_some_and(|gravity| gravity.is_upright()),
    }
}

/// Returns the columns that the plot requires.
pub(super) fn needs(job: &Job) -> Vec<String> {
    let bodies = job.scenario.scene.bodies.iter();
    let of = |body: &Named<Body>| {
        let moving = body.part.coordinates().into_iter().filter(|(_, c)| c.freedom != Freedom::Fixed);
        moving.map(|(axis, _)| format!("{}.{}", body.name, quantity(axis))).collect::<Vec<_>>()
    };
    bodies.flat_map(of).collect()
}

/// Returns the positions along an axis: of feet and of sliders.
pub(super) fn tracks<'a>(job: &'a Job, series: &'a Series, axis: Axis) -> (Vec<Track<'a>>, Vec<Track<'a>>) {
    tracks_of(job, series, (axis, quantity(axis)))
}

/// Returns the values of a quantity of an axis, such as the velocity: of feet and of sliders.
pub(crate) fn tracks_of<'a>(
    job: &'a Job,
    series: &'a Series,
    (axis, quantity): (Axis, &str),
) -> (Vec<Track<'a>>, Vec<Track<'a>>) {
    let (mut feet, mut sliders) = (Vec::new(), Vec::new());
    for (place, body) in job.scenario.scene.bodies.iter().enumerate() {
        let tracks = match body.part.coordinates()[axis as usize].1.freedom {
            Freedom::Fixed => continue,
            Freedom::Follows(_) => &mut feet,
            Freedom::Free if has_actuator(job, place) => &mut feet,
            Freedom::Free | Freedom::Balanced => &mut sliders,
        };
        tracks.push(track(series, &body.name, quantity));
    }
    if sliders.is_empty() {
        // Without sliders, the feet are drawn in full colour.
        std::mem::swap(&mut feet, &mut sliders);
    }
    (feet, sliders)
}

/// Returns the column of a coordinate.
fn quantity(axis: Axis) -> &'static str {
    match axis {
        Axis::X => "x_m",
        Axis::Z => "z_m",
        Axis::Pitch => "pitch_rad",
    }
}

/// Returns whether an actuator is attached to a body.
fn has_actuator(job: &Job, place: usize) -> bool {
    job.scenario.scene.actuators.iter().any(|actuator| actuator.part.between.contains(&Side::Body(place)))
}

fn track<'a>(series: &'a Series, name: &'a str, quantity: &str) -> Track<'a> {
    Track { name, values: series.column(name, quantity) }
}

/// Returns u_c of the only contact if this contact oscillates about its start; `None` otherwise.
fn gross_slip(job: &Job, kept: &Kept) -> Option<f64> {
    let (name, _) = job.model.contacts().next().filter(|_| job.model.contacts().count() == 1)?;
    let (u_c, _) = job.model.contact_scale(0).filter(|_| job.has_constant_load(0))?;
    let u = kept.series.column(name, "u_m");
    let (first, last) = (u.first()?, u.last()?);
    ((last - first).abs() <= 2.0 * u_c).then_some(u_c)
}
