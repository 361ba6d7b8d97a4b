//! The motion of the bodies over time.

use crate::job::Job;
use crate::kept::Kept;
use crate::look::{Pen, Picture};
use crate::series::Series;
use stickslip_drive::scene::{Freedom, Side};
use stickslip_plot::{PlotError, Track, Trajectory, trajectory_figure};
use stickslip_scenario::PlotName;

/// Positions over time, displacements of the contacts below.
pub(super) fn draw(job: &Job, kept: &Kept, pen: &Pen<'_>) -> Result<Vec<Picture>, PlotError> {
    let series = &kept.series;
    let (mut feet, mut sliders) = (Vec::new(), Vec::new());
    for (place, body) in job.scenario.scene.bodies.iter().enumerate() {
        let tracks = match body.part.x {
            Freedom::Fixed => continue,
            Freedom::Follows(_) => &mut feet,
            Freedom::Free if has_actuator(job, place) => &mut feet,
            Freedom::Free => &mut sliders,
        };
        tracks.push(track(series, &body.name, "x_m"));
    }
    if sliders.is_empty() {
        // Nothing to stand out against: the prescribed motion is what there is to see.
        std::mem::swap(&mut feet, &mut sliders);
    }
    let relative = job.model.contacts().map(|(name, _)| track(series, name, "u_m")).collect();
    let trajectory =
        Trajectory { time: series.time(), feet, sliders, relative, gross_slip: gross_slip(job, kept) };
    pen.draw(PlotName::Trajectory, trajectory_figure(job.title(), &trajectory))
}

/// Whether an actuator moves a body.
fn has_actuator(job: &Job, place: usize) -> bool {
    job.scenario.scene.actuators.iter().any(|actuator| actuator.part.between.contains(&Side::Body(place)))
}

fn track<'a>(series: &'a Series, name: &'a str, quantity: &str) -> Track<'a> {
    Track { name, values: series.column(name, quantity) }
}

/// u_c of the only contact, where it oscillates about its start.
fn gross_slip(job: &Job, kept: &Kept) -> Option<f64> {
    let (name, _) = job.model.contacts().next().filter(|_| job.model.contacts().count() == 1)?;
    let (u_c, _) = job.model.contact_scale(0).filter(|_| job.has_constant_load(0))?;
    let u = kept.series.column(name, "u_m");
    let (first, last) = (u.first()?, u.last()?);
    ((last - first).abs() <= 2.0 * u_c).then_some(u_c)
}
